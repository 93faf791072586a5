/// What Phong's and Blinn's models have in common: parameters, ambient factor, imitation of glTF surfaces.
#pragma once

#include "shading/parameters.hpp"

namespace lobe::shading {

struct PhongValues {
    glm::dvec3 ambient, diffuse, specular;
    double shininess;
    bool energy;  ///< normalization "energy", else "classic"
};

std::vector<Parameter> phongParameters();
PhongValues phongValues(std::span<const double> values);
glm::dvec3 phongAmbient(std::span<const double> values);

/// Lambert's part k_d, or pi k_d in the classic form; `lobe` is f cos(theta_i) / k_s without it.
AreaModel phongArea(std::function<double(const Directions&, const PhongValues&)> lobe);

/// k_d = 0.96 (1 - metallic) baseColor and k_s = mix(0.04, baseColor, metallic), so that k_d + k_s <= 1; k_a
/// is the base colour; normalization "energy"; `shininess` is clamped to its range.
ParameterValues phongFromMetallicRoughness(const MetallicRoughness& surface, double shininess);

/// cosine^n, from the sine of its angle where that holds more digits. 0 for cosines that are not positive,
/// but 1 for n = 0.
double cosinePower(double cosine, double sine, double n);

/// Blinn exponent n = 2 / m^2 - 2 of the lobe whose slope parameter m is glTF's alpha = roughness^2; infinite
/// at 0.
double blinnExponent(double roughness);

}  // namespace lobe::shading
