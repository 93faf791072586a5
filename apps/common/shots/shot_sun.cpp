#include "shot_sun.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/trigonometric.hpp>

#include "environment/sun_in_picture.hpp"
#include "scene/made_environment.hpp"

namespace lobe::app {
namespace {

using nlohmann::json;

/// Mirrors show a sun that has a body; others hardly differ.
bool mirrors(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) {
        const Brdf* brdf = findBrdf(material.brdf);
        return brdf != nullptr && brdf->mirror;
    });
}

/// Whether the environment will be a picture that may have a sun in it.
bool hasPicture(const Scene& scene, const Settings& settings) {
    return !settings.get("env").is_null() ||
           (settings.get("sky").is_null() && scene.environment && scene.environment->image >= 0 &&
            !scene.environment->source.sky);
}

/// Two digits are enough of what people read.
std::string rounded(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

}  // namespace

json sunChanges(const Scene& scene, const Settings& settings) {
    json changes = json::object();
    if (settings.get("env_sun") == "keep") return changes;
    // Asked for where there is no picture to take it out of, it is named in a warning.
    if (!hasPicture(scene, settings) && settings.get("env_sun") == "auto") return changes;
    changes["env_sun"] = settings.get("env_sun");
    if (const json& size = settings.get("sun_size"); !size.is_null()) changes["sun_size"] = size;
    return changes;
}

void applySun(Scene& scene, const Settings& settings) {
    if (sunChanges(scene, settings).empty()) return;
    Environment& environment = *scene.environment;
    if (environment.image < 0 || environment.source.sky) {
        scene.warnings.emplace_back("env_sun take: the environment is no picture; no sun is taken out of it");
        return;
    }
    const EnvironmentMap map = EnvironmentMap::of(scene);
    const environment::Spot spot = environment::brightestSpot(map);
    const bool asked = settings.get("env_sun") == "take";
    const std::string why = spot.texels.empty() || !asked ? whyNoSun(spot) : "";
    if (!why.empty()) {
        environment.notes.push_back("no sun is taken out of the picture: " + why);
        return;
    }
    const json& size = settings.get("sun_size");
    const double diameter = !size.is_null()  ? glm::radians(size.get<double>())
                            : mirrors(scene) ? kSunDiameter
                                             : 0.0;
    environment.notes.push_back(
        "the sun is taken out of the picture as a " +
        std::string(diameter > 0.0 ? "disk" : "directional light") + ", " +
        (asked ? "as env_sun asks" : "since a spot of it outshines the rest") + ": " +
        rounded(100.0 * spot.share) + " % of all light from " + rounded(glm::degrees(2.0 * spot.radius)) +
        " degrees, nine tenths of it from " + rounded(glm::degrees(2.0 * spot.core)) +
        (std::isfinite(spot.contrast) ? ", up to " + rounded(spot.contrast) + " times what is around it"
                                      : std::string(", nothing around it")));
    addSun(scene, sunLight(environment.worldFromMap * spot.direction, spot.irradiance * environment.intensity,
                           diameter, scene.bounds()));
    if (environment.background && environment.backgroundImage < 0)
        environment.backgroundImage = environment.image;
    environment.image = addPicture(scene, withoutSpot(map, spot), "environment without its sun");
}

Settings settingsOfTruth(Settings settings) {
    if (settings.get("env_sun") == "auto") settings.set("!env_sun", "keep", "truth");
    return settings;
}

}  // namespace lobe::app
