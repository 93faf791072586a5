#include "shot_scene.hpp"

#include <numbers>

#include "base/error.hpp"
#include "plan/summary.hpp"

namespace lobe::app {
namespace {

using nlohmann::json;

constexpr double kRadians = std::numbers::pi / 180.0;

double aspectOf(const Settings& settings) {
    const json& size = settings.get("resolution");
    return size[0].get<double>() / size[1].get<double>();
}

glm::dvec3 vectorOf(const json& value) { return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()}; }

/// The pose before the turntable turns it, and what it turns about.
std::pair<Camera, glm::dvec3> basePose(const Scene& scene, const Settings& settings) {
    const Bounds bounds = scene.bounds();
    const json& position = settings.get("camera_position");
    const json& focal = settings.get("camera_focal_point");
    const json& azimuth = settings.get("camera_azimuth");
    const json& elevation = settings.get("camera_elevation");
    const json& name = settings.get("camera");
    const int ways = !position.is_null() + (!azimuth.is_null() || !elevation.is_null()) + !name.is_null();
    if (ways > 1)
        throw UsageError("camera, camera_position and camera_azimuth/elevation are different ways to place the camera; expected one of them");
    if (position.is_null() && !focal.is_null()) throw UsageError("camera_focal_point without camera_position; expected both");
    if (!position.is_null()) {
        const glm::dvec3 target = focal.is_null() ? bounds.center() : vectorOf(focal);
        Camera camera = lookAt(vectorOf(position), target, std::numbers::pi / 4);
        fitDepthRange(camera, bounds);
        return {camera, target};
    }
    Framing framing;
    framing.fit = settings.get("orbit").get<double>() != 0.0 ? Fit::sphere : Fit::box;
    if (const json& angle = settings.get("camera_view_angle"); !angle.is_null()) framing.verticalFov = angle.get<double>() * kRadians;
    if (!azimuth.is_null() || !elevation.is_null()) {
        framing.azimuthDeg = azimuth.is_null() ? 0.0 : azimuth.get<double>();
        framing.elevationDeg = elevation.is_null() ? 0.0 : elevation.get<double>();
        return {framingCamera(bounds, aspectOf(settings), framing), bounds.center()};
    }
    if (!name.is_null()) return {findCamera(scene, name.get<std::string>()), bounds.center()};
    if (!scene.cameras.empty()) return {scene.cameras.front(), bounds.center()};
    return {framingCamera(bounds, aspectOf(settings), framing), bounds.center()};
}

}  // namespace

Camera cameraOf(const Scene& scene, const Settings& settings, int frame) {
    auto [camera, pivot] = basePose(scene, settings);
    if (const json& angle = settings.get("camera_view_angle"); !angle.is_null())
        camera.verticalFov = angle.get<double>() * kRadians;
    const double turn = settings.get("orbit").get<double>() * frame / settings.get("frames").get<int>();
    return turn == 0.0 ? camera : orbited(camera, pivot, turn);
}

std::shared_ptr<const Scene> preparedScene(const std::shared_ptr<const Scene>& base, const Settings& settings) {
    std::shared_ptr<Scene> changed;
    if (const json& brdf = settings.get("brdf"); !brdf.is_null())
        changed = std::make_shared<Scene>(withBrdf(*base, requireBrdf(brdf.get<std::string>())));
    if (base->lights.empty() && !base->ambientRadiance) {
        if (!changed) changed = std::make_shared<Scene>(*base);
        // The key light belongs to the first frame's camera, so that it does not turn with a turntable.
        addDefaultLight(*changed, cameraOf(*base, settings, 0));
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

}  // namespace lobe::app
