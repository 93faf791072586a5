/// Double-precision twins of light/area.glsl, by quadrature: irradiance from lights with a body.
#pragma once

#include <glm/glm.hpp>

namespace lobe {

/// Irradiance / (pi radiance), 0..1, at the origin, whose normal is z. Of each, by integration over
/// directions: those of a half plane about an axis in closed form, their share below the horizon left out;
/// the half planes by adaptive quadrature, to 1e-8. The GLSL integrates along the boundary.
///
/// `facing`, unit: the side of a rect or disk that emits. Lengths in any unit.
double rectFactor(const glm::dvec3& center, const glm::dvec3& halfU, const glm::dvec3& halfV,
                  const glm::dvec3& facing);
double diskFactor(const glm::dvec3& center, const glm::dvec3& facing, double radius);
/// 1 inside, as from there its light comes from everywhere; so is a tube's.
double sphereFactor(const glm::dvec3& center, double radius);
/// `halfAxis`: from the centre to the centre of a hemispherical end.
double tubeFactor(const glm::dvec3& center, const glm::dvec3& halfAxis, double radius);

}  // namespace lobe
