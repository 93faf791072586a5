#include "scene/made_environment.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "math/sphere.hpp"
#include "scene/image_based_light.hpp"
#include "scene/sky.hpp"

namespace lobe {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr int kSkyHeight = 256;       ///< skies are smooth
constexpr int kSeenSkyHeight = 1024;  ///< with the sun's disc, of three texels
constexpr double kFar = 2e4;          ///< of a disk, in radii of the scene

std::string text(double value) {
    std::string result = std::to_string(std::round(value * 100.0) / 100.0);
    result.erase(result.find_last_not_of('0') + 1);
    if (result.back() == '.') result.pop_back();
    return result;
}

/// Where what is seen behind surfaces differs from what lights them.
bool seen(const Environment& environment) {
    return environment.background;
}

void makeSky(Scene& scene) {
    Environment& environment = *scene.environment;
    const Sky& sky = *environment.source.sky;
    environment.image = environment.backgroundImage = -1;
    if (sky.model == SkyModel::constant) {
        environment.radiance = sky.zenith;
        environment.notes.emplace_back("a constant sky");
        return;
    }
    const SkyRadiance radiance(sky);
    environment.image = addPicture(scene, skyPicture(radiance, kSkyHeight), "sky");
    if (sky.model == SkyModel::gradient) {
        environment.notes.emplace_back("a sky from the ground's colour over the horizon's to the zenith's");
        return;
    }
    const glm::dvec3 irradiance = radiance.sun() * environment.intensity;
    addSun(scene, sunLight(environment.worldFromMap * radiance.toSun(), irradiance, sky.sunDiameter,
                           scene.bounds()));
    if (seen(environment))
        environment.backgroundImage = addPicture(
            scene,
            skyPicture(radiance, kSeenSkyHeight, sky.sunDiameter > 0.0 ? sky.sunDiameter : kSunDiameter),
            "sky with sun");
    environment.notes.push_back(
        "Preetham's sky, turbidity " + text(sky.turbidity) + ", sun at " + text(sky.sunElevation * kDegrees) +
        " degrees of elevation and " + text(sky.sunAzimuth * kDegrees) +
        " of azimuth; the sun is a light of its own, " +
        (sky.sunDiameter > 0.0 ? "a disk of " + text(sky.sunDiameter * kDegrees) + " degrees"
                               : std::string("directional")));
}

}  // namespace

int addPicture(Scene& scene, Bitmap bitmap, const std::string& name) {
    scene.imageNames.resize(scene.images.size());
    scene.images.push_back(std::move(bitmap));
    scene.imageNames.push_back(name);
    return static_cast<int>(scene.images.size()) - 1;
}

Light sunLight(const glm::dvec3& toSun, const glm::dvec3& irradiance, double diameter, const Bounds& bounds) {
    Light light;
    light.name = "sun";
    light.direction = -toSun;
    if (!(diameter > 0.0)) {
        light.type = LightType::directional;
        light.intensity = irradiance;
        return light;
    }
    const double distance = kFar * (bounds.radius() > 0.0 ? bounds.radius() : 1.0);
    const double sine = std::sin(diameter / 2.0);
    light.type = LightType::disk;
    light.position = bounds.center() + distance * toSun;
    light.axis = frameAbout(light.direction)[0];
    light.radius = distance * std::tan(diameter / 2.0);
    light.intensity = irradiance / (std::numbers::pi * sine * sine);
    return light;
}

void addSun(Scene& scene, Light light) {
    scene.environment->sun = static_cast<int>(scene.lights.size());
    scene.lights.push_back(std::move(light));
}

void removeEnvironment(Scene& scene) {
    if (!scene.environment) return;
    if (const int sun = scene.environment->sun; sun >= 0) scene.lights.erase(scene.lights.begin() + sun);
    scene.environment.reset();
}

void turnEnvironment(Scene& scene, double angle) {
    Environment& environment = *scene.environment;
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(0.0, 1.0, 0.0)));
    environment.worldFromMap = turn * environment.worldFromMap;
    if (environment.sun < 0) return;
    Light& sun = scene.lights[static_cast<size_t>(environment.sun)];
    const glm::dvec3 center = scene.bounds().center();
    sun.position = center + turn * (sun.position - center);
    sun.direction = turn * sun.direction;
    sun.axis = turn * sun.axis;
}

void scaleEnvironment(Scene& scene, double factor) {
    Environment& environment = *scene.environment;
    environment.intensity *= factor;
    if (environment.sun >= 0) scene.lights[static_cast<size_t>(environment.sun)].intensity *= factor;
}

void makeEnvironment(Scene& scene) {
    if (!scene.environment) return;
    if (scene.environment->source.imageBased) makeImageBased(scene);
    if (scene.environment->source.sky) makeSky(scene);
}

}  // namespace lobe
