/// Fog between surface and eye (LOBE_fog), and the light of a scene's lamps that it scatters there.
#pragma once

#include "scene/scene.hpp"

namespace lobe::reference {

/// What fog does to a ray over some length.
struct FogOnRay {
    glm::dvec3 transmittance{1.0};
    glm::dvec3 radiance{0.0};  ///< added: the fog's own, and the airlight of point and spot lights
};

/// Over the first `length` metres (or infinity) of a ray; its direction is unit. Nothing shadows the
/// airlight.
FogOnRay fogOnRay(const Scene& scene, const glm::dvec3& origin, const glm::dvec3& direction, double length);

}  // namespace lobe::reference
