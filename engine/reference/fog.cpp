#include "reference/fog.hpp"

#include <cmath>

namespace lobe::reference {

FogOnRay fogOnRay(const Scene& scene, const glm::dvec3& origin, const glm::dvec3& direction, double length) {
    FogOnRay result;
    if (!scene.fog) return result;
    const Fog& fog = *scene.fog;
    const glm::dvec3 depth = fogOpticalDepth(fog.medium(), origin.y, direction.y, length);
    for (int c = 0; c < 3; ++c) {
        result.transmittance[c] = std::exp(-depth[c]);
        result.radiance[c] = fog.radiance[c] * fogOpacity(depth[c]);
    }
    if (fog.scattering == glm::dvec3(0.0)) return result;
    for (const Light& light : scene.lights) {
        if (light.type != LightType::point && light.type != LightType::spot) continue;
        FogLight source{light.position,  light.intensity,      light.range,
                        light.direction, light.innerConeAngle, {}};
        if (light.type == LightType::spot) source.outerConeAngle = light.outerConeAngle;
        result.radiance += airlight(fog.medium(), source, origin, direction, length);
    }
    return result;
}

}  // namespace lobe::reference
