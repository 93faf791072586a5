#include "fit/lobe_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <unsupported/Eigen/NonLinearOptimization>
#include <utility>

namespace lobe::fit {
namespace {

// Numbers of a lobe in the search: those of LobeShape5, the last as the logit of ln k between its bounds, and
// the logarithm of the weight.
constexpr Eigen::Index kNumbers = 6;
constexpr Eigen::Index kAll = kNumbers * static_cast<Eigen::Index>(kLobes);

const double kLogLowest = std::log(kLowestPower);
const double kLogRange = std::log(kHighestPower / kLowestPower);

double powerShare(double logit) {
    return 1.0 / (1.0 + std::exp(-logit));
}

struct SearchLobe {
    TransformedLobe lobe;
    double skew = 0.0;  // d / a
    double weight = 0.0;
    double powerSlope = 0.0;  // d k / d logit
};

/// Residuals of the fit and their derivatives. The pull towards the start is one more residual a number.
class Residuals {
public:
    using Scalar = double;
    enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };
    using InputType = Eigen::VectorXd;
    using ValueType = Eigen::VectorXd;
    using JacobianType = Eigen::MatrixXd;

    Residuals(const std::vector<LobeSample>& samples, size_t drawn, const FitOptions& options,
              Eigen::VectorXd start)
        : samples_(&samples), options_(options), start_(std::move(start)), factors_(samples.size()) {
        double albedo = 0.0;
        for (const LobeSample& s : samples)
            albedo += s.value / s.density;
        albedo /= static_cast<double>(drawn);
        for (size_t i = 0; i < samples.size(); ++i)
            factors_[i] =
                1.0 /
                std::sqrt(samples[i].density * static_cast<double>(drawn) *
                          (0.5 * samples[i].value * albedo + 0.5 * albedo * albedo * samples[i].density));
    }

    int inputs() const { return static_cast<int>(kAll); }
    int values() const { return static_cast<int>(samples_->size()) + inputs(); }

    SearchLobe lobeAt(const Eigen::VectorXd& x, Eigen::Index j) const {
        const Eigen::Index o = kNumbers * j;
        SearchLobe s;
        const double share = powerShare(x[o + 4]);
        s.lobe.k = options_.cosines ? 1.0 : std::exp(kLogLowest + kLogRange * share);
        s.powerSlope = options_.cosines ? 0.0 : s.lobe.k * kLogRange * share * (1.0 - share);
        const double scale = 1.0 / std::sqrt(s.lobe.k + 3.0);
        s.lobe.a = std::exp(x[o]) * scale;
        s.lobe.c = options_.roundAbout ? s.lobe.a : std::exp(x[o + 2]) * scale;
        s.lobe.b = options_.roundAbout ? 0.0 : x[o + 1];
        s.skew = options_.roundAbout ? 0.0 : x[o + 3];
        s.lobe.d = s.skew * s.lobe.a;
        s.weight = std::exp(x[o + 5]);
        return s;
    }

    int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& r) const {
        r.setZero();
        for (Eigen::Index j = 0; j < static_cast<Eigen::Index>(kLobes); ++j) {
            const SearchLobe s = lobeAt(x, j);
            if (!(1.0 - s.lobe.b * s.skew > 0.0)) continue;
            for (size_t i = 0; i < samples_->size(); ++i)
                r[static_cast<Eigen::Index>(i)] += s.weight * s.lobe.density((*samples_)[i].w);
        }
        const auto n = static_cast<Eigen::Index>(samples_->size());
        for (Eigen::Index i = 0; i < n; ++i) {
            const auto at = static_cast<size_t>(i);
            r[i] = (r[i] - (*samples_)[at].value) * factors_[at];
        }
        r.tail(kAll) = options_.pull * (x - start_);
        return 0;
    }

    int df(const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian) const {
        jacobian.setZero();
        const auto n = static_cast<Eigen::Index>(samples_->size());
        for (Eigen::Index j = 0; j < static_cast<Eigen::Index>(kLobes); ++j)
            differentiate(lobeAt(x, j), kNumbers * j, jacobian);
        for (Eigen::Index i = 0; i < kAll; ++i)
            jacobian(n + i, i) = options_.pull;
        return 0;
    }

private:
    void differentiate(const SearchLobe& s, Eigen::Index o, Eigen::MatrixXd& jacobian) const {
        const TransformedLobe& lobe = s.lobe;
        const double det = 1.0 - lobe.b * s.skew;
        if (!(det > 0.0)) return;
        for (size_t at = 0; at < samples_->size(); ++at) {
            const glm::dvec3& w = (*samples_)[at].w;
            const glm::dvec3 v = lobe.map(w);
            if (v.z <= 0.0) continue;
            const double length2 = glm::dot(v, v);
            const double weighted = s.weight * lobe.density(w) * factors_[at];
            // Of ln D by v, then by the numbers.
            const glm::dvec3 slope = -(lobe.k + 3.0) / length2 * v + glm::dvec3(0.0, 0.0, lobe.k / v.z);
            const double byLnA = lobe.a * (slope.x + slope.z * s.skew) * w.x + 1.0;
            const double byLnC = lobe.c * slope.y * w.y + 1.0;
            const double byK = 1.0 / (lobe.k + 1.0) + 0.5 * std::log(v.z * v.z / length2) -
                               0.5 / (lobe.k + 3.0) * (byLnA + byLnC);
            const auto i = static_cast<Eigen::Index>(at);
            if (options_.roundAbout) {
                jacobian(i, o) = weighted * (byLnA + byLnC);
            } else {
                jacobian(i, o) = weighted * byLnA;
                jacobian(i, o + 1) = weighted * (slope.x * w.z - s.skew / det);
                jacobian(i, o + 2) = weighted * byLnC;
                jacobian(i, o + 3) = weighted * (slope.z * lobe.a * w.x - lobe.b / det);
            }
            jacobian(i, o + 4) = weighted * byK * s.powerSlope;
            jacobian(i, o + 5) = weighted;
        }
    }

    const std::vector<LobeSample>* samples_;
    FitOptions options_;
    Eigen::VectorXd start_;
    std::vector<double> factors_;
};

constexpr double kFurthestLogit = 4.0;

Eigen::VectorXd numbersOf(const LobeFit& fit, const FitOptions& options) {
    Eigen::VectorXd x(kAll);
    for (size_t j = 0; j < kLobes; ++j) {
        const LobeShape5& shape = fit.shapes[j];
        const double share = options.cosines ? 0.0 : (shape[4] - kLogLowest) / kLogRange;
        const double furthest = powerShare(kFurthestLogit);
        const double inside = std::clamp(share, 1.0 - furthest, furthest);
        const Eigen::Index o = kNumbers * static_cast<Eigen::Index>(j);
        for (Eigen::Index i = 0; i < 4; ++i)
            x[o + i] = shape[static_cast<size_t>(i)];
        x[o + 4] = std::log(inside / (1.0 - inside));
        x[o + 5] = std::log(std::max(fit.weights[j], 1e-6));
    }
    return x;
}

LobeFit fitOf(const Residuals& residuals, const Eigen::VectorXd& x) {
    LobeFit fit;
    for (size_t j = 0; j < kLobes; ++j) {
        const SearchLobe s = residuals.lobeAt(x, static_cast<Eigen::Index>(j));
        const double scale = std::sqrt(s.lobe.k + 3.0);
        fit.shapes[j] = {std::log(s.lobe.a * scale), s.lobe.b, std::log(s.lobe.c * scale), s.skew,
                         std::log(s.lobe.k)};
        fit.weights[j] = s.weight;
    }
    Eigen::VectorXd r(residuals.values());
    residuals(x, r);
    fit.cost = r.head(residuals.values() - residuals.inputs()).squaredNorm();
    return fit;
}

double albedoOf(const std::vector<LobeSample>& samples, size_t drawn) {
    double albedo = 0.0;
    for (const LobeSample& s : samples)
        albedo += s.value / s.density;
    return albedo / static_cast<double>(drawn);
}

/// tan of the angle from the mirrored direction within which half of the light is.
double medianSlope(const std::vector<LobeSample>& samples) {
    std::vector<std::pair<double, double>> slopes;
    double total = 0.0;
    for (const LobeSample& s : samples) {
        slopes.emplace_back(s.w.z > 0.0 ? std::hypot(s.w.x, s.w.y) / s.w.z : HUGE_VAL, s.value / s.density);
        total += slopes.back().second;
    }
    std::sort(slopes.begin(), slopes.end());
    constexpr double kSteepest = 3.0;
    double sum = 0.0;
    for (const auto& [slope, light] : slopes) {
        sum += light;
        if (sum >= 0.5 * total) return std::clamp(slope, 1e-9, kSteepest);
    }
    return kSteepest;
}

}  // namespace

TransformedLobe lobeOf(const LobeShape5& shape) {
    TransformedLobe lobe;
    lobe.k = std::exp(shape[4]);
    const double scale = 1.0 / std::sqrt(lobe.k + 3.0);
    lobe.a = std::exp(shape[0]) * scale;
    lobe.b = shape[1];
    lobe.c = std::exp(shape[2]) * scale;
    lobe.d = shape[3] * lobe.a;
    return lobe;
}

LobeFit improve(const LobeFit& start, const std::vector<LobeSample>& samples, size_t drawn,
                const FitOptions& options) {
    Eigen::VectorXd x = numbersOf(start, options);
    Residuals residuals(samples, drawn, options, x);
    Eigen::LevenbergMarquardt<Residuals> search(residuals);
    search.parameters.maxfev = options.evaluations;
    search.parameters.ftol = search.parameters.xtol = 1e-5;
    search.parameters.factor = 1.0;
    search.minimize(x);
    return fitOf(residuals, x);
}

double costOf(const LobeFit& fit, const std::vector<LobeSample>& samples, size_t drawn, bool cosines) {
    FitOptions options;
    options.cosines = cosines;
    const Eigen::VectorXd x = numbersOf(fit, options);
    return fitOf(Residuals(samples, drawn, options, x), x).cost;
}

LobeFit fitFresh(const std::vector<LobeSample>& samples, size_t drawn, const FitOptions& options) {
    const double slope = medianSlope(samples);
    const double weight = albedoOf(samples, drawn) / static_cast<double>(kLobes);
    LobeFit best;
    best.cost = INFINITY;
    for (double k : {1.5, 10.0, 50.0}) {
        if (options.cosines && k > 2.0) break;
        const double power = options.cosines ? 1.0 : k;
        // Half of a cosine power is within this tan.
        const double median = std::sqrt(std::exp2(2.0 / (power + 1.0)) - 1.0);
        const double width = std::log(median / slope * std::sqrt(power + 3.0));
        for (double shift : {0.0, 0.5, -0.5}) {
            if (options.roundAbout && shift != 0.0) break;
            const double spread = shift == 0.0 ? 0.4 : 0.0;
            LobeFit start;
            start.shapes = {LobeShape5{width + spread, shift, width + spread, 0.0, std::log(power)},
                            LobeShape5{width - spread, -shift, width - spread, 0.0, std::log(power)}};
            start.weights = {weight, weight};
            const LobeFit fit = improve(start, samples, drawn, options);
            if (fit.cost < best.cost) best = fit;
        }
    }
    return best;
}

std::array<double, kLobes> weightsFor(const Shapes& shapes, const std::vector<LobeSample>& samples,
                                      size_t drawn, const std::vector<double>& values) {
    static_assert(kLobes == 2);
    const TransformedLobe first = lobeOf(shapes[0]), second = lobeOf(shapes[1]);
    const double scale = albedoOf(samples, drawn);
    double aa = 0.0, ab = 0.0, bb = 0.0, af = 0.0, bf = 0.0;
    double albedo = 0.0, firstAlbedo = 0.0, secondAlbedo = 0.0;
    for (size_t i = 0; i < samples.size(); ++i) {
        const LobeSample& s = samples[i];
        const double w = 1.0 / (s.density * (s.value / scale + s.density));
        const double a = first.density(s.w), b = second.density(s.w), f = values[i];
        aa += w * a * a;
        ab += w * a * b;
        bb += w * b * b;
        af += w * a * f;
        bf += w * b * f;
        albedo += f / s.density;
        firstAlbedo += a / s.density;
        secondAlbedo += b / s.density;
    }
    if (!(albedo > 0.0)) return {0.0, 0.0};
    // A lobe that is nearly all below the horizon would need a weight beyond all measure.
    constexpr double kLeastAbove = 0.15;
    const double most = std::max(firstAlbedo, secondAlbedo);
    const auto drowned = [&](double above) {
        return above / static_cast<double>(drawn) < kLeastAbove && above < most;
    };
    if (drowned(firstAlbedo)) aa = ab = af = 0.0;
    if (drowned(secondAlbedo)) bb = ab = bf = 0.0;
    const double det = aa * bb - ab * ab;
    std::array<double, kLobes> weights{};
    if (aa * bb > 0.0 && det > 1e-12 * aa * bb)
        weights = {(af * bb - bf * ab) / det, (bf * aa - af * ab) / det};
    if (!(weights[0] >= 0.0 && weights[1] >= 0.0) || !(aa * bb > 0.0 && det > 1e-12 * aa * bb)) {
        const double onlyFirst = aa > 0.0 ? af / aa : 0.0, onlySecond = bb > 0.0 ? bf / bb : 0.0;
        if (onlyFirst * af >= onlySecond * bf)
            weights = {onlyFirst, 0.0};
        else
            weights = {0.0, onlySecond};
    }
    const double above = weights[0] * firstAlbedo + weights[1] * secondAlbedo;
    if (!(above > 0.0)) return {0.0, 0.0};
    for (double& weight : weights)
        weight *= albedo / above;
    return weights;
}

}  // namespace lobe::fit
