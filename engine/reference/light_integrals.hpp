/// The integrals over light with extent; for the files of this folder only.
#pragma once

#include <memory>

#include "reference/direct_light.hpp"

namespace lobe::reference {

/// f_r cos towards the eye for light from a direction, 1/sr; 0 below the horizon.
glm::dvec3 reflected(const ShadingPoint& point, const glm::dvec3& direction);

/// Radiance of a body as a point sees it, with the window of its range.
glm::dvec3 bodyRadiance(const Light& light, const glm::dvec3& point);

/// Where light is reflected, and what is needed to find how much.
struct Scatterer {
    const ShadingPoint& point;
    const Visibility& visible;
    Pcg32& random;
};

/// Null where the light shows nothing to the point. `image`: of the light, or null; kept by reference, as the
/// light is.
std::unique_ptr<LightIntegral> bodyIntegral(const Scatterer& at, const Light& light, const BodyImage* image,
                                            Method method, const LightEffort& effort);

std::unique_ptr<LightIntegral> environmentIntegral(const Scatterer& at, const EnvironmentMap& environment,
                                                   const LightEffort& effort);

}  // namespace lobe::reference
