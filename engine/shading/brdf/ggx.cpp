/// Microfacets with the slopes of Trowbridge and Reitz, of two widths.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shading/microfacet.hpp"

namespace lobe::brdf_entry {
namespace {

constexpr double kMinAlpha = 1e-4;

struct Widths {
    double x, y, rotation;

    glm::dvec3 turned(const glm::dvec3& v) const {
        const double c = std::cos(rotation);
        const double s = std::sin(rotation);
        return {c * v.x + s * v.y, c * v.y - s * v.x, v.z};
    }
};

double distribution(const glm::dvec3& h, const Widths& a) {
    const double q = h.x * h.x / (a.x * a.x) + h.y * h.y / (a.y * a.y) + h.z * h.z;
    return 1.0 / (glm::pi<double>() * a.x * a.y * q * q);
}

/// Smith's Lambda (Heitz 2014, equations 72 and 80).
double lambda(const glm::dvec3& w, const Widths& a) {
    const double stretched = (a.x * a.x * w.x * w.x + a.y * a.y * w.y * w.y) / (w.z * w.z);
    return (std::sqrt(1.0 + stretched) - 1.0) / 2.0;
}

double distribution(const Directions& d, const Widths& a) {
    return distribution(a.turned(glm::normalize(d.h)), a);
}

double masking(const Directions& d, const Widths& a) {
    return 1.0 / (1.0 + lambda(a.turned(d.wi), a) + lambda(a.turned(d.wo), a));
}

double lobe(const Directions& d, const Widths& a) {
    return distribution(d, a) * masking(d, a) / (4.0 * d.wi.z * d.wo.z);
}

}  // namespace

Brdf ggx() {
    using namespace shading;
    Brdf brdf;
    brdf.name = "ggx";
    brdf.title = "GGX, anisotropic";
    brdf.source =
        "T. S. Trowbridge and K. P. Reitz, Average irregularity representation of a rough surface for ray "
        "reflection, JOSA 65(5), 1975; B. Walter et al., EGSR 2007; E. Heitz, JCGT 3(2), 2014";
    Parameter rotation =
        scalarParameter("rotation", 0.0, -7.0, 7.0, "turns the tangent about the normal, counter-clockwise");
    rotation.unit = "rad";
    brdf.parameters = microfacetParameters(
        {scalarParameter("alphaX", 0.3, kMinAlpha, 1.0, "width along the turned tangent"),
         scalarParameter("alphaY", 0.3, kMinAlpha, 1.0, "width across it"), rotation});
    // Conserving where diffuse + specular <= 1, which is not enforced.
    brdf.traits.energyConserving = false;
    brdf.traits.usesTangent = true;
    brdf.baseColorParameter = "diffuse";
    brdf.fCos = [](const Directions& d, std::span<const double> values) {
        return aboveSurface(d) ? microfacetFCos(d, values, lobe(d, {values[6], values[7], values[8]}))
                               : glm::dvec3(0.0);
    };
    brdf.factors = [](const Directions& d, std::span<const double> values) {
        const Widths a{values[6], values[7], values[8]};
        return microfacetFactors(d, values, distribution(d, a), masking(d, a));
    };
    brdf.area = microfacetArea([](const Directions& d, std::span<const double> values) {
        return lobe(d, {values[6], values[7], values[8]});
    });
    brdf.area->powerTail = true;
    brdf.area->refuses = [](std::span<const double> values) {
        return values[6] == values[7] ? "" : "its lobe has two widths";
    };
    brdf.ambient = microfacetAmbient;
    brdf.lobeSharpness = [](std::span<const double> values) {
        return hasSpecular(values) ? 2.0 / std::min(values[6], values[7]) : 0.0;
    };
    // D <= 1 / (pi ax ay), and the masking over 4 cos(theta_o) is at most 1 / (2 |(ax ox, ay oy, oz)|).
    brdf.peak = [](std::span<const double> values) {
        return microfacetPeak(values, 0.5 / (glm::pi<double>() * values[6] * values[7] *
                                             std::min({values[6], values[7], 1.0})));
    };
    brdf.samplingLobes = [](const glm::dvec3& wo, std::span<const double> values) {
        return microfacetLobes(wo, values,
                               {LobeShape::ggxVisibleNormals, 0.0, values[6], values[7], values[8]});
    };
    brdf.fromMetallicRoughness = [](const MetallicRoughness& surface) {
        const double alpha = std::max(surface.roughness * surface.roughness, kMinAlpha);
        return microfacetFromMetallicRoughness(surface, {alpha, alpha, 0.0});
    };
    return brdf;
}

}  // namespace lobe::brdf_entry
