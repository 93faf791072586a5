#include "fit/lobe_fit.hpp"

#include <algorithm>
#include <cmath>

namespace lobe::fit {
namespace {

/// Products of two lobes and a colour, summed over the samples.
struct Sums {
    double aa = 0.0, ab = 0.0, bb = 0.0;  // of the lobes
    double aboveA = 0.0, aboveB = 0.0;    // what of each lies above the horizon
};

/// A lobe that is nearly all below the horizon would need a weight beyond all measure.
constexpr double kLeastAbove = 0.15;

Weights leastSquares(const Sums& lobes, double af, double bf) {
    const double det = lobes.aa * lobes.bb - lobes.ab * lobes.ab;
    if (det > 1e-12 * lobes.aa * lobes.bb) {
        const Weights weights{(af * lobes.bb - bf * lobes.ab) / det, (bf * lobes.aa - af * lobes.ab) / det};
        if (weights[0] >= 0.0 && weights[1] >= 0.0) return weights;
    }
    const double onlyA = lobes.aa > 0.0 ? af / lobes.aa : 0.0, onlyB = lobes.bb > 0.0 ? bf / lobes.bb : 0.0;
    if (onlyA * af >= onlyB * bf) return {onlyA, 0.0};
    return {0.0, onlyB};
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

std::vector<Weights> weightsFor(const Shapes& shapes, const std::vector<LobeSample>& samples, size_t drawn,
                                const std::vector<std::vector<double>>& colors) {
    static_assert(kLobes == 2);
    const TransformedLobe first = lobeOf(shapes[0]), second = lobeOf(shapes[1]);
    double scale = 0.0;
    for (const LobeSample& s : samples)
        scale += s.value / s.density;
    scale /= static_cast<double>(drawn);
    Sums sums;
    std::vector<double> af(colors.size()), bf(colors.size()), albedo(colors.size());
    for (size_t i = 0; i < samples.size(); ++i) {
        const LobeSample& s = samples[i];
        const double a = first.density(s.w), b = second.density(s.w);
        const double w = 1.0 / (s.density * (s.value / scale + s.density));
        sums.aa += w * a * a;
        sums.ab += w * a * b;
        sums.bb += w * b * b;
        sums.aboveA += a / s.density;
        sums.aboveB += b / s.density;
        for (size_t c = 0; c < colors.size(); ++c) {
            const double f = colors[c][i];
            af[c] += w * a * f;
            bf[c] += w * b * f;
            albedo[c] += f / s.density;
        }
    }
    const double most = std::max(sums.aboveA, sums.aboveB);
    const auto drowned = [&](double above) {
        return above / static_cast<double>(drawn) < kLeastAbove && above < most;
    };
    const bool noA = drowned(sums.aboveA), noB = drowned(sums.aboveB);
    if (noA) sums.aa = sums.ab = 0.0;
    if (noB) sums.bb = sums.ab = 0.0;
    std::vector<Weights> result;
    for (size_t c = 0; c < colors.size(); ++c) {
        Weights weights = leastSquares(sums, noA ? 0.0 : af[c], noB ? 0.0 : bf[c]);
        const double above = weights[0] * sums.aboveA + weights[1] * sums.aboveB;
        if (!(albedo[c] > 0.0 && above > 0.0)) {
            result.push_back({0.0, 0.0});
            continue;
        }
        for (double& weight : weights)
            weight *= albedo[c] / above;
        result.push_back(weights);
    }
    return result;
}

}  // namespace lobe::fit
