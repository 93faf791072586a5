#include "reference/direct_light.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "reference/body_lamp.hpp"
#include "reference/light_integrals.hpp"
#include "shading/punctual.hpp"

namespace lobe::reference {

const char* nameOf(Source source) {
    static constexpr const char* kNames[kSources] = {"emission", "ambient",     "directional", "point",
                                                     "spot",     "rect",        "disk",        "sphere",
                                                     "tube",     "environment", "fog"};
    return kNames[static_cast<size_t>(source)];
}

Source sourceOf(LightType type) {
    return static_cast<Source>(static_cast<int>(Source::directional) + static_cast<int>(type));
}

glm::dvec3 reflected(const ShadingPoint& point, const glm::dvec3& direction) {
    const glm::dmat3 local = glm::transpose(point.frame);
    const glm::dvec3 wi = local * direction, wo = local * point.toEye;
    if (!(wi.z > 0.0) || !(wo.z > 0.0)) return glm::dvec3(0.0);
    return point.brdf->fCos(Directions(wi, wo), point.values);
}

DirectLight::DirectLight(const Scene& scene, const EnvironmentMap* environment, Method method)
    : scene_(scene), environment_(environment), method_(method), images_(scene.lights.size()) {
    std::map<int, std::shared_ptr<const BodyImage>> made;
    for (size_t i = 0; i < images_.size(); ++i) {
        const int image = scene.lights[i].image;
        if (image < 0) continue;
        std::shared_ptr<const BodyImage>& one = made[image];
        if (!one) one = std::make_shared<const BodyImage>(scene.images[static_cast<size_t>(image)]);
        images_[i] = one;
    }
}

glm::dvec3 DirectLight::punctual(const ShadingPoint& point, const Visibility& visible,
                                 const Light& light) const {
    if (light.type == LightType::directional) {
        const glm::dvec3 f = reflected(point, -light.direction);
        return f == glm::dvec3(0.0)
                   ? f
                   : f * light.intensity * visible(-light.direction, std::numeric_limits<double>::infinity());
    }
    const glm::dvec3 toLight = light.position - point.position;
    const double distance = glm::length(toLight);
    if (!(distance > 0.0)) return glm::dvec3(0.0);  // at the very point: no direction
    const glm::dvec3 direction = toLight / distance;
    double attenuation = distanceAttenuation(distance * distance, light.range);
    if (light.type == LightType::spot)
        attenuation *= spotAttenuation(-glm::dot(direction, light.direction), light.innerConeAngle,
                                       light.outerConeAngle);
    if (attenuation == 0.0) return glm::dvec3(0.0);
    const glm::dvec3 f = reflected(point, direction);
    if (f == glm::dvec3(0.0)) return f;
    return f * light.intensity * (attenuation * visible(direction, distance));
}

/// What an ideal mirror shows: the nearest body that its ray meets, else the environment. Lights without
/// extent are not to be seen, and light that other surfaces reflect is not direct.
void DirectLight::addMirrored(const ShadingPoint& point, const Visibility& visible,
                              Contributions& exact) const {
    if (!point.brdf->mirror) return;
    const glm::dvec3 normal = point.frame[2];
    const double cosine = glm::dot(normal, point.toEye);
    if (!(cosine > 0.0)) return;
    const glm::dvec3 direction = glm::normalize(2.0 * cosine * normal - point.toEye);
    const glm::dvec3 reflectance = point.brdf->mirror(cosine, point.values);
    double nearest = std::numeric_limits<double>::infinity();
    const Light* body = nullptr;
    glm::dvec3 radiance(0.0);
    for (size_t i = 0; i < scene_.lights.size(); ++i) {
        const Light& light = scene_.lights[i];
        if (isPunctual(light.type)) continue;
        const BodyLamp lamp(light, point.position, bodyRadiance(light, point.position), images_[i].get());
        const auto distance = lamp.view().distanceAlong(direction);
        if (distance && *distance < nearest) {
            nearest = *distance;
            body = &light;
            radiance = lamp.radiance(direction, *distance);
        }
    }
    if (body == nullptr && environment_ == nullptr) return;
    const bool blocked = body != nullptr ? body->castsShadow : scene_.environment->castsShadow;
    const double transmittance = blocked ? visible(direction, nearest) : 1.0;
    if (body != nullptr)
        exact[static_cast<size_t>(sourceOf(body->type))] += reflectance * transmittance * radiance;
    else
        exact[static_cast<size_t>(Source::environment)] +=
            reflectance * transmittance * environment_->radiance(direction);
}

std::vector<std::unique_ptr<LightIntegral>> DirectLight::at(const ShadingPoint& point,
                                                            const Visibility& visible, Pcg32& random,
                                                            Contributions& exact,
                                                            const LightEffort& effort) const {
    std::vector<std::unique_ptr<LightIntegral>> integrals;
    addMirrored(point, visible, exact);
    if (!point.brdf->traits.scattersLight) return integrals;
    static const Visibility kUnblocked = [](const glm::dvec3&, double) { return 1.0; };
    for (size_t i = 0; i < scene_.lights.size(); ++i) {
        const Light& light = scene_.lights[i];
        const Scatterer lit{point, light.castsShadow ? visible : kUnblocked, random};
        if (isPunctual(light.type))
            exact[static_cast<size_t>(sourceOf(light.type))] += punctual(point, lit.visible, light);
        else if (auto integral = bodyIntegral(lit, light, images_[i].get(), method_, effort))
            integrals.push_back(std::move(integral));
    }
    if (environment_ != nullptr) {
        const Scatterer lit{point, scene_.environment->castsShadow ? visible : kUnblocked, random};
        integrals.push_back(environmentIntegral(lit, *environment_, effort));
    }
    return integrals;
}

}  // namespace lobe::reference
