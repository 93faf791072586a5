#include "import/lights_cameras.hpp"

#include <glm/gtc/constants.hpp>

#include "import/gltf_schema.hpp"
#include "import/refuse.hpp"

namespace lobe {

using nlohmann::json;

namespace {

constexpr double kScaleTolerance = 1e-4;

Light readLight(const Document& document, size_t index) {
    const json& source = document.json["extensions"][kLightsExtension]["lights"][index];
    const std::string property = at(std::string("extensions.") + kLightsExtension + ".lights", index);
    Light light;
    light.name = source.value("name", at("lights", index));
    const std::string type = source["type"];
    light.type = type == "directional" ? LightType::directional
                 : type == "spot"      ? LightType::spot
                                       : LightType::point;
    const double intensity = source.value("intensity", 1.0);
    light.intensity = glm::dvec3(intensity);
    if (source.contains("color")) {
        const json& color = source["color"];
        light.intensity *= glm::dvec3(color[0].get<double>(), color[1].get<double>(), color[2].get<double>());
    }
    if (source.contains("range") && light.type != LightType::directional) {
        light.range = source["range"].get<double>();
    }
    if (light.type == LightType::spot) {
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
    return light;
}

Camera readCamera(Document& document, size_t index) {
    const json& source = document.json["cameras"][index];
    Camera camera;
    camera.name = source.value("name", "");
    const std::string type = source["type"];
    const std::string property = at("cameras", index, type);
    if (!source.contains(type)) {
        refuse(document.file, property, "missing", "an object, as the camera's type says");
    }
    const json& lens = source[type];
    camera.orthographic = type == "orthographic";
    camera.zNear = lens["znear"].get<double>();
    if (lens.contains("zfar")) {
        camera.zFar = lens["zfar"].get<double>();
        if (*camera.zFar <= camera.zNear) {
            refuse(document.file, property + ".zfar", *camera.zFar,
                   "more than znear " + shown(lens["znear"]));
        }
    }
    if (!camera.orthographic) {
        camera.verticalFov = lens["yfov"].get<double>();
        if (lens.contains("aspectRatio")) {
            camera.aspect = lens["aspectRatio"].get<double>();
        }
        return camera;
    }
    for (const char* name : {"xmag", "ymag"}) {
        const auto value = lens[name].get<double>();
        if (value == 0.0) {
            refuse(document.file, property + "." + name, value, "a number other than 0");
        }
        if (value < 0.0) {
            document.warn(property + "." + name, "is negative; taken without its sign");
        }
    }
    camera.xMag = std::abs(lens["xmag"].get<double>());
    camera.yMag = std::abs(lens["ymag"].get<double>());
    camera.aspect = camera.xMag / camera.yMag;
    return camera;
}

glm::dvec3 placeOf(const glm::dmat4& transform) {
    return {transform[3]};
}

}  // namespace

std::vector<Light> readLights(const Document& document, const NodeTree& tree, const WorldPose& world) {
    const json* extension = findExtension(document.json, kLightsExtension);
    const size_t count = extension == nullptr ? 0 : (*extension)["lights"].size();
    std::vector<Light> lights;
    for (const int node : tree.drawn) {
        const auto index = static_cast<size_t>(node);
        const json* reference = document.extension("nodes", index, kLightsExtension);
        if (reference == nullptr) {
            continue;
        }
        const json& which = (*reference)["light"];
        if (which.get<uint64_t>() >= count) {
            refuse(document.file,
                   at("nodes", index, std::string("extensions.") + kLightsExtension + ".light"), shown(which),
                   "an index into the file's " + std::to_string(count) + " lights");
        }
        Light light = readLight(document, which.get<size_t>());
        light.position = placeOf(world.transforms[index]);
        light.direction = glm::normalize(world.rotations[index] * glm::dvec3(0.0, 0.0, -1.0));
        lights.push_back(std::move(light));
    }
    return lights;
}

std::vector<Camera> readCameras(Document& document, const NodeTree& tree, const WorldPose& world) {
    std::vector<Camera> cameras;
    for (const int node : tree.drawn) {
        const auto index = static_cast<size_t>(node);
        const tinygltf::Node& source = document.model.nodes[index];
        if (source.camera < 0) {
            continue;
        }
        Camera camera = readCamera(document, static_cast<size_t>(source.camera));
        if (camera.name.empty()) {
            camera.name = source.name.empty() ? at("cameras", cameras.size()) : source.name;
        }
        const glm::dmat4& transform = world.transforms[index];
        camera.worldFromCamera = glm::mat4_cast(world.rotations[index]);
        camera.worldFromCamera[3] = transform[3];
        double difference = 0.0;
        for (int column = 0; column < 3; ++column) {
            difference =
                std::max(difference, glm::length(transform[column] - camera.worldFromCamera[column]));
        }
        if (difference > kScaleTolerance) {
            document.warn(at("nodes", index), "its scale does not apply to its camera; left out");
        }
        cameras.push_back(std::move(camera));
    }
    return cameras;
}

}  // namespace lobe
