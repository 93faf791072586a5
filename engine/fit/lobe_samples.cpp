#include "fit/lobe_samples.hpp"

#include "math/low_discrepancy.hpp"
#include "shading/sampling.hpp"

namespace lobe::fit {
namespace {

/// Without the lobe of Lambert's part, which is not fitted; a tenth of the draws goes to the cosine all the
/// same.
SamplingMixture mixtureOf(const Brdf& brdf, std::span<const double> values, const glm::dvec3& wo) {
    if (!brdf.samplingLobes) return BrdfSampler(brdf, values).at(wo);
    SamplingLobes lobes;
    for (const SamplingLobe& lobe : brdf.samplingLobes(wo, values).all())
        if (lobe.shape != LobeShape::cosine) lobes.add(lobe);
    return {lobes, wo};
}

}  // namespace

std::vector<glm::dvec3> spreadDraws(size_t count, uint64_t seed) {
    const OwenSobol points({0, 0}, seed);
    std::vector<glm::dvec3> draws;
    draws.reserve(count);
    for (uint32_t i = 0; i < count; ++i)
        draws.emplace_back(points.at(i, 0), points.at(i, 1), points.at(i, 2));
    return draws;
}

std::vector<TermSample> sampleTerms(const Brdf& brdf, std::span<const double> values, const View& view,
                                    std::span<const glm::dvec3> draws) {
    const SamplingMixture mixture = mixtureOf(brdf, values, view.wo);
    const glm::dmat3 toView = glm::transpose(view.frame);
    std::vector<TermSample> samples;
    samples.reserve(draws.size());
    for (const glm::dvec3& draw : draws) {
        const glm::dvec3 wi = sampleDirection(mixture, draw.x, draw.y, draw.z);
        if (!(wi.z > 0.0)) continue;
        const double density = samplingDensity(mixture, wi);
        samples.push_back({toView * wi, wi.z, density, brdf.area->parts(Directions(wi, view.wo), values)});
    }
    return samples;
}

}  // namespace lobe::fit
