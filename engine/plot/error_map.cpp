#include "plot/error_map.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "base/error.hpp"
#include "harness/comparison.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"
#include "math/ulp.hpp"
#include "plot/geometry.hpp"

namespace lobe::plot {
namespace {

/// Below, powers underflow before they are scaled (harness/comparison.cpp).
constexpr double kSmallest = 3e-27;

/// Half of them near the mirrored direction, the others anywhere.
std::vector<Pair> viewsOf(const glm::dvec3& wi, double sharpness) {
    const glm::dmat3 frame = frameAbout(mirrored(wi));
    std::vector<Pair> pairs;
    for (uint64_t i = 0; i < kErrorViews; ++i) {
        const glm::dvec2 u = halton2(i);
        glm::dvec3 wo = cosineHemisphere(u);
        if (i % 2 == 0) {
            const double distance = 5.0 * u.x / (1.0 + sharpness);
            wo = frame * fromPolar(distance, glm::two_pi<double>() * u.y);
            if (wo.z <= 0.0) wo = mirrored(wi);
        }
        pairs.push_back({wi, wo});
    }
    return pairs;
}

double ulpsApart(double got, double exact) {
    const auto nearest = static_cast<float>(std::abs(exact));
    const double spacing =
        double(std::nextafter(nearest, std::numeric_limits<float>::infinity())) - double(nearest);
    return std::abs(got - exact) / spacing;
}

/// Share of the allowance by channel; 0 where a value says nothing about the formula.
glm::dvec3 shareOf(const Model& model, const Directions& d, const glm::dvec3& got, const glm::dvec3& exact) {
    glm::dvec3 share(0.0);
    if (harness::tooNarrow(*model.brdf, d, model.values)) return share;
    const glm::dvec3 allowance =
        harness::kAllowedUnits * harness::roundingUnit(*model.brdf, d, model.values, harness::Axes::local);
    for (int c = 0; c < 3; ++c)
        if (exact[c] >= kSmallest && allowance[c] <= harness::kLargestAllowance)
            share[c] = std::abs(got[c] - exact[c]) / exact[c] / allowance[c];
    return share;
}

ErrorCell cellOf(const Model& model, std::span<const Pair> pairs, std::span<const Sample> samples) {
    ErrorCell cell{};
    for (size_t i = 0; i < pairs.size(); ++i) {
        const Directions d = harness::directionsOf(rowOf(model, pairs[i]));
        const glm::dvec3 exact = model.brdf->fCos(d, model.values);
        const glm::dvec3 share = shareOf(model, d, samples[i].fCos, exact);
        for (int c = 0; c < 3; ++c) {
            if (exact[c] < kSmallest) continue;
            cell.ulp = std::max(cell.ulp, ulpsApart(samples[i].fCos[c], exact[c]));
            cell.share = std::max(cell.share, share[c]);
        }
    }
    return cell;
}

}  // namespace

ErrorMap computeErrorMap(const Sampler& sampler, const ErrorRequest& request) {
    requireScatters(request.model);
    if (sampler.isTwin()) throw UsageError("--twin: the twin has no error against itself; leave it out");
    ErrorMap result{request, {}};
    for (double value : request.values) {
        const Model model =
            request.over.empty() ? request.model : withParameter(request.model, request.over, value);
        const double sharpness = model.brdf->lobeSharpness(model.values);
        std::vector<Pair> pairs;
        for (double angle : request.angles) {
            requireIncidence(angle);
            const std::vector<Pair> views = viewsOf(toLight(angle, request.azimuth), sharpness);
            pairs.insert(pairs.end(), views.begin(), views.end());
        }
        const std::vector<Sample> samples = sampler.sample(model, pairs);
        for (size_t a = 0; a < request.angles.size(); ++a) {
            const size_t first = a * kErrorViews;
            ErrorCell cell = cellOf(model, std::span(pairs).subspan(first, kErrorViews),
                                    std::span(samples).subspan(first, kErrorViews));
            cell.value = value;
            cell.angle = request.angles[a];
            if (cell.ulp >= result.worstUlp.ulp) result.worstUlp = cell;
            if (cell.share >= result.worstShare.share) result.worstShare = cell;
            result.cells.push_back(cell);
        }
    }
    return result;
}

}  // namespace lobe::plot
