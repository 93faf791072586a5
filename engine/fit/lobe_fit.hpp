/// Fitting two transformed cosine powers to a lobe that samples describe.
#pragma once

#include <array>
#include <optional>
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

struct LobeFit {
    Shapes shapes;
    std::array<double, kLobes> weights{};
    double cost =
        0.0;  ///< mean square of the error in units of the density of samples and the lobe, and of its albedo
};

struct FitOptions {
    bool cosines = false;     ///< k = 1, for lobes with tails of power laws
    bool roundAbout = false;  ///< a = c, b = d = 0, for normal incidence
    double pull = 5e-3;       ///< towards the start, in units of the root of the cost per unit of a number
    int evaluations = 40;
};

/// The fit nearest to `start` of least squared error. `drawn`: the number of samples, those included that
/// fell below the horizon and are not among `samples`.
LobeFit improve(const LobeFit& start, const std::vector<LobeSample>& samples, size_t drawn,
                const FitOptions& options);

/// The cost of a fit as it is.
double costOf(const LobeFit& fit, const std::vector<LobeSample>& samples, size_t drawn, bool cosines);

/// The best of fits from several starts.
LobeFit fitFresh(const std::vector<LobeSample>& samples, size_t drawn, const FitOptions& options);

/// Least squares weights, at least 0, of the given shapes for `values` at the samples, scaled so that what
/// lies above the horizon is the albedo of `values`. `samples` say where and how densely, and the lobe that
/// errors are relative to.
std::array<double, kLobes> weightsFor(const Shapes& shapes, const std::vector<LobeSample>& samples,
                                      size_t drawn, const std::vector<double>& values);

}  // namespace lobe::fit
