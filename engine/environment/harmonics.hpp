/// Irradiance by spherical harmonics (Ramamoorthi and Hanrahan, SIGGRAPH 2001).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "environment/radiance_tree.hpp"

namespace lobe::environment {

/// Of irradiance / pi over EnvironmentMap::relative's radiance, in the order in which irradianceAt() takes
/// them: 9 for order 2, 18 for order 4, whose third band is 0 of irradiance. Where the sum would be negative
/// anywhere, as a small strong light makes it, bands are divided by 1 + lambda l^2 (l + 1)^2 with the least
/// lambda that removes it (Sloan, "Stupid Spherical Harmonics Tricks", GDC 2008): the mean stays, the lobe
/// widens.
std::vector<glm::vec3> irradianceHarmonics(const RadianceTree& tree, int order);

/// The twin of environment_harmonics() in GLSL.
glm::dvec3 irradianceAt(const std::vector<glm::vec3>& coefficients, const glm::dvec3& normal);

}  // namespace lobe::environment
