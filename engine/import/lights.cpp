#include "import/lights.hpp"

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "import/gltf_schema.hpp"
#include "import/refuse.hpp"

namespace lobe {

using nlohmann::json;

namespace {

std::string propertyOf(const char* extension, size_t index) {
    return at(std::string("extensions.") + extension + ".lights", index);
}

Light namedLight(const json& source, size_t index, double defaultIntensity) {
    Light light;
    light.name = source.value("name", at("lights", index));
    light.intensity = glm::dvec3(source.value("intensity", defaultIntensity));
    if (source.contains("color")) {
        const json& color = source["color"];
        light.intensity *= glm::dvec3(color[0].get<double>(), color[1].get<double>(), color[2].get<double>());
    }
    return light;
}

void readCone(const Document& document, const json& source, const std::string& property, Light& light) {
    if (!source.contains("spot")) {
        refuse(document.file, property + ".spot", "missing", "an object, as the light's type says");
    }
    const json& spot = source["spot"];
    light.innerConeAngle = spot.value("innerConeAngle", 0.0);
    light.outerConeAngle = spot.value("outerConeAngle", glm::quarter_pi<double>());
    // The extension wants "less than"; a spot without falloff is meant, and drawn, where they are equal.
    if (light.innerConeAngle > light.outerConeAngle) {
        refuse(document.file, property + ".spot.innerConeAngle", light.innerConeAngle,
               "at most outerConeAngle " + std::to_string(light.outerConeAngle));
    }
}

/// LOBE_light_shape.
void readShape(const Document& document, const json& shape, const std::string& property, Light& light) {
    const std::string place = property + ".extensions." + kLightShapeExtension;
    if (light.type != LightType::point) {
        refuse(document.file, place, "on a light of another type", "a light of type \"point\"");
    }
    const bool tube = shape["shape"] == "tube";
    light.type = tube ? LightType::tube : LightType::sphere;
    light.radius = shape["radius"].get<double>();
    if (tube) {
        if (!shape.contains("length")) {
            refuse(document.file, place + ".length", "missing", "a number, as the shape says");
        }
        light.length = shape["length"].get<double>();
    }
}

/// LOBE_light_image. `source`: of the light, whose property is `property`.
std::optional<NamedImage> readLightImage(const Document& document, const json& source,
                                         const std::string& property) {
    const json* extension = findExtension(source, kLightImageExtension);
    if (extension == nullptr) {
        return std::nullopt;
    }
    const std::string place = property + ".extensions." + kLightImageExtension;
    if (source["type"] != "rect") {
        refuse(document.file, place, "on a light of type " + shown(source["type"]),
               "a light of type \"rect\", of " + std::string(kAreaLightsExtension));
    }
    return NamedImage{(*extension)["image"], place + ".image"};
}

Light readPunctualLight(const Document& document, size_t index) {
    const json& source = document.json["extensions"][kLightsExtension]["lights"][index];
    const std::string property = propertyOf(kLightsExtension, index);
    Light light = namedLight(source, index, 1.0);
    const std::string type = source["type"];
    light.type = type == "directional" ? LightType::directional
                 : type == "spot"      ? LightType::spot
                                       : LightType::point;
    if (source.contains("range") && light.type != LightType::directional) {
        light.range = source["range"].get<double>();
    }
    if (light.type == LightType::spot) {
        readCone(document, source, property, light);
    }
    if (const json* shape = findExtension(source, kLightShapeExtension)) {
        readShape(document, *shape, property, light);
    }
    readLightImage(document, source, property);  // refused on all of these
    return light;
}

/// `scale`: of the node, which multiplies the size.
Light readAreaLight(const Document& document, size_t index, double scale) {
    const json& source = document.json["extensions"][kAreaLightsExtension]["lights"][index];
    Light light = namedLight(source, index, 1000.0);
    const double size = source.value("size", 1.0) * scale;
    constexpr double kSmallest = 1e-9, kLargest = 1e9;  // as the schema has them, now with the scale
    if (!(size >= kSmallest && size <= kLargest)) {
        refuse(document.file, propertyOf(kAreaLightsExtension, index) + ".size, scaled by its node", size,
               "1e-9 to 1e9 m");
    }
    if (source["type"] == "disk") {
        light.type = LightType::disk;
        light.radius = size / 2;
    } else {
        light.type = LightType::rect;
        light.height = size;
        light.width = size * (source.contains("rect") ? source["rect"].value("aspect", 1.0) : 1.0);
    }
    return light;
}

/// EXT_lights_area: "the largest absolute component of the node's world scale".
double largestScale(const glm::dmat4& transform) {
    return std::max({glm::length(glm::dvec3(transform[0])), glm::length(glm::dvec3(transform[1])),
                     glm::length(glm::dvec3(transform[2]))});
}

/// The light that a node refers to by an extension, if it does.
std::optional<size_t> lightOf(const Document& document, size_t node, const char* extension) {
    const json* reference = document.extension("nodes", node, extension);
    if (reference == nullptr) {
        return std::nullopt;
    }
    const json* root = findExtension(document.json, extension);
    const size_t count = root == nullptr ? 0 : (*root)["lights"].size();
    const json& which = (*reference)["light"];
    if (which.get<uint64_t>() >= count) {
        refuse(document.file, at("nodes", node, std::string("extensions.") + extension + ".light"),
               shown(which), "an index into the file's " + std::to_string(count) + " lights");
    }
    return which.get<size_t>();
}

/// LOBE_visible_light, on the node of the light.
bool isToBeSeen(const Document& document, size_t node, const Light& light) {
    const json* extension = document.extension("nodes", node, kVisibleLightExtension);
    if (extension == nullptr || !extension->value("visible", true)) {
        return false;
    }
    if (isPunctual(light.type)) {
        refuse(document.file, at("nodes", node, std::string("extensions.") + kVisibleLightExtension),
               "on a light without a body",
               "a light of EXT_lights_area, or with " + std::string(kLightShapeExtension));
    }
    return true;
}

}  // namespace

std::vector<PlacedLight> readLights(const Document& document, const NodeTree& tree, const WorldPose& world) {
    std::vector<PlacedLight> lights;
    for (const int node : tree.drawn) {
        const auto index = static_cast<size_t>(node);
        const auto place = [&](Light light, std::optional<NamedImage> image) {
            const glm::dquat& rotation = world.rotations[index];
            light.position = glm::dvec3(world.transforms[index][3]);
            light.direction = glm::normalize(rotation * glm::dvec3(0.0, 0.0, -1.0));
            light.castsShadow = castsShadow(document, index);
            light.axis = glm::normalize(rotation * glm::dvec3(1.0, 0.0, 0.0));
            const bool visible = isToBeSeen(document, index, light);
            lights.push_back({std::move(light), visible, std::move(image)});
        };
        if (const auto light = lightOf(document, index, kLightsExtension)) {
            place(readPunctualLight(document, *light), std::nullopt);
        }
        if (const auto light = lightOf(document, index, kAreaLightsExtension)) {
            const json& source = document.json["extensions"][kAreaLightsExtension]["lights"][*light];
            place(readAreaLight(document, *light, largestScale(world.transforms[index])),
                  readLightImage(document, source, propertyOf(kAreaLightsExtension, *light)));
        }
    }
    return lights;
}

}  // namespace lobe
