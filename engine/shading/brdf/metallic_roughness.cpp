/// glTF's own model (specification 2.0, appendix B): diffuse base below a GGX lobe with height-correlated
/// Smith masking.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shading/fresnel.hpp"

namespace lobe::brdf_entry {
namespace {

/// Roughness 0 is a mirror, which no point light can show. alpha = roughness^2 is kept above this (roughness
/// 0.01): narrower lobes are not resolved by 32-bit directions and normals (2 / alpha times 6e-8 is 0.1 %
/// here).
constexpr double kMinAlpha = 1e-4;

double alphaOf(double roughness) {
    return std::max(roughness * roughness, kMinAlpha);
}

/// D (N.H) integrates to 1 over the hemisphere. `h` is unit.
double ggx(const glm::dvec3& h, double alpha) {
    const double q = (h.x * h.x + h.y * h.y) / (alpha * alpha) + h.z * h.z;
    return 1.0 / (glm::pi<double>() * alpha * alpha * q * q);
}

/// Smith's Lambda of a direction with cosine c.
double lambda(double c, double alpha) {
    const double tan2 = (1.0 - c) * (1.0 + c) / (c * c);
    return (std::sqrt(1.0 + alpha * alpha * tan2) - 1.0) / 2.0;
}

double masking(const Directions& d, double alpha) {
    return 1.0 / (1.0 + lambda(d.wi.z, alpha) + lambda(d.wo.z, alpha));
}

glm::dvec3 fresnelOf(const Directions& d, std::span<const double> values) {
    using namespace shading;
    const glm::dvec3 f0 = glm::mix(glm::dvec3(kDielectricF0), rgbAt(values, 0), values[3]);
    return f0 + (1.0 - f0) * std::pow(oneMinusCosThetaD(d), 5.0);
}

glm::dvec3 fCos(const Directions& d, std::span<const double> values) {
    using namespace shading;
    if (!aboveSurface(d)) return glm::dvec3(0.0);
    const glm::dvec3 baseColor = rgbAt(values, 0);
    const double metallic = values[3];
    const double alpha = alphaOf(values[4]);
    const glm::dvec3 fresnel = fresnelOf(d, values);
    const glm::dvec3 specular =
        fresnel * (masking(d, alpha) * ggx(glm::normalize(d.h), alpha) / (4.0 * d.wi.z * d.wo.z));
    const glm::dvec3 diffuse = (1.0 - fresnel) * baseColor * ((1.0 - metallic) / glm::pi<double>());
    return (diffuse + specular) * d.wi.z;
}

/// F = f0 + (1 - f0) S weighs the lobe; what it leaves, (1 - f0) (1 - S), the base.
AreaModel area() {
    AreaModel area;
    area.powerTail = true;
    area.terms = 2;
    area.baseVaries = true;
    area.colors = {"baseColor", "metallic"};
    area.width = "roughness";
    area.widths = {std::sqrt(kMinAlpha), 1.0};
    area.weights = [](std::span<const double> values) {
        const glm::dvec3 baseColor = shading::rgbAt(values, 0);
        const glm::dvec3 f0 = glm::mix(glm::dvec3(shading::kDielectricF0), baseColor, values[3]);
        return AreaWeights{(1.0 - f0) * baseColor * (1.0 - values[3]), {f0, glm::dvec3(1.0)}};
    };
    area.parts = [](const Directions& d, std::span<const double> values) {
        const double alpha = alphaOf(values[4]);
        const double schlick = std::pow(shading::oneMinusCosThetaD(d), 5.0);
        const double lobe = masking(d, alpha) * ggx(glm::normalize(d.h), alpha) / (4.0 * d.wo.z);
        return AreaTerms{1.0 - schlick, {glm::dvec3((1.0 - schlick) * lobe), glm::dvec3(schlick * lobe)}};
    };
    return area;
}

std::vector<BrdfFactor> factors(const Directions& d, std::span<const double> values) {
    const double alpha = alphaOf(values[4]);
    return {{"D", glm::dvec3(ggx(glm::normalize(d.h), alpha))},
            {"F", fresnelOf(d, values)},
            {"G", glm::dvec3(masking(d, alpha))}};
}

}  // namespace

Brdf metallic_roughness() {
    using namespace shading;
    Brdf brdf;
    brdf.name = "metallic_roughness";
    brdf.title = "glTF metallic-roughness";
    brdf.source =
        "Khronos, glTF 2.0 specification, appendix B; B. Walter et al., Microfacet models for refraction "
        "through rough "
        "surfaces, EGSR 2007; E. Heitz, Understanding the masking-shadowing function, JCGT 3(2), 2014";
    brdf.parameters = {
        colorParameter("baseColor", glm::dvec3(1.0),
                       "diffuse colour of dielectrics, normal reflectance of metals"),
        scalarParameter("metallic", 1.0, 0.0, 1.0, "0 dielectric, 1 metal"),
        scalarParameter("roughness", 1.0, 0.0, 1.0, "square root of GGX's alpha, which is kept above 1e-4")};
    // A metal's lobe alone conserves. A dielectric's diffuse base is dimmed by 1 - F(v.h) only, not by what
    // the lobe takes: the sum reaches 1.7 at grazing angles.
    brdf.traits.energyConserving = false;
    brdf.baseColorParameter = "baseColor";
    brdf.fCos = fCos;
    brdf.factors = factors;
    brdf.area = area();
    brdf.ambient = [](std::span<const double> values) { return rgbAt(values, 0); };
    brdf.lobeSharpness = [](std::span<const double> values) { return 2.0 / alphaOf(values[4]); };
    // As of ggx, with F at most 1.
    brdf.peak = [](std::span<const double> values) {
        const double alpha = alphaOf(values[4]);
        return rgbAt(values, 0) * ((1.0 - values[3]) / glm::pi<double>()) +
               0.5 / (glm::pi<double>() * alpha * alpha * alpha);
    };
    brdf.samplingLobes = [](const glm::dvec3& wo, std::span<const double> values) {
        const glm::dvec3 f0 = glm::mix(glm::dvec3(kDielectricF0), rgbAt(values, 0), values[3]);
        const double fresnel = meanOf(f0 + (1.0 - f0) * std::pow(1.0 - wo.z, 5.0));
        const double alpha = alphaOf(values[4]);
        return baseAndLobe((1.0 - values[3]) * meanOf(rgbAt(values, 0)) * (1.0 - fresnel),
                           {LobeShape::ggxVisibleNormals, fresnel, alpha, alpha});
    };
    brdf.fromMetallicRoughness = [](const MetallicRoughness& surface) {
        return ParameterValues{surface.baseColor.r, surface.baseColor.g, surface.baseColor.b,
                               surface.metallic, surface.roughness};
    };
    return brdf;
}

}  // namespace lobe::brdf_entry
