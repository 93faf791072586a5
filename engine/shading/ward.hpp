/// What Ward's isotropic and anisotropic models have in common.
#pragma once

#include "shading/parameters.hpp"

namespace lobe::shading {

/// Narrowest and widest lobe that the models take.
inline constexpr double kMinWardAlpha = 1e-5;
inline constexpr double kMaxWardAlpha = 10.0;

/// What stands beside exp() / (4 pi alphaX alphaY): 1 / sqrt(N.L N.V), 1 / (N.L N.V), or
/// 4 |L + V|^2 / (N.(L + V))^4.
enum class WardVariant : uint8_t { ward, duer, bounded };

/// The exponent: tan^2(theta_h) (cos^2 / alphaX^2 + sin^2 / alphaY^2) of phi_h, or
/// 2 ((H.X / alphaX)^2 + (H.Y / alphaY)^2) / (1 + N.H).
enum class WardForm : uint8_t { exact, halfVector };

struct WardLobe {
    double alphaX, alphaY;
    double rotation;  ///< of the x axis from the tangent, counter-clockwise, in rad
    WardForm form;
    WardVariant variant;
};

/// The lobe of albedo near 1, in 1/sr, for directions above the surface.
double wardLobe(const Directions& d, const WardLobe& lobe);

/// `alpha...` from 1e-5 to 10.
Parameter wardAlpha(std::string name, double defaultValue, std::string description);
Parameter wardVariantParameter();

/// (k_d / pi + k_s lobe) cos(theta_i), 0 below the horizon; `values` start with k_d and k_s.
glm::dvec3 wardFCos(const Directions& d, std::span<const double> values, const WardLobe& lobe);

/// k_d and k_s as Phong's model gets them, and the lobe's alpha, glTF's roughness squared.
struct WardImitation {
    ParameterValues diffuseAndSpecular;
    double alpha;
};
WardImitation wardFromMetallicRoughness(const MetallicRoughness& surface);

}  // namespace lobe::shading
