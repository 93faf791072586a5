/// Microfacets with Beckmann's slopes, masked in V-grooves.
#include <algorithm>
#include <cmath>

#include "shading/microfacet.hpp"

namespace lobe::brdf_entry {
namespace {

constexpr double kMinSlope = 1e-5;

double masking(const Directions& d) {
    const glm::dvec3 h = glm::normalize(d.h);
    const double vh = 0.5 * glm::length(d.h);
    return std::min({1.0, 2.0 * h.z * d.wo.z / vh, 2.0 * h.z * d.wi.z / vh});
}

/// D G / (4 cos cos); the factor 4 belongs to the normalised D (docs/models/cook_torrance.md).
double lobe(const Directions& d, double m) {
    return shading::beckmann(glm::normalize(d.h), m) * masking(d) / (4.0 * d.wi.z * d.wo.z);
}

}  // namespace

Brdf cook_torrance() {
    using namespace shading;
    Brdf brdf;
    brdf.name = "cook_torrance";
    brdf.title = "Cook-Torrance";
    brdf.source =
        "R. L. Cook and K. E. Torrance, A reflectance model for computer graphics, SIGGRAPH 1981 and ACM TOG "
        "1(1), "
        "1982";
    Parameter m = scalarParameter("m", 0.3, kMinSlope, 10.0,
                                  "slope of the facets, sqrt(2) times RMS along one direction");
    brdf.parameters = microfacetParameters({m});
    // Conserving where diffuse + specular <= 1, which is not enforced.
    brdf.traits.energyConserving = false;
    brdf.baseColorParameter = "diffuse";
    brdf.fCos = [](const Directions& d, std::span<const double> values) {
        return aboveSurface(d) ? microfacetFCos(d, values, lobe(d, values[6])) : glm::dvec3(0.0);
    };
    brdf.factors = [](const Directions& d, std::span<const double> values) {
        return microfacetFactors(d, values, beckmann(glm::normalize(d.h), values[6]), masking(d));
    };
    brdf.area = microfacetArea(
        [](const Directions& d, std::span<const double> values) { return lobe(d, values[6]); });
    brdf.area->width = "m";
    brdf.ambient = microfacetAmbient;
    brdf.lobeSharpness = [](std::span<const double> values) {
        return hasSpecular(values) ? 2.0 / values[6] : 0.0;
    };
    brdf.samplingLobes = [](const glm::dvec3& wo, std::span<const double> values) {
        return microfacetLobes(wo, values, {LobeShape::gaussianSlopes, 0.0, values[6], values[6]});
    };
    brdf.fromMetallicRoughness = [](const MetallicRoughness& surface) {
        return microfacetFromMetallicRoughness(surface,
                                               {std::max(surface.roughness * surface.roughness, kMinSlope)});
    };
    return brdf;
}

}  // namespace lobe::brdf_entry
