/// The reflectance models once more, from their papers, in 50 digits: the yardstick of the double twins.
/// Written as the formulas stand, since 50 digits forgive what doubles do not.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>

#include "shading/brdf.hpp"

namespace lobe::test {

/// f_r cos(theta_i) per channel, rounded to doubles.
using PreciseFCos = std::function<glm::dvec3(const Directions&, std::span<const double>)>;

/// By the models' names. Directions are normalised and added in 50 digits.
const std::map<std::string, PreciseFCos>& preciseModels();

/// Fresnel's reflectance for the ten values of shading::fresnelParameters().
glm::dvec3 preciseFresnel(std::span<const double> values, double cosTheta);

/// He's specular spike (Brdf::mirror).
glm::dvec3 preciseHeMirror(double cosTheta, std::span<const double> values);

}  // namespace lobe::test
