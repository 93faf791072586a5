#include "shot_scene.hpp"

#include <algorithm>
#include <numbers>

#include "base/error.hpp"
#include "model_files.hpp"
#include "plan/summary.hpp"
#include "shot_environment.hpp"

namespace lobe::app {
namespace {

using nlohmann::json;

constexpr int kRgb = 3;  ///< bands that every scene has
constexpr double kRadians = std::numbers::pi / 180.0;

double aspectOf(const Settings& settings) {
    const json& size = settings.get("resolution");
    return size[0].get<double>() / size[1].get<double>();
}

glm::dvec3 vectorOf(const json& value) {
    return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

struct Pose {
    Camera camera;
    glm::dvec3 pivot;   ///< what a turntable turns it about
    bool ours = false;  ///< its depth range follows the scene; a file's camera keeps the file's
};

/// The pose before the turntable turns it.
Pose basePose(const Scene& scene, const Settings& settings) {
    requireOneCamera(settings);
    const Bounds bounds = scene.bounds();
    const json& position = settings.get("camera_position");
    const json& focal = settings.get("camera_focal_point");
    const json& azimuth = settings.get("camera_azimuth");
    const json& elevation = settings.get("camera_elevation");
    const json& name = settings.get("camera");
    if (!position.is_null()) {
        const glm::dvec3 target = focal.is_null() ? bounds.center() : vectorOf(focal);
        Camera camera = lookAt(vectorOf(position), target, std::numbers::pi / 4);
        camera.name = "position";
        return {camera, target, true};
    }
    if (!name.is_null()) return {findCamera(scene, name.get<std::string>()), bounds.center()};
    Framing framing;
    framing.fit = settings.get("orbit").get<double>() != 0.0 ? Fit::sphere : Fit::box;
    if (const json& angle = settings.get("camera_view_angle"); !angle.is_null())
        framing.verticalFov = angle.get<double>() * kRadians;
    if (!azimuth.is_null() || !elevation.is_null()) {
        framing.azimuthDeg = azimuth.is_null() ? 0.0 : azimuth.get<double>();
        framing.elevationDeg = elevation.is_null() ? 0.0 : elevation.get<double>();
    } else if (!scene.cameras.empty()) {
        return {scene.cameras.front(), bounds.center()};
    }
    return {framingCamera(bounds, aspectOf(settings), framing), bounds.center(), true};
}

/// The model for all materials, empty where each keeps its own: `brdf`, else that of the one `brdf_file`,
/// unless the scene itself says where that is to be used.
std::string modelForAll(const Scene& scene, const Settings& settings) {
    const std::vector<std::string> loaded = modelNamesOf(settings);
    const json& brdf = settings.get("brdf");
    if (brdf.is_null()) {
        const bool named =
            loaded.size() == 1 && std::any_of(scene.materials.begin(), scene.materials.end(),
                                              [&](const Material& m) { return m.brdf == loaded[0]; });
        return loaded.size() == 1 && !named ? loaded[0] : "";
    }
    std::string name = brdf.get<std::string>();
    const Brdf& model = requireBrdf(name);
    // The picture's record has to name all that it is made of.
    if (!model.file.empty() && std::find(loaded.begin(), loaded.end(), name) == loaded.end())
        throw UsageError("brdf '" + name + "': its file " + model.file +
                         " is given for other pictures only; expected it " + "in this one's brdf_file");
    return name;
}

bool needsLight(const Scene& scene, const Settings& settings) {
    return scene.lights.empty() && !scene.ambientRadiance && !hasEnvironment(scene, settings);
}

/// The key light belongs to the first frame's camera, so that it does not turn with a turntable.
Camera keyLightCamera(const Scene& scene, const Settings& settings) {
    return cameraOf(scene, settings, 0);
}

}  // namespace

void requireOneCamera(const Settings& settings) {
    const auto isSet = [&](const char* key) { return !settings.get(key).is_null(); };
    const int ways =
        isSet("camera_position") + (isSet("camera_azimuth") || isSet("camera_elevation")) + isSet("camera");
    if (ways > 1)
        throw UsageError(
            "camera, camera_position and camera_azimuth/elevation are different ways to place the camera; "
            "expected one of them (-R KEY takes a setting back)");
    if (isSet("camera_focal_point") && !isSet("camera_position"))
        throw UsageError("camera_focal_point without camera_position; expected both");
}

Camera cameraOf(const Scene& scene, const Settings& settings, int frame) {
    auto [camera, pivot, ours] = basePose(scene, settings);
    if (const json& angle = settings.get("camera_view_angle"); !angle.is_null()) {
        if (camera.orthographic)
            throw UsageError(scene.file + ": camera '" + camera.name +
                             "' is orthographic and has no view angle; expected no camera_view_angle");
        camera.verticalFov = angle.get<double>() * kRadians;
    }
    const double turn = settings.get("orbit").get<double>() * frame / settings.get("frames").get<int>();
    if (turn != 0.0) camera = orbited(camera, pivot, turn);
    if (ours) fitDepthRange(camera, scene.bounds());
    return camera;
}

json changesOf(const Scene& scene, const Settings& settings) {
    json changes = json::object();
    if (const std::string model = modelForAll(scene, settings); !model.empty()) changes["brdf"] = model;
    if (const json& values = settings.get("brdf_set"); !values.is_null()) changes["brdf_set"] = values;
    if (const json& bands = settings.get("bands"); bands != kRgb) changes["bands"] = bands;
    const json environment = environmentChanges(scene, settings);
    for (const auto& [key, value] : environment.items())
        changes[key] = value;
    if (needsLight(scene, settings)) {
        const glm::dmat4 pose =
            keyLightCamera(scene, settings).worldFromCamera;  // the light follows its axes
        for (int axis = 0; axis < 3; ++axis)
            for (int row = 0; row < 3; ++row)
                changes["key_light"].push_back(pose[axis][row]);
    }
    return changes;
}

std::shared_ptr<const Scene> preparedScene(const std::shared_ptr<const Scene>& base,
                                           const Settings& settings) {
    std::shared_ptr<Scene> changed;
    if (const std::string model = modelForAll(*base, settings); !model.empty())
        changed = std::make_shared<Scene>(withBrdf(*base, requireBrdf(model)));
    if (const std::vector<ParameterOverride> values = parametersOf(settings); !values.empty())
        changed = std::make_shared<Scene>(withParameters(changed ? *changed : *base, values));
    if (const int bands = settings.get("bands").get<int>(); bands != kRgb)
        changed = std::make_shared<Scene>(withBands(changed ? *changed : *base, bands));
    if (!environmentChanges(*base, settings).empty()) {
        if (!changed) changed = std::make_shared<Scene>(*base);
        applyEnvironment(*changed, settings);
    }
    if (needsLight(*base, settings)) {
        if (!changed) changed = std::make_shared<Scene>(*base);
        addDefaultLight(*changed, keyLightCamera(*base, settings));
    }
    return changed ? changed : base;
}

RenderOptions renderOptionsOf(const Settings& settings) {
    RenderOptions options;
    options.width = settings.get("resolution")[0].get<int>();
    options.height = settings.get("resolution")[1].get<int>();
    options.quality = qualityOf(settings);
    options.aovs = aovsOf(settings);
    return options;
}

bool truthHasShadows(const Settings& settings) {
    const nlohmann::json& asked = settings.get("shadows");
    return asked.is_null() || asked != "none";
}

}  // namespace lobe::app
