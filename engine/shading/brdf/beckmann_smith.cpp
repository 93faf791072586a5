/// Microfacets with Beckmann's slopes and the masking of Smith.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shading/microfacet.hpp"

namespace lobe::brdf_entry {
namespace {

constexpr double kMinSlope = 1e-5;

/// Smith's Lambda for Gaussian slopes (Walter et al. 2007; Heitz 2014, equation 67).
double lambda(const glm::dvec3& w, double m) {
    const double tangent = std::hypot(w.x, w.y) / w.z;
    if (tangent == 0.0) return 0.0;
    const double x = 1.0 / (m * tangent);
    return (std::exp(-x * x) / (x * std::sqrt(glm::pi<double>())) - std::erfc(x)) / 2.0;
}

double masking(const Directions& d, double m, bool separable) {
    const double i = lambda(d.wi, m);
    const double o = lambda(d.wo, m);
    return separable ? 1.0 / ((1.0 + i) * (1.0 + o)) : 1.0 / (1.0 + i + o);
}

double lobe(const Directions& d, double m, bool separable) {
    return shading::beckmann(glm::normalize(d.h), m) * masking(d, m, separable) / (4.0 * d.wi.z * d.wo.z);
}

}  // namespace

Brdf beckmann_smith() {
    using namespace shading;
    Brdf brdf;
    brdf.name = "beckmann_smith";
    brdf.title = "Beckmann with Smith masking";
    brdf.source =
        "B. Walter et al., Microfacet models for refraction through rough surfaces, EGSR 2007; E. Heitz, "
        "Understanding "
        "the masking-shadowing function, JCGT 3(2), 2014";
    brdf.parameters =
        microfacetParameters({scalarParameter("m", 0.3, kMinSlope, 10.0,
                                              "slope of the facets, sqrt(2) times RMS along one direction"),
                              choiceParameter("masking", {"correlated", "separable"},
                                              "of both directions: by height, or independent")});
    // Conserving where diffuse + specular <= 1, which is not enforced.
    brdf.traits.energyConserving = false;
    brdf.baseColorParameter = "diffuse";
    brdf.fCos = [](const Directions& d, std::span<const double> values) {
        return aboveSurface(d) ? microfacetFCos(d, values, lobe(d, values[6], values[7] == 1.0))
                               : glm::dvec3(0.0);
    };
    brdf.factors = [](const Directions& d, std::span<const double> values) {
        return microfacetFactors(d, values, beckmann(glm::normalize(d.h), values[6]),
                                 masking(d, values[6], values[7] == 1.0));
    };
    brdf.area = microfacetArea([](const Directions& d, std::span<const double> values) {
        return lobe(d, values[6], values[7] == 1.0);
    });
    brdf.area->width = "m";
    brdf.ambient = microfacetAmbient;
    brdf.lobeSharpness = [](std::span<const double> values) {
        return hasSpecular(values) ? 2.0 / values[6] : 0.0;
    };
    // D is largest at the normal, or where tan^2 = 2 m^2 - 1; G / cos(theta_o) is below 1 / ((1 + Lambda)
    // cos), which grows towards the horizon to 2 sqrt(pi) / m where m <= 1, and is at most 2 sqrt(pi) beyond.
    brdf.peak = [](std::span<const double> values) {
        const double m = values[6], pi = glm::pi<double>();
        const double normal = 1.0 / (pi * m * m);
        const double ring = m * m > 0.5 ? 4.0 * m * m * std::exp(1.0 / (m * m) - 2.0) / pi : 0.0;
        return microfacetPeak(values, std::max(normal, ring) * std::sqrt(pi) / (2.0 * std::min(m, 1.0)));
    };
    brdf.samplingLobes = [](const glm::dvec3& wo, std::span<const double> values) {
        return microfacetLobes(wo, values, {LobeShape::gaussianSlopes, 0.0, values[6], values[6]});
    };
    brdf.fromMetallicRoughness = [](const MetallicRoughness& surface) {
        return microfacetFromMetallicRoughness(
            surface, {std::max(surface.roughness * surface.roughness, kMinSlope), 0.0});
    };
    return brdf;
}

}  // namespace lobe::brdf_entry
