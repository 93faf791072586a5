#include "import/cameras.hpp"

#include <glm/gtc/constants.hpp>

#include "import/gltf_schema.hpp"
#include "import/refuse.hpp"

namespace lobe {

using nlohmann::json;

namespace {

constexpr double kScaleTolerance = 1e-4;

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

}  // namespace

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
