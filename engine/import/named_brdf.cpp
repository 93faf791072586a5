/// LOBE_materials_brdf: a reflectance model by name, its parameters as the registry declares them.
#include <algorithm>
#include <cfloat>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "import/materials.hpp"
#include "import/refuse.hpp"
#include "import/uri.hpp"
#include "shading/metals.hpp"

namespace lobe {

using nlohmann::json;

namespace {

constexpr const char* kTextureSuffix = "Texture";
constexpr const char* kPreset = "preset";
constexpr const char* kFresnelGroup = "fresnel";

class BrdfReader {
public:
    BrdfReader(const Brdf& brdf, std::string property, Document& document, Material& material)
        : brdf_(brdf), property_(std::move(property)), document_(document), material_(material) {}

    void read(const json& extension) {
        material_.brdf = brdf_.name;
        material_.values = brdf_.defaults();
        material_.textures.assign(brdf_.parameters.size(), {});
        material_.textureChannels.assign(brdf_.parameters.size(), 0);
        if (hasPresets() && extension.contains(kPreset)) {
            readPreset(extension[kPreset]);
        }
        for (const auto& [key, value] : extension.items()) {
            if (hasPresets() && key == kPreset) {
                continue;
            }
            if (key != "model" && key != "extras" && key != "extensions") {
                readProperty(key, value);
            }
        }
        validateParameters(brdf_, material_.values, document_.file + ": " + property_);
    }

private:
    bool hasPresets() const { return !brdf_.presets.empty(); }

    /// Published values by name, which the parameters beside them replace one by one.
    void readPreset(const json& name) {
        const std::string given = name.is_string() ? name.get<std::string>() : "";
        if (const BrdfPreset* preset = brdf_.findPreset(given)) {
            material_.values = preset->values;
            return;
        }
        std::vector<std::string> names;
        for (const BrdfPreset& preset : brdf_.presets) {
            names.push_back(preset.name);
        }
        refuse(document_.file, property_ + "." + kPreset, shown(name),
               "one of " + listed(names) + didYouMean(given, names));
    }

    bool isGroup(const std::string& key) const {
        return std::any_of(brdf_.parameters.begin(), brdf_.parameters.end(),
                           [&](const Parameter& parameter) { return parameter.group == key; });
    }

    void readProperty(const std::string& key, const json& value) {
        if (isGroup(key)) {
            readGroup(key, value);
            return;
        }
        readMember(key, value, "");
    }

    /// A parameter, or its texture, of the group of that name.
    void readMember(const std::string& key, const json& value, const std::string& group) {
        const auto own = [&](int index) {
            return index >= 0 && brdf_.parameters[static_cast<size_t>(index)].group == group;
        };
        const int parameter = brdf_.parameterIndex(key);
        if (own(parameter)) {
            if (brdf_.parameters[static_cast<size_t>(parameter)].kind == ParameterKind::table) {
                readTable(value, property_ + "." + key);
            } else {
                readValue(static_cast<size_t>(parameter), value, group);
            }
            return;
        }
        const std::string suffix = kTextureSuffix;
        const int textured =
            key.ends_with(suffix)
                ? brdf_.parameterIndex(std::string_view(key).substr(0, key.size() - suffix.size()))
                : -1;
        if (own(textured) && brdf_.parameters[static_cast<size_t>(textured)].mayBeTextured) {
            readTexture(static_cast<size_t>(textured), key, value);
            return;
        }
        const std::vector<std::string> names = knownNames(group);
        refuse(document_.file, property_ + (group.empty() ? "." : "." + group + ".") + key, shown(value),
               "one of " + listed(names) + didYouMean(key, names));
    }

    /// An object whose "type" is the group's choice and whose other members are parameters; of type "metal"
    /// and with "name" it stands for optical constants by name.
    void readGroup(const std::string& group, const json& value) {
        const std::string property = property_ + "." + group;
        if (!value.is_object()) {
            refuse(document_.file, property, shown(value), "an object with a type");
        }
        if (!value.contains("type")) {
            refuse(document_.file, property + ".type", "missing", "one of " + listed(groupTypes(group)));
        }
        const bool named = value.contains("name");
        const json type = value["type"];
        if (group == kFresnelGroup && (named || type == "metal")) {
            readNamedConstants(value, property);
        } else {
            readValue(static_cast<size_t>(brdf_.parameterIndex(group)), type, group);
        }
        for (const auto& [key, member] : value.items()) {
            if (key != "type" && key != "name" && key != "extras" && key != "extensions") {
                readMember(key, member, group);
            }
        }
    }

    std::vector<std::string> groupTypes(const std::string& group) const {
        std::vector<std::string> types =
            brdf_.parameters[static_cast<size_t>(brdf_.parameterIndex(group))].choices;
        if (group == kFresnelGroup) {
            types.emplace_back("metal");
        }
        return types;
    }

    void setRgb(const char* parameter, const glm::dvec3& rgb) {
        double* out = material_.values.data() + brdf_.valueOffset(brdf_.parameterIndex(parameter));
        for (int c = 0; c < 3; ++c) {
            out[c] = rgb[c];
        }
    }

    void setChoice(const char* parameter, const std::string& choice) {
        const int index = brdf_.parameterIndex(parameter);
        const auto& choices = brdf_.parameters[static_cast<size_t>(index)].choices;
        material_.values[static_cast<size_t>(brdf_.valueOffset(index))] =
            static_cast<double>(std::find(choices.begin(), choices.end(), choice) - choices.begin());
    }

    /// {"type": "metal", "name": ...}: complex indices; {"type": "schlick", "name": ...}: reflectances.
    void readNamedConstants(const json& value, const std::string& property) {
        const std::string type = value["type"].is_string() ? value["type"].get<std::string>() : "";
        const json name = value.value("name", json());
        const auto find = [&](const auto& table) {
            std::vector<std::string> names;
            for (const auto& entry : table) {
                if (name == entry.name) {
                    return entry;
                }
                names.push_back(entry.name);
            }
            const std::string given = name.is_string() ? name.get<std::string>() : "";
            refuse(document_.file, property + ".name", name.is_null() ? "missing" : shown(name),
                   "one of " + listed(names) + didYouMean(given, names));
        };
        if (type == "metal") {
            const shading::Metal metal = find(shading::metals());
            setChoice("fresnel", "conductor");
            setRgb("eta", metal.eta);
            setRgb("k", metal.k);
        } else if (type == "schlick") {
            setChoice("fresnel", "schlick");
            setRgb("f0", find(shading::namedReflectances()).f0);
        } else {
            refuse(document_.file, property + ".type", shown(value["type"]),
                   "metal or schlick beside a name");
        }
    }

    /// The model's table: an array of objects, the name of one that comes with Lobe, or a file beside the
    /// scene.
    void readTable(const json& value, const std::string& property) {
        const TableFormat& format = *brdf_.table;
        TableRows rows;
        if (format.fromFile) {
            rows = tableFile(value, property);
        } else if (value.is_string()) {
            rows = namedTable(value.get<std::string>(), property);
        } else {
            rows = tableColumns(value, property);
        }
        material_.values.resize(static_cast<size_t>(brdf_.valueCount()));
        material_.values.insert(material_.values.end(), rows.begin(), rows.end());
    }

    TableRows tableFile(const json& value, const std::string& property) {
        if (!value.is_string()) {
            refuse(document_.file, property, shown(value), "the name of a file beside the scene");
        }
        const auto uri = value.get<std::string>();
        const std::vector<std::byte> bytes = readReferencedFile(
            resolveUri(uri, document_.folder, document_.file, property), uri, document_.file, property);
        document_.hash.add(bytes);
        try {
            return brdf_.table->fromFile(bytes);
        } catch (const InputError& error) {
            throw InputError(document_.file + ": " + property + ": " + uri + ": " + error.what());
        }
    }

    TableRows namedTable(const std::string& name, const std::string& property) const {
        std::vector<std::string> names;
        for (auto& [known, rows] : brdf_.table->examples()) {
            if (known == name) {
                return rows;
            }
            names.push_back(known);
        }
        refuse(document_.file, property, "'" + name + "'",
               "an array of objects or one of " + listed(names) + didYouMean(name, names));
    }

    TableRows tableColumns(const json& value, const std::string& property) const {
        constexpr size_t kMostElements = 4096;
        if (!value.is_array() || value.empty() || value.size() > kMostElements) {
            refuse(document_.file, property, shown(value),
                   "an array of 1 to " + std::to_string(kMostElements) + " objects with " +
                       listed(brdf_.table->columns));
        }
        std::vector<double> columns;
        for (size_t i = 0; i < value.size(); ++i) {
            for (const std::string& column : brdf_.table->columns) {
                const std::string place = at(property, i, column);
                if (!value[i].is_object() || !value[i].contains(column)) {
                    refuse(document_.file, place, "missing", "a number or three");
                }
                const glm::dvec3 rgb = rgbOf(value[i][column], place, true);
                columns.insert(columns.end(), {rgb.r, rgb.g, rgb.b});
            }
            for (const auto& [key, member] : value[i].items()) {
                const auto& known = brdf_.table->columns;
                if (std::find(known.begin(), known.end(), key) == known.end()) {
                    refuse(document_.file, at(property, i, key), shown(member), "one of " + listed(known));
                }
            }
        }
        try {
            return brdf_.table->fromColumns(columns);
        } catch (const InputError& error) {
            throw InputError(document_.file + ": " + property_ + "." + error.what());
        }
    }

    /// Three numbers, or where `broadcast` one that stands for all.
    glm::dvec3 rgbOf(const json& value, const std::string& property, bool broadcast) const {
        if (broadcast && value.is_number()) {
            return glm::dvec3(value.get<double>());
        }
        if (!value.is_array() || value.size() != 3 ||
            !std::all_of(value.begin(), value.end(), [](const json& v) { return v.is_number(); })) {
            refuse(document_.file, property, shown(value),
                   broadcast ? "a number, or three for red, green and blue"
                             : "three numbers, red, green and blue");
        }
        return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
    }

    std::vector<std::string> knownNames(const std::string& group) const {
        std::vector<std::string> names;
        if (group.empty() && hasPresets()) {
            names.emplace_back(kPreset);
        }
        for (const Parameter& parameter : brdf_.parameters) {
            if (parameter.group != group) {
                if (group.empty() && parameter.group == parameter.name) {
                    names.push_back(parameter.group);
                }
                continue;
            }
            names.push_back(parameter.group == parameter.name ? "type" : parameter.name);
            if (parameter.mayBeTextured) {
                names.push_back(parameter.name + kTextureSuffix);
            }
        }
        return names;
    }

    void readValue(size_t index, const json& value, const std::string& group) {
        const Parameter& parameter = brdf_.parameters[index];
        const std::string property = property_ + "." + (group.empty() ? "" : group + ".") +
                                     (!group.empty() && parameter.name == group ? "type" : parameter.name);
        double* out = material_.values.data() + brdf_.valueOffset(static_cast<int>(index));
        switch (parameter.kind) {
            case ParameterKind::scalar:
                if (!value.is_number()) {
                    refuse(document_.file, property, shown(value), "a number");
                }
                *out = value.get<double>();
                return;
            case ParameterKind::rgb: {
                // An index that is the same for all wavelengths is usually written as one number.
                const glm::dvec3 rgb =
                    rgbOf(value, property, parameter.name == "eta" || parameter.name == "k");
                for (int c = 0; c < 3; ++c) {
                    out[c] = rgb[c];
                }
                return;
            }
            case ParameterKind::choice: {
                const auto& choices = parameter.choices;
                const std::string name = value.is_string() ? value.get<std::string>() : "";
                const auto found = std::find(choices.begin(), choices.end(), name);
                if (found == choices.end()) {
                    refuse(document_.file, property, shown(value),
                           "one of " + listed(group.empty() ? choices : groupTypes(group)) +
                               didYouMean(name, choices));
                }
                *out = static_cast<double>(found - choices.begin());
                return;
            }
            case ParameterKind::table:
                return;  // readTable()
        }
    }

    void readTexture(size_t index, const std::string& key, const json& info) {
        const std::string property = property_ + "." + key;
        const size_t textures = document_.model.textures.size();
        const auto isIndex = [](const json& value, size_t count) {
            return value.is_number_unsigned() && value.get<uint64_t>() < count;
        };
        if (!info.is_object() || !info.contains("index") || !isIndex(info["index"], textures)) {
            refuse(document_.file, property, shown(info),
                   "an object with the index of one of " + std::to_string(textures) + " textures");
        }
        constexpr size_t kMostUvSets = 1024;
        if (info.contains("texCoord") && !isIndex(info["texCoord"], kMostUvSets)) {
            refuse(document_.file, property + ".texCoord", shown(info["texCoord"]), "0 or 1");
        }
        if (const json* transform = findExtension(info, "KHR_texture_transform")) {
            checkTransform(*transform, property + ".extensions.KHR_texture_transform");
        }
        if (info.contains("channel")) {
            if (brdf_.parameters[index].kind != ParameterKind::scalar || !isIndex(info["channel"], 4)) {
                refuse(document_.file, property + ".channel", shown(info["channel"]),
                       "0 to 3, for parameters that are a single number");
            }
            material_.textureChannels[index] = info["channel"].get<uint8_t>();
        }
        material_.textures[index] = readTextureSlot(info, property, document_);
    }

    void checkTransform(const json& transform, const std::string& property) const {
        const auto isFloat = [](const json& v) {
            return v.is_number() && std::abs(v.get<double>()) <= double{FLT_MAX};
        };
        for (const auto& [key, value] : transform.items()) {
            const bool pair = key == "offset" || key == "scale";
            const bool fits =
                pair ? value.is_array() && value.size() == 2 && isFloat(value[0]) && isFloat(value[1])
                : key == "rotation" ? isFloat(value)
                : key == "texCoord" ? value.is_number_unsigned() && value.get<uint64_t>() < 1024
                                    : true;
            if (!fits) {
                refuse(document_.file, property + "." + key, shown(value),
                       pair                ? "two numbers"
                       : key == "rotation" ? "a number"
                                           : "0 or 1");
            }
        }
    }

    const Brdf& brdf_;
    std::string property_;
    Document& document_;
    Material& material_;
};

}  // namespace

void readNamedBrdf(const json& extension, const std::string& property, Document& document,
                   Material& material) {
    const auto& model = extension["model"].get_ref<const std::string&>();
    const Brdf* brdf = findBrdf(model);
    if (brdf == nullptr) {
        refuse(document.file, property + ".model", shown(extension["model"]),
               "one of " + listed(brdfNames()) + didYouMean(model, brdfNames()));
    }
    BrdfReader(*brdf, property, document, material).read(extension);
}

}  // namespace lobe
