/// Two transformed cosine powers that stand for a lobe, and their weights.
#pragma once

#include <array>
#include <vector>

#include "fit/transformed_lobe.hpp"

namespace lobe::fit {

/// A direction that was drawn with density `density`, in the view's frame, and the lobe f cos(theta_i) there.
struct LobeSample {
    glm::dvec3 w;
    double value, density;
};

/// Lobes in a fit.
inline constexpr size_t kLobes = 2;

/// Numbers of one lobe in which fits are sought and tables interpolated:
///   ln(a sqrt(k + 3)), b, ln(c sqrt(k + 3)), d / a, ln k.
/// A lobe's width hardly depends on k then.
using LobeShape5 = std::array<double, 5>;
using Shapes = std::array<LobeShape5, kLobes>;

/// Bounds of k: cosine lobes, and what differs from a Gaussian by less than the fits do.
inline constexpr double kLowestPower = 1.0, kHighestPower = 128.0;

TransformedLobe lobeOf(const LobeShape5& shape);

/// Weights of one colour.
using Weights = std::array<double, kLobes>;

/// Weights for each of several colours, whose values at the samples are given: `ofMean`, in any unit, for the
/// mean of the colours, that the samples hold; for the others by least squares of what they differ by from
/// their share of it. At least 0, and scaled so that what lies above the horizon is the albedo of the colour.
std::vector<Weights> weightsFor(const Shapes& shapes, const Weights& ofMean,
                                const std::vector<LobeSample>& samples,
                                const std::vector<std::vector<double>>& colors);

}  // namespace lobe::fit
