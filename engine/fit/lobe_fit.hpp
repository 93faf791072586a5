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

/// Least squares weights, at least 0, of the given shapes for the values of each of several colours at the samples, scaled so
/// that what lies above the horizon is the albedo of those values. `samples` say where and how densely, and the lobe
/// that errors are relative to; `drawn`: their number, those included that fell below the horizon and are not among them.
std::vector<Weights> weightsFor(const Shapes& shapes, const std::vector<LobeSample>& samples, size_t drawn,
                                const std::vector<std::vector<double>>& colors);

}  // namespace lobe::fit
