/// Directions: polar coordinates, frames, and maps from the unit square to the sphere.
#pragma once

#include <glm/glm.hpp>

namespace lobe {

/// Polar angle from +Z and azimuth from +X, radians.
glm::dvec3 fromPolar(double polar, double azimuth);

/// A right-handed frame whose third column is the unit vector n (Duff et al., JCGT 6(1), 2017).
glm::dmat3 frameAbout(const glm::dvec3& n);

/// Uniform over the sphere, density 1 / (4 pi).
glm::dvec3 uniformSphere(const glm::dvec2& u);
/// Uniform over z > 0, density 1 / (2 pi).
glm::dvec3 uniformHemisphere(const glm::dvec2& u);
/// Density cos(theta) / pi over z > 0.
glm::dvec3 cosineHemisphere(const glm::dvec2& u);

}  // namespace lobe
