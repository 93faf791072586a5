/// Directional albedo of a model's twin by quadrature.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "math/quadrature.hpp"
#include "shading/brdf.hpp"

namespace lobe::test {

struct Albedo {
    double value;
    double error;  ///< difference from half as many nodes
};

/// Integral of f_r cos over the light's directions in one channel: polar coordinates about the mirrored
/// direction, panels graded from a hundredth of the lobe's width.
inline Albedo albedo(const Brdf& brdf, const ParameterValues& values, double cosine, int channel = 0) {
    const glm::dvec3 wo(std::sqrt((1.0 - cosine) * (1.0 + cosine)), 0.0, cosine);
    const glm::dvec3 axis(-wo.x, 0.0, wo.z);
    const std::vector<double> breaks = gradedBreaks(0.01 / (1.0 + brdf.lobeSharpness(values)), 1.0, 32);
    const auto integrate = [&](int nodes) {
        return integrateHemisphere(
            [&](const glm::dvec3& wi) {
                return brdf.fCos({wi, wo}, values)[channel];
            },
            axis, breaks, 16, gaussLegendre(nodes));
    };
    const double fine = integrate(10);
    return {fine, std::abs(fine - integrate(5))};
}

}  // namespace lobe::test
