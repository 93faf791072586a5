#include "harness/albedo.hpp"

#include <cmath>
#include <vector>

#include "math/quadrature.hpp"

namespace lobe::harness {

Albedo albedo(const Brdf& brdf, const ParameterValues& values, double cosine, int channel) {
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

}  // namespace lobe::harness
