#include "shot_sky.hpp"

#include <array>
#include <glm/trigonometric.hpp>

#include "base/error.hpp"
#include "image/tone.hpp"
#include "scene/made_environment.hpp"
#include "scene/sky.hpp"

namespace lobe::app {
namespace {

using nlohmann::json;

constexpr std::array kSkyKeys{"sky_zenith",    "sky_horizon",   "sky_ground",
                              "sky_turbidity", "sun_elevation", "sun_azimuth"};

void setColour(const Settings& settings, const char* key, glm::dvec3& colour) {
    const json& value = settings.get(key);
    if (value.is_null()) return;
    if (!value.is_array())
        throw UsageError(std::string(key) + ": " + value.dump() + "; expected a colour as R,G,B or #rrggbb");
    for (int c = 0; c < 3; ++c)
        colour[c] = decodeSrgb(value[static_cast<size_t>(c)].get<float>());
}

void setAngle(const Settings& settings, const char* key, double& angle) {
    if (const json& value = settings.get(key); !value.is_null()) angle = glm::radians(value.get<double>());
}

SkyModel modelOf(const std::string& name) {
    return name == "constant"   ? SkyModel::constant
           : name == "gradient" ? SkyModel::gradient
                                : SkyModel::preetham;
}

const char* nameOf(SkyModel model) {
    return model == SkyModel::constant ? "constant" : model == SkyModel::gradient ? "gradient" : "preetham";
}

/// Whether a sky is made by this key.
bool reads(SkyModel model, std::string_view key) {
    if (key == "sky_zenith") return model != SkyModel::preetham;
    if (key == "sky_horizon") return model == SkyModel::gradient;
    if (key == "sky_ground") return model != SkyModel::constant;
    return model == SkyModel::preetham;
}

std::string modelsWith(std::string_view key) {
    std::string names;
    for (SkyModel model : {SkyModel::constant, SkyModel::gradient, SkyModel::preetham})
        if (reads(model, key)) names += (names.empty() ? "sky " : " or ") + std::string(nameOf(model));
    return names;
}

bool hasSky(const Scene& scene) {
    return scene.environment && scene.environment->source.sky;
}

}  // namespace

json skyChanges(const Scene& scene, const Settings& settings) {
    const json& model = settings.get("sky");
    const bool replaced = !settings.get("env").is_null();
    if (!model.is_null() && replaced)
        throw UsageError("env and sky are both set; expected one of them (-R KEY takes a setting back)");
    json changes = json::object();
    if (!model.is_null()) changes["sky"] = model;
    const bool sky = !model.is_null() || (hasSky(scene) && !replaced);
    for (const char* key : kSkyKeys) {
        const json& value = settings.get(key);
        if (value.is_null()) continue;
        if (!sky)
            throw UsageError(std::string(key) + " without a sky; expected sky beside it, as --sky preetham");
        const SkyModel chosen =
            model.is_null() ? scene.environment->source.sky->model : modelOf(model.get<std::string>());
        if (!reads(chosen, key))
            throw UsageError(std::string(key) + ": " + value.dump() + "; sky " + nameOf(chosen) +
                             " has none: expected " + modelsWith(key));
        changes[key] = value;
    }
    // A scene's own sky is made when it is loaded, and its background only if it is seen.
    if (const json& shown = settings.get("env_background"); !shown.is_null() && sky)
        changes["env_background"] = shown;
    if (const json& size = settings.get("sun_size"); !size.is_null() && sky) changes["sun_size"] = size;
    return changes;
}

void applySky(Scene& scene, const Settings& settings) {
    if (skyChanges(scene, settings).empty()) return;
    const json& model = settings.get("sky");
    const bool own = model.is_null();
    Sky sky = own ? *scene.environment->source.sky : defaultSky(modelOf(model.get<std::string>()));
    setColour(settings, "sky_zenith", sky.zenith);
    setColour(settings, "sky_horizon", sky.horizon);
    setColour(settings, "sky_ground", sky.ground);
    if (const json& value = settings.get("sky_turbidity"); !value.is_null())
        sky.turbidity = value.get<double>();
    setAngle(settings, "sun_elevation", sky.sunElevation);
    setAngle(settings, "sun_azimuth", sky.sunAzimuth);
    setAngle(settings, "sun_size", sky.sunDiameter);
    Environment environment;
    if (own) {  // what the scene says of it beside the sky stays
        environment.intensity = scene.environment->intensity;
        environment.worldFromMap = scene.environment->worldFromMap;
        environment.background = scene.environment->background;
    }
    // Drawn whole and not by its tones: a picture that is hidden need not be made.
    if (settings.get("env_background") == "hide") environment.background = false;
    environment.source.sky = sky;
    removeEnvironment(scene);
    scene.environment = std::move(environment);
    makeEnvironment(scene);
}

}  // namespace lobe::app
