/// BrdfSampler: a model's own lobes, or some that are measured on its twin.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shading/sampling.hpp"

namespace lobe {

BrdfSampler::BrdfSampler(const Brdf& brdf, std::span<const double> values)
    : brdf_(&brdf), values_(values.begin(), values.end()) {
    requireTwin(brdf);
    if (brdf.samplingLobes || !brdf.traits.scattersLight) return;
    for (size_t i = 0; i < kFits; ++i) {
        const double elevation = glm::half_pi<double>() * (static_cast<double>(i) + 0.5) / kFits;
        fits_[i] = fitAt({std::cos(elevation), 0.0, std::sin(elevation)});
    }
}

/// Along half vectors that tilt across the plane of incidence: what stands above the least value is the lobe,
/// and half of its light lies within tan(theta_h) = alpha, as GGX's does.
BrdfSampler::Fit BrdfSampler::fitAt(const glm::dvec3& wo) const {
    constexpr size_t kSteps = 64;
    constexpr double kNarrowest = 1e-4;
    std::array<double, kSteps> slopes{}, reflected{};
    double least = INFINITY;
    for (size_t i = 0; i < kSteps; ++i) {
        slopes[i] = kNarrowest * std::pow(1e4, static_cast<double>(i) / (kSteps - 1));
        const glm::dvec3 h = glm::normalize(glm::dvec3(0.0, slopes[i], 1.0));
        const Directions d(2.0 * glm::dot(wo, h) * h - wo, wo);
        if (d.wi.z <= 0.0) {
            reflected[i] = -1.0;
            continue;
        }
        const glm::dvec3 f = brdf_->fCos(d, values_) / d.wi.z;
        reflected[i] = (f.r + f.g + f.b) / 3.0;
        least = std::min(least, reflected[i]);
    }
    // d(omega_i) = 4 v.h d(omega_h), and equal steps of ln(slope).
    const double ratio = std::pow(1e4, 1.0 / (kSteps - 1));
    std::array<double, kSteps> mass{};
    double total = 0.0;
    for (size_t i = 0; i < kSteps; ++i) {
        const double secant2 = 1.0 + slopes[i] * slopes[i];
        const double vh = wo.z / std::sqrt(secant2);
        const double above = std::max(reflected[i] - least, 0.0) * (2.0 * vh / std::sqrt(secant2) - wo.z);
        total += std::max(above, 0.0) * 4.0 * vh * glm::two_pi<double>() * slopes[i] * slopes[i] *
                 std::log(ratio) / (secant2 * std::sqrt(secant2));
        mass[i] = total;
    }
    const auto median =
        static_cast<size_t>(std::lower_bound(mass.begin(), mass.end(), 0.5 * total) - mass.begin());
    return {slopes[std::min(median, kSteps - 1)], total,
            std::isfinite(least) ? least * glm::pi<double>() : 0.0};
}

SamplingMixture BrdfSampler::at(const glm::dvec3& wo) const {
    if (!brdf_->traits.scattersLight) return {};
    if (brdf_->samplingLobes) return {brdf_->samplingLobes(wo, values_), wo};
    const double elevation = std::atan2(wo.z, std::hypot(wo.x, wo.y)) / glm::half_pi<double>();
    const Fit& fit = fits_[std::min(static_cast<size_t>(elevation * kFits), kFits - 1)];
    SamplingLobes lobes;
    lobes.add({LobeShape::cosine, fit.diffuse});
    lobes.add({LobeShape::ggxVisibleNormals, fit.specular, fit.alpha, fit.alpha});
    return {lobes, wo};
}

}  // namespace lobe
