#include "plot/albedo.hpp"

#include <algorithm>
#include <cmath>

#include "math/quadrature.hpp"
#include "plot/geometry.hpp"

namespace lobe::plot {
namespace {

constexpr int kOrder = 6;
constexpr int kPolarPanels = 16;

/// Visits the nodes of the hemisphere about the mirrored direction in a fixed order.
double integrate(const std::function<double(const glm::dvec3&)>& f, const glm::dvec3& axis,
                 const std::vector<double>& breaks) {
    static const QuadratureRule rule = gaussLegendre(kOrder);
    // A lobe of half vectors is narrower across the plane of incidence than along it, by cos(theta).
    const int azimuthPanels = std::clamp(static_cast<int>(std::ceil(4.0 / axis.z)), 8, 96);
    return integrateHemisphere(f, axis, breaks, azimuthPanels, rule);
}

}  // namespace

std::vector<glm::dvec3> directionalAlbedo(const Sampler& sampler, const Model& model,
                                          const std::vector<double>& angles, double azimuth) {
    const std::vector<double> breaks =
        gradedBreaks(0.1 / (1.0 + model.brdf->lobeSharpness(model.values)), 1.0, kPolarPanels);
    // The quadrature asks for one value at a time and the GPU gives many: once to learn the nodes, then once
    // a channel with their values.
    std::vector<Pair> pairs;
    std::vector<size_t> firsts;
    for (double angle : angles) {
        requireIncidence(angle);
        firsts.push_back(pairs.size());
        const glm::dvec3 wi = toLight(angle, azimuth);
        pairs.push_back({wi, mirrored(wi)});  // for the mirrored part
        integrate(
            [&](const glm::dvec3& wo) {
                pairs.push_back({wi, wo});
                return 0.0;
            },
            mirrored(wi), breaks);
    }
    const std::vector<Sample> samples = sampler.sample(model, pairs);
    std::vector<glm::dvec3> albedos;
    for (size_t a = 0; a < angles.size(); ++a) {
        glm::dvec3 albedo = samples[firsts[a]].mirror;
        const glm::dvec3 wi = pairs[firsts[a]].wi;
        for (int c = 0; c < 3; ++c) {
            size_t next = firsts[a];
            albedo[c] +=
                integrate([&](const glm::dvec3& wo) { return samples[++next].fCos[c] / wi.z * wo.z; },
                          mirrored(wi), breaks);
        }
        albedos.push_back(albedo);
    }
    return albedos;
}

Albedo computeAlbedo(const Sampler& sampler, const AlbedoRequest& request) {
    Albedo result{request, {}};
    for (double value : request.values) {
        const Model model =
            request.over.empty() ? request.model : withParameter(request.model, request.over, value);
        std::vector<double> row;
        for (const glm::dvec3& albedo : directionalAlbedo(sampler, model, request.angles, request.azimuth))
            row.push_back(channelOf(albedo, request.channel));
        result.albedo.push_back(std::move(row));
    }
    return result;
}

}  // namespace lobe::plot
