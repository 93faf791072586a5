#include "environment/split_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/lobe_samples.hpp"
#include "math/sphere.hpp"

namespace lobe::environment {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr size_t kDraws = 2048;
constexpr int kBaseGrid = 24;  ///< points along each side of the square, of the base's mean

/// How much each term counts where one number must stand for all.
std::array<double, 2> weightsOf(const Brdf& brdf, std::span<const double> values) {
    const AreaWeights weights = brdf.area->weights(values);
    std::array<double, 2> result{};
    for (size_t t = 0; t < 2; ++t)
        result[t] = (weights.terms[t].r + weights.terms[t].g + weights.terms[t].b) / 3.0;
    if (result[0] + result[1] <= 0.0) result = {1.0, 1.0};
    return result;
}

double brightness(const AreaTerms& terms, const std::array<double, 2>& weights) {
    double sum = 0.0;
    for (size_t t = 0; t < 2; ++t)
        sum += weights[t] * (terms.terms[t].r + terms.terms[t].g + terms.terms[t].b) / 3.0;
    return sum;
}

double baseMean(const Brdf& brdf, std::span<const double> values, const glm::dvec3& wo) {
    if (!brdf.area->baseVaries) return 1.0;
    double sum = 0.0;
    for (int j = 0; j < kBaseGrid; ++j)
        for (int i = 0; i < kBaseGrid; ++i) {
            const glm::dvec3 wi = cosineHemisphere({(i + 0.5) / kBaseGrid, (j + 0.5) / kBaseGrid});
            sum += brdf.area->parts(Directions(wi, wo), values).base;
        }
    return sum / (kBaseGrid * kBaseGrid);
}

}  // namespace

double cosineOfNode(int node) {
    const double root = std::max(static_cast<double>(node) / (kAngles - 1), 0.25 / (kAngles - 1));
    return root * root;
}

std::vector<SplitNode> splitNodes(const Brdf& brdf, std::span<const double> values) {
    std::vector<SplitNode> nodes(kAngles);
    const std::array<double, 2> weights = weightsOf(brdf, values);
    const std::vector<glm::dvec3> draws = fit::spreadDraws(kDraws);
    for (int n = 0; n < kAngles; ++n) {
        const fit::View view(1.0 - cosineOfNode(n));
        SplitNode& node = nodes[static_cast<size_t>(n)];
        node.base = baseMean(brdf, values, view.wo);
        if (brdf.area->terms == 0) continue;
        glm::dvec3 middle(0.0);
        double total = 0.0;
        for (const fit::TermSample& sample : fit::sampleTerms(brdf, values, view, draws)) {
            for (size_t t = 0; t < 2; ++t)
                node.albedo[t] += sample.terms.terms[t] / (sample.density * kDraws);
            const double light = brightness(sample.terms, weights) / sample.density;
            middle += light * (view.frame * sample.w);
            total += light;
        }
        middle.y = 0.0;
        const double length = glm::length(middle);
        if (total > 0.0 && length > 0.0) {
            node.direction = {-middle.x / length, middle.z / length};
            node.spread = std::sqrt(std::max(2.0 * (1.0 - length / total), 0.0));
        } else {
            node.direction = {view.wo.x, view.wo.z};
        }
    }
    return nodes;
}

ZonalKernel lobeKernel(const Brdf& brdf, std::span<const double> values, const std::vector<SplitNode>& nodes,
                       double scale) {
    const std::array<double, 2> weights = weightsOf(brdf, values);
    const auto albedo = [&](const SplitNode& node) {
        AreaTerms terms;
        terms.terms = node.albedo;
        return brightness(terms, weights);
    };
    constexpr double kNextToNothing = 1e-2;
    const auto most =
        std::max_element(nodes.begin(), nodes.end(),
                         [&](const SplitNode& a, const SplitNode& b) { return albedo(a) < albedo(b); });
    const size_t from = albedo(nodes.back()) > kNextToNothing * albedo(*most)
                            ? nodes.size() - 1
                            : static_cast<size_t>(most - nodes.begin());
    if (albedo(nodes[from]) <= 0.0)
        return ZonalKernel([](double angle) { return std::max(std::cos(angle), 0.0); });
    const fit::View view(1.0 - cosineOfNode(static_cast<int>(from)));
    const glm::dmat3 about = frameAbout({-nodes[from].direction.x, 0.0, nodes[from].direction.y});
    return ZonalKernel([&](double angle) {
        const double wide = angle / scale;
        if (wide >= kPi) return 0.0;
        const int azimuths = from == nodes.size() - 1 ? 4 : 32;
        double sum = 0.0;
        for (int i = 0; i < azimuths; ++i) {
            const glm::dvec3 wi = about * fromPolar(wide, 2.0 * kPi * (i + 0.5) / azimuths);
            if (wi.z > 0.0) sum += brightness(brdf.area->parts(Directions(wi, view.wo), values), weights);
        }
        return sum / azimuths;
    });
}

}  // namespace lobe::environment
