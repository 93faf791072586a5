/// The search for the two lobes that fit samples best at one angle of view.
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "fit/lobe_fit.hpp"

namespace lobe::fit {

/// In which fits are sought: of each lobe those of LobeShape5, then the logarithm of its weight over the
/// albedo.
inline constexpr int kLobeNumbers = 6;
inline constexpr int kAllNumbers = kLobeNumbers * static_cast<int>(kLobes);
inline constexpr int kPowerAt = 4, kWeightAt = 5;
using Numbers = Eigen::Matrix<double, kAllNumbers, 1>;
using Curvature = Eigen::Matrix<double, kAllNumbers, kAllNumbers>;

Shapes shapesOf(const Numbers& numbers);

/// Samples of a lobe as the search reads them: number by number, in single precision, relative to the albedo.
class SearchSamples {
public:
    /// `drawn`: the number of samples, those included that fell below the horizon and are not among
    /// `samples`.
    SearchSamples(const std::vector<LobeSample>& samples, size_t drawn);

    /// Nothing is reflected: there is nothing to fit.
    bool dark() const { return !(albedo_ > 0.0); }
    double albedo() const { return albedo_; }
    /// tan of the angle about +z that half of the light is within, at most 3.
    double medianSlope() const { return medianSlope_; }

    Eigen::ArrayXf x, y, z, value, factor;

private:
    double albedo_ = 0.0, medianSlope_ = 1.0;
};

/// The sum of squared residuals, half its gradient and Gauss's approximation to half its second derivatives.
struct Slope {
    double cost = 0.0;
    Numbers gradient = Numbers::Zero();
    Curvature curvature = Curvature::Zero();
};

/// The mean square of the error in units of the mean density of samples and lobe, and of the albedo: an error
/// of the light of the whole sky is at most its root. Nothing where a lobe is folded over. `cosines`: k is 1
/// in all.
std::optional<Slope> slopeAt(const Numbers& numbers, const SearchSamples& samples, bool cosines);

struct FitOptions {
    bool cosines = false;     ///< k = 1, for lobes with tails of power laws
    bool roundAbout = false;  ///< a = c, b = d = 0, for normal incidence
    double pull = 5e-3;       ///< towards the start, in units of the root of the cost per unit of a number
    int evaluations = 30;
};

/// Of columns that span the steps that `options` and the bounds leave: zero for numbers that are fixed, or at
/// a bound that the gradient pushes them over.
Curvature freedom(const Numbers& at, const Numbers& gradient, const FitOptions& options);
/// The numbers after a step, within their bounds.
Numbers stepped(const Numbers& from, const Numbers& step);

struct LobeFit {
    Numbers numbers;
    double cost = 0.0;  ///< as Slope's
};

/// The fit nearest to `start` of least squared error, by Levenberg and Marquardt's search.
LobeFit improve(const Numbers& start, const SearchSamples& samples, const FitOptions& options);

/// The best of fits from several starts.
LobeFit fitFresh(const SearchSamples& samples, const FitOptions& options);

}  // namespace lobe::fit
