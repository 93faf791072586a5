#include "fit/lobe_fit.hpp"

#include <algorithm>
#include <cmath>

namespace lobe::fit {
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

std::vector<Weights> weightsFor(const Shapes& shapes, const Weights& ofMean,
                                const std::vector<LobeSample>& samples,
                                const std::vector<std::vector<double>>& colors) {
    static_assert(kLobes == 2);
    const TransformedLobe first = lobeOf(shapes[0]), second = lobeOf(shapes[1]);
    double mean = 0.0;
    std::vector<double> albedo(colors.size());
    for (size_t i = 0; i < samples.size(); ++i) {
        mean += samples[i].value / samples[i].density;
        for (size_t c = 0; c < colors.size(); ++c)
            albedo[c] += colors[c][i] / samples[i].density;
    }
    std::vector<Weights> result(colors.size(), Weights{});
    if (!(mean > 0.0)) return result;
    // What a colour differs by from its share of the mean is distributed by least squares.
    double aa = 0.0, ab = 0.0, bb = 0.0, aboveA = 0.0, aboveB = 0.0;
    std::vector<double> af(colors.size()), bf(colors.size());
    const double scale = mean / static_cast<double>(samples.size());
    for (size_t i = 0; i < samples.size(); ++i) {
        const LobeSample& s = samples[i];
        const double a = first.density(s.w), b = second.density(s.w);
        const double w = 1.0 / (s.density * (s.value / scale + s.density));
        aa += w * a * a;
        ab += w * a * b;
        bb += w * b * b;
        aboveA += a / s.density;
        aboveB += b / s.density;
        for (size_t c = 0; c < colors.size(); ++c) {
            const double differs = colors[c][i] - albedo[c] / mean * s.value;
            af[c] += w * a * differs;
            bf[c] += w * b * differs;
        }
    }
    const double det = aa * bb - ab * ab;
    const bool apart = det > 1e-3 * aa * bb;
    // `ofMean` may be in any unit: what is above the horizon says in which.
    const double aboveOfMean = ofMean[0] * aboveA + ofMean[1] * aboveB;
    if (!(aboveOfMean > 0.0)) return result;
    for (size_t c = 0; c < colors.size(); ++c) {
        const double share = albedo[c] / aboveOfMean;
        Weights weights{ofMean[0] * share, ofMean[1] * share};
        if (apart) {
            weights[0] = std::max(weights[0] + (af[c] * bb - bf[c] * ab) / det, 0.0);
            weights[1] = std::max(weights[1] + (bf[c] * aa - af[c] * ab) / det, 0.0);
        }
        const double above = weights[0] * aboveA + weights[1] * aboveB;
        if (!(albedo[c] > 0.0 && above > 0.0)) continue;
        for (size_t j = 0; j < kLobes; ++j)
            result[c][j] = weights[j] * (albedo[c] / above);
    }
    return result;
}

}  // namespace lobe::fit
