/// LOBE_materials_brdf: a reflectance model by name, its parameters as the registry declares them.
#include <algorithm>
#include <cfloat>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "import/materials.hpp"
#include "import/refuse.hpp"

namespace lobe {

using nlohmann::json;

namespace {

constexpr const char* kTextureSuffix = "Texture";

std::string joined(const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names) {
        all += (all.empty() ? "" : ", ") + name;
    }
    return all;
}

class BrdfReader {
public:
    BrdfReader(const Brdf& brdf, std::string property, Document& document, Material& material)
        : brdf_(brdf), property_(std::move(property)), document_(document), material_(material) {}

    void read(const json& extension) {
        material_.brdf = brdf_.name;
        material_.values = brdf_.defaults();
        material_.textures.assign(brdf_.parameters.size(), {});
        material_.textureChannels.assign(brdf_.parameters.size(), 0);
        for (const auto& [key, value] : extension.items()) {
            if (key != "model" && key != "extras" && key != "extensions") {
                readProperty(key, value);
            }
        }
        validateParameters(brdf_, material_.values, document_.file + ": " + property_);
    }

private:
    void readProperty(const std::string& key, const json& value) {
        const int parameter = brdf_.parameterIndex(key);
        if (parameter >= 0) {
            readValue(static_cast<size_t>(parameter), value);
            return;
        }
        const std::string suffix = kTextureSuffix;
        const int textured =
            key.ends_with(suffix)
                ? brdf_.parameterIndex(std::string_view(key).substr(0, key.size() - suffix.size()))
                : -1;
        if (textured >= 0 && brdf_.parameters[static_cast<size_t>(textured)].mayBeTextured) {
            readTexture(static_cast<size_t>(textured), key, value);
            return;
        }
        const std::vector<std::string> names = knownNames();
        refuse(document_.file, property_ + "." + key, shown(value),
               "one of " + joined(names) + didYouMean(key, names));
    }

    std::vector<std::string> knownNames() const {
        std::vector<std::string> names;
        for (const Parameter& parameter : brdf_.parameters) {
            names.push_back(parameter.name);
            if (parameter.mayBeTextured) {
                names.push_back(parameter.name + kTextureSuffix);
            }
        }
        return names;
    }

    void readValue(size_t index, const json& value) {
        const Parameter& parameter = brdf_.parameters[index];
        const std::string property = property_ + "." + parameter.name;
        double* out = material_.values.data() + brdf_.valueOffset(static_cast<int>(index));
        switch (parameter.kind) {
            case ParameterKind::scalar:
                if (!value.is_number()) {
                    refuse(document_.file, property, shown(value), "a number");
                }
                *out = value.get<double>();
                return;
            case ParameterKind::rgb:
                if (!value.is_array() || value.size() != 3 ||
                    !std::all_of(value.begin(), value.end(), [](const json& v) { return v.is_number(); })) {
                    refuse(document_.file, property, shown(value), "three numbers, red, green and blue");
                }
                for (size_t c = 0; c < 3; ++c) {
                    out[c] = value[c].get<double>();
                }
                return;
            case ParameterKind::choice: {
                const auto& choices = parameter.choices;
                const std::string name = value.is_string() ? value.get<std::string>() : "";
                const auto found = std::find(choices.begin(), choices.end(), name);
                if (found == choices.end()) {
                    refuse(document_.file, property, shown(value),
                           "one of " + joined(choices) + didYouMean(name, choices));
                }
                *out = static_cast<double>(found - choices.begin());
                return;
            }
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
               "one of " + joined(brdfNames()) + didYouMean(model, brdfNames()));
    }
    BrdfReader(*brdf, property, document, material).read(extension);
}

}  // namespace lobe
