/// An anisotropic Phong lobe about the half vector with Fresnel reflection over a diffuse base.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shading/fresnel.hpp"
#include "shading/phong_family.hpp"

namespace lobe::brdf_entry {
namespace {

const double kPi = glm::pi<double>();
constexpr double kMaxExponent = 1e6;

struct Values {
    glm::dvec3 diffuse, specular;
    double nu, nv, rotation;
};

Values valuesOf(std::span<const double> v) {
    return {shading::rgbAt(v, 0), shading::rgbAt(v, 3), v[6], v[7], v[8]};
}

/// Equation 2 of the paper without F; (N.H)^e, e = nu cos^2(phi_h) + nv sin^2(phi_h).
double lobe(const Directions& d, const Values& p) {
    const glm::dvec3 h = glm::normalize(d.h);
    const double phi = std::atan2(h.y, h.x) - p.rotation;
    const double exponent = p.nu * std::pow(std::cos(phi), 2.0) + p.nv * std::pow(std::sin(phi), 2.0);
    const double power = shading::cosinePower(h.z, std::hypot(h.x, h.y), exponent);
    const double vh = 0.5 * glm::length(d.h);
    return std::sqrt((p.nu + 1.0) * (p.nv + 1.0)) / (8.0 * kPi) * power / (vh * std::max(d.wi.z, d.wo.z));
}

/// 1 - (1 - c / 2)^5, to all digits at grazing angles.
double throughCoat(double c) {
    return -std::expm1(5.0 * std::log1p(-0.5 * c));
}

glm::dvec3 fCos(const Directions& d, std::span<const double> values) {
    if (!shading::aboveSurface(d)) return glm::dvec3(0.0);
    const Values p = valuesOf(values);
    const glm::dvec3 fresnel = p.specular + (1.0 - p.specular) * std::pow(shading::oneMinusCosThetaD(d), 5.0);
    // Equation 5.
    const glm::dvec3 base =
        28.0 / (23.0 * kPi) * p.diffuse * (1.0 - p.specular) * throughCoat(d.wi.z) * throughCoat(d.wo.z);
    return (base + fresnel * lobe(d, p)) * d.wi.z;
}

AreaModel area() {
    AreaModel area;
    area.terms = 2;
    area.baseVaries = true;
    area.colors = {"diffuse", "specular"};
    area.weights = [](std::span<const double> values) {
        const Values p = valuesOf(values);
        return AreaWeights{p.diffuse * (1.0 - p.specular), {p.specular, glm::dvec3(1.0)}};
    };
    area.parts = [](const Directions& d, std::span<const double> values) {
        const double schlick = std::pow(shading::oneMinusCosThetaD(d), 5.0);
        const double value = lobe(d, valuesOf(values)) * d.wi.z;
        return AreaTerms{28.0 / 23.0 * throughCoat(d.wi.z) * throughCoat(d.wo.z),
                         {glm::dvec3((1.0 - schlick) * value), glm::dvec3(schlick * value)}};
    };
    area.refuses = [](std::span<const double> values) {
        return values[6] == values[7] ? "" : "its lobe has two widths";
    };
    return area;
}

}  // namespace

Brdf ashikhmin_shirley() {
    using namespace shading;
    Brdf brdf;
    brdf.name = "ashikhmin_shirley";
    brdf.title = "Ashikhmin-Shirley";
    brdf.source = "M. Ashikhmin and P. Shirley, An anisotropic Phong BRDF model, JGT 5(2), 2000";
    Parameter rotation =
        scalarParameter("rotation", 0.0, -7.0, 7.0, "turns the tangent about the normal, counter-clockwise");
    rotation.unit = "rad";
    brdf.parameters = {
        colorParameter("diffuse", glm::dvec3(0.5), "R_d: reflectance of the base"),
        colorParameter("specular", glm::dvec3(0.05), "R_s: reflectance of the coat at normal incidence"),
        scalarParameter("nu", 100.0, 0.0, kMaxExponent, "exponent along the turned tangent"),
        scalarParameter("nv", 100.0, 0.0, kMaxExponent, "exponent across it"), rotation};
    brdf.traits.usesTangent = true;
    brdf.baseColorParameter = "diffuse";
    brdf.fCos = fCos;
    brdf.area = area();
    brdf.ambient = [](std::span<const double> values) {
        const Values p = valuesOf(values);
        return p.diffuse * (1.0 - p.specular) + p.specular;
    };
    brdf.lobeSharpness = [](std::span<const double> values) {
        return std::sqrt(std::max(values[6], values[7]));
    };
    brdf.samplingLobes = [](const glm::dvec3& wo, std::span<const double> values) {
        const Values p = valuesOf(values);
        const double fresnel = meanOf(p.specular + (1.0 - p.specular) * std::pow(1.0 - wo.z, 5.0));
        return baseAndLobe(meanOf(p.diffuse * (1.0 - p.specular)),
                           {LobeShape::powerNormals, fresnel, p.nu, p.nv, p.rotation});
    };
    brdf.fromMetallicRoughness = [](const MetallicRoughness& surface) {
        // The coat takes its share of the base by itself.
        const glm::dvec3 diffuse = surface.baseColor * (1.0 - surface.metallic);
        const glm::dvec3 specular = glm::mix(glm::dvec3(kDielectricF0), surface.baseColor, surface.metallic);
        const double n = std::clamp(blinnExponent(surface.roughness), 0.0, kMaxExponent);
        return ParameterValues{diffuse.r,  diffuse.g, diffuse.b, specular.r, specular.g,
                               specular.b, n,         n,         0.0};
    };
    return brdf;
}

}  // namespace lobe::brdf_entry
