#include "plot/fresnel_curves.hpp"

#include <cmath>

#include "plot/geometry.hpp"
#include "shading/fresnel.hpp"

namespace lobe::plot {
namespace {

std::vector<double> reflectances(const Sampler& sampler, const std::vector<Assignment>& assignments,
                                 std::span<const Pair> pairs) {
    std::vector<double> values;
    for (const Sample& sample : sampler.sample(makeModel("mirror", assignments), pairs))
        values.push_back(sample.mirror.r);
    return values;
}

FresnelCurve curveOf(const Sampler& sampler, const Interface& interface, const std::vector<double>& angles) {
    const auto eta = double(static_cast<float>(interface.eta));
    const auto k = double(static_cast<float>(interface.k));
    std::vector<Pair> pairs;
    for (double angle : angles) {
        const glm::dvec3 w = toEye(angle, 0.0);
        pairs.push_back({w, w});
    }
    std::vector<Assignment> interfaceValues{{"fresnel", k == 0.0 ? "dielectric" : "conductor"},
                                            {"eta", shortNumber(eta)}};
    if (k != 0.0) interfaceValues.push_back({"k", shortNumber(k)});
    const std::vector<double> exact = reflectances(sampler, interfaceValues, pairs);
    FresnelCurve curve{
        interface, ((eta - 1.0) * (eta - 1.0) + k * k) / ((eta + 1.0) * (eta + 1.0) + k * k), {}};
    const std::vector<double> schlick =
        reflectances(sampler, {{"fresnel", "schlick"}, {"f0", shortNumber(curve.f0)}}, pairs);
    for (size_t i = 0; i < angles.size(); ++i) {
        const double halfSine = std::sin(0.5 * glm::radians(angles[i]));
        const auto [s, p] = shading::polarisedReflectance({eta, k}, std::cos(glm::radians(angles[i])),
                                                          2.0 * halfSine * halfSine);
        curve.points.push_back({angles[i], exact[i], s, p, schlick[i]});
        const double difference = schlick[i] - exact[i];
        if (std::abs(difference) > std::abs(curve.largestDifference)) {
            curve.largestDifference = difference;
            curve.atAngle = angles[i];
        }
    }
    return curve;
}

}  // namespace

double indexOf(double f0) {
    return (1.0 + std::sqrt(f0)) / (1.0 - std::sqrt(f0));
}

FresnelCurves computeFresnel(const Sampler& sampler, const FresnelRequest& request) {
    FresnelCurves result{request, {}};
    const std::vector<double> angles = linearSteps(0.0, 90.0, request.angles);
    for (const Interface& interface : request.interfaces)
        result.curves.push_back(curveOf(sampler, interface, angles));
    return result;
}

}  // namespace lobe::plot
