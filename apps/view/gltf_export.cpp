#include "gltf_export.hpp"

#include <algorithm>
#include <cctype>

#include "base/error.hpp"
#include "config.hpp"

namespace lobe::view {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

json numbersOf(const glm::dvec3& v) {
    return json::array({v.x, v.y, v.z});
}

/// LOBE_materials_brdf of a material, with the textures that its own JSON had for the same model.
json brdfOf(const Material& material, const json& old, const std::string& where) {
    const Brdf& brdf = requireBrdf(material.brdf);
    if (brdf.tableParameter() >= 0)
        throw UsageError(where + ": a table of '" + brdf.name +
                         "' is not written; expected a model whose parameters are numbers");
    json result = {{"model", brdf.name}};
    const bool same = old.value("model", "") == brdf.name;
    for (size_t i = 0; i < brdf.parameters.size(); ++i) {
        const Parameter& parameter = brdf.parameters[i];
        const auto at = static_cast<size_t>(brdf.valueOffset(static_cast<int>(i)));
        json value;
        if (parameter.kind == ParameterKind::choice)
            value = parameter.choices.at(static_cast<size_t>(material.values[at]));
        else if (parameter.kind == ParameterKind::rgb)
            value = json::array({material.values[at], material.values[at + 1], material.values[at + 2]});
        else
            value = material.values[at];
        json& home = parameter.group.empty() ? result : result[parameter.group];
        const bool isType = parameter.group == parameter.name;
        home[isType ? "type" : parameter.name] = value;
        const std::string texture = parameter.name + "Texture";
        if (same && material.textures[i] && old.contains(texture)) home[texture] = old[texture];
    }
    // Groups read what their type has; others' values would be refused.
    if (result.contains("fresnel")) {
        json& fresnel = result["fresnel"];
        const std::string type = fresnel.value("type", "");
        for (const char* name : {"f0", "eta", "k"}) {
            const bool read = type == "schlick"      ? std::string(name) == "f0"
                              : type == "dielectric" ? std::string(name) == "eta"
                                                     : std::string(name) != "f0";
            if (!read) fresnel.erase(name);
        }
        if (type == "dielectric" && fresnel["eta"].is_array()) fresnel["eta"] = json(fresnel["eta"][0]);
    }
    return result;
}

void addUsed(json& gltf, const std::string& extension) {
    json& used = gltf["extensionsUsed"];
    if (used.is_null()) used = json::array();
    for (const json& name : used)
        if (name == extension) return;
    used.push_back(extension);
}

/// The bytes that %20 and the like stand for.
std::string decoded(const std::string& uri) {
    std::string text;
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size()) {
            text += static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

/// Files that the scene names go with it: no scene reaches out of its folder.
class Companions {
public:
    Companions(fs::path source, std::string folder)
        : source_(std::move(source)), folder_(std::move(folder)) {}

    void take(json& object, const char* key) {
        if (!object.is_object() || !object.contains(key) || !object[key].is_string()) return;
        const auto uri = object[key].get<std::string>();
        if (uri.starts_with("data:")) return;
        const fs::path from = source_.parent_path() / decoded(uri);
        std::string name = std::to_string(files.size()) + "_" + from.filename().string();
        for (char& c : name)
            if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '_' && c != '-') c = '_';
        object[key] = folder_ + "/" + name;
        files.emplace_back(from, folder_ + "/" + name);
    }

    std::vector<std::pair<fs::path, std::string>> files;

private:
    fs::path source_;
    std::string folder_;
};

void writeMaterials(json& gltf, const Scene& scene, const Edits& edits) {
    for (const auto& [index, material] : edits.materials) {
        if (material->fileIndex < 0)
            throw UsageError(scene.file + ": material '" + material->name +
                             "' is none of the file's, and cannot be written; expected edits of others");
        const auto i = static_cast<size_t>(material->fileIndex);
        if (!gltf.contains("materials") || i >= gltf["materials"].size()) continue;
        json& target = gltf["materials"][i];
        const std::string where = scene.file + ": materials[" + std::to_string(i) + "]";
        if (findBrdf(material->brdf) != nullptr && !(material->brdf == "metallic_roughness")) {
            json old = json::object();
            if (target.contains("extensions") && target["extensions"].contains("LOBE_materials_brdf"))
                old = target["extensions"]["LOBE_materials_brdf"];
            target["extensions"]["LOBE_materials_brdf"] = brdfOf(*material, old, where);
            addUsed(gltf, "LOBE_materials_brdf");
        } else if (material->brdf == "metallic_roughness") {
            if (target.contains("extensions")) target["extensions"].erase("LOBE_materials_brdf");
            const Brdf& brdf = requireBrdf(material->brdf);
            const auto at = [&](const char* name) {
                return static_cast<size_t>(brdf.valueOffset(brdf.parameterIndex(name)));
            };
            const size_t color = at("baseColor");
            json& glass = target["pbrMetallicRoughness"];
            glass["baseColorFactor"] =
                json::array({material->values[color], material->values[color + 1],
                             material->values[color + 2], static_cast<double>(material->alpha)});
            glass["metallicFactor"] = material->values[at("metallic")];
            glass["roughnessFactor"] = material->values[at("roughness")];
        }
        const double strength = std::max(
            {double{material->emission.r}, double{material->emission.g}, double{material->emission.b}, 1.0});
        target["emissiveFactor"] = numbersOf(glm::dvec3(material->emission) / strength);
        if (strength > 1.0) {
            target["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
            addUsed(gltf, "KHR_materials_emissive_strength");
        } else if (target.contains("extensions")) {
            target["extensions"].erase("KHR_materials_emissive_strength");
        }
        if (target.contains("extensions") && target["extensions"].empty()) target.erase("extensions");
    }
}

/// Colour and one number, as glTF has them: the largest channel is the number.
std::pair<json, double> colorAndIntensity(const glm::dvec3& rgb) {
    const double largest = std::max({rgb.r, rgb.g, rgb.b});
    return {numbersOf(largest > 0.0 ? rgb / largest : glm::dvec3(1.0)), std::max(largest, 0.0)};
}

json punctual(const Light& light) {
    auto [color, intensity] = colorAndIntensity(light.intensity);
    const bool isPoint =
        light.type == LightType::point || light.type == LightType::sphere || light.type == LightType::tube;
    json result = {{"name", light.name},
                   {"type", isPoint                         ? "point"
                            : light.type == LightType::spot ? "spot"
                                                            : "directional"},
                   {"color", color},
                   {"intensity", intensity}};
    if (light.range) result["range"] = *light.range;
    if (light.type == LightType::spot)
        result["spot"] = {{"innerConeAngle", light.innerConeAngle}, {"outerConeAngle", light.outerConeAngle}};
    if (light.type == LightType::sphere)
        result["extensions"]["LOBE_light_shape"] = {{"shape", "sphere"}, {"radius", light.radius}};
    if (light.type == LightType::tube)
        result["extensions"]["LOBE_light_shape"] = {
            {"shape", "tube"}, {"radius", light.radius}, {"length", light.length}};
    return result;
}

json area(const Light& light) {
    auto [color, intensity] = colorAndIntensity(light.intensity);
    json result = {{"name", light.name}, {"color", color}, {"intensity", intensity}};
    if (light.type == LightType::rect) {
        result["type"] = "rect";
        result["size"] = light.height;
        result["rect"]["aspect"] = light.width / light.height;
    } else {
        result["type"] = "disk";
        result["size"] = 2.0 * light.radius;
    }
    return result;
}

/// Columns: the light's axis, what is left, and against the way it shines.
json matrixOf(const Light& light) {
    const glm::dvec3 z = -glm::normalize(light.direction);
    glm::dvec3 x = light.axis - z * glm::dot(light.axis, z);
    if (!(glm::length(x) > 1e-9))
        x = glm::cross(std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), z);
    x = glm::normalize(x);
    const glm::dvec3 y = glm::cross(z, x);
    const glm::dvec3& p = light.position;
    return json::array({x.x, x.y, x.z, 0.0, y.x, y.y, y.z, 0.0, z.x, z.y, z.z, 0.0, p.x, p.y, p.z, 1.0});
}

void writeLights(json& gltf, const std::vector<Light>& lights) {
    for (json& node : gltf["nodes"]) {
        if (!node.contains("extensions")) continue;
        node["extensions"].erase("KHR_lights_punctual");
        node["extensions"].erase("EXT_lights_area");
        if (node["extensions"].empty()) node.erase("extensions");
    }
    json points = json::array(), areas = json::array();
    if (!gltf.contains("scenes") || gltf["scenes"].empty()) throw InputError("a glTF file without a scene");
    json& roots = gltf["scenes"][gltf.value("scene", size_t{0})]["nodes"];
    if (roots.is_null()) roots = json::array();
    for (const Light& light : lights) {
        const bool isArea = light.type == LightType::rect || light.type == LightType::disk;
        json& list = isArea ? areas : points;
        json node = {{"name", light.name}, {"matrix", matrixOf(light)}};
        node["extensions"][isArea ? "EXT_lights_area" : "KHR_lights_punctual"] = {{"light", list.size()}};
        if (!light.castsShadow) {
            node["extensions"]["LOBE_shadow"] = {{"cast", false}};
            addUsed(gltf, "LOBE_shadow");
        }
        list.push_back(isArea ? area(light) : punctual(light));
        if (light.type == LightType::sphere || light.type == LightType::tube)
            addUsed(gltf, "LOBE_light_shape");
        roots.push_back(gltf["nodes"].size());
        gltf["nodes"].push_back(std::move(node));
    }
    gltf["extensions"].erase("KHR_lights_punctual");
    gltf["extensions"].erase("EXT_lights_area");
    if (!points.empty()) {
        gltf["extensions"]["KHR_lights_punctual"]["lights"] = points;
        addUsed(gltf, "KHR_lights_punctual");
    }
    if (!areas.empty()) {
        gltf["extensions"]["EXT_lights_area"]["lights"] = areas;
        addUsed(gltf, "EXT_lights_area");
    }
    if (gltf["extensions"].empty()) gltf.erase("extensions");
}

}  // namespace

EditedGltf editedGltf(const fs::path& source, const Scene& scene, const Edits& edits,
                      const std::string& folder) {
    if (source.extension() == ".glb")
        throw InputError(source.string() + ": its buffers are inside it; expected a .gltf file to export");
    json gltf = json(app::readJsonFile(source));
    writeMaterials(gltf, scene, edits);
    if (edits.lights) writeLights(gltf, *edits.lights);
    Companions companions(source, folder);
    for (const char* list : {"buffers", "images"})
        if (gltf.contains(list))
            for (json& item : gltf[list])
                companions.take(item, "uri");
    if (gltf.contains("scenes"))
        for (json& one : gltf["scenes"])
            if (one.contains("extensions") && one["extensions"].contains("LOBE_environment"))
                companions.take(one["extensions"]["LOBE_environment"], "image");
    if (gltf.contains("materials"))
        for (json& material : gltf["materials"])
            if (material.contains("extensions") && material["extensions"].contains("LOBE_materials_brdf"))
                companions.take(material["extensions"]["LOBE_materials_brdf"], "file");
    return {std::move(gltf), std::move(companions.files)};
}

}  // namespace lobe::view
