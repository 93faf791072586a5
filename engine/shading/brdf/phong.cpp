/// Cosine power about the mirrored direction: k_s (R.V)^n.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shading/phong_family.hpp"

namespace lobe::brdf_entry {
namespace {

/// (R.V)^n with what is beside k_s, and cos(theta_i) in the form "energy".
double lobe(const Directions& d, const shading::PhongValues& p) {
    const glm::dvec3 normal(0.0, 0.0, 1.0);
    const glm::dvec3 mirrored = 2.0 * d.wi.z * normal - d.wi;
    const double power =
        shading::cosinePower(glm::dot(mirrored, d.wo), glm::length(glm::cross(mirrored, d.wo)), p.shininess);
    return p.energy ? (p.shininess + 2.0) / (2.0 * glm::pi<double>()) * power * d.wi.z : power;
}

glm::dvec3 fCos(const Directions& d, std::span<const double> values) {
    using namespace shading;
    if (!aboveSurface(d)) return glm::dvec3(0.0);
    const PhongValues p = phongValues(values);
    return p.diffuse * (p.energy ? d.wi.z / glm::pi<double>() : d.wi.z) + p.specular * lobe(d, p);
}

/// As cos^n about the mirrored direction.
SamplingLobes lobes(const glm::dvec3& wo, std::span<const double> values) {
    const shading::PhongValues p = shading::phongValues(values);
    // Of the classic form, in units of pi: k_d, and 2 / (n + 1) for the lobe.
    const double scale = p.energy ? 1.0 : 2.0 / (p.shininess + 1.0);
    return shading::baseAndLobe(shading::meanOf(p.diffuse),
                                {LobeShape::power, scale * shading::meanOf(p.specular), p.shininess, 0.0, 0.0,
                                 glm::dvec3(-wo.x, -wo.y, wo.z)});
}

}  // namespace

Brdf phong() {
    using namespace shading;
    Brdf brdf;
    brdf.name = "phong";
    brdf.title = "Phong";
    brdf.source =
        "B. T. Phong, Illumination for computer generated pictures, CACM 18(6), 1975; energy: E. P. "
        "Lafortune and "
        "Y. D. Willems, Using the modified Phong reflectance model for physically based rendering, CW 197, "
        "1994";
    brdf.parameters = phongParameters();
    // "classic" is neither; "energy" is reciprocal, and conserving where diffuse + specular <= 1.
    brdf.traits.reciprocal = false;
    brdf.traits.energyConserving = false;
    brdf.traits.halfVectorLobe = false;
    brdf.baseColorParameter = "diffuse";
    brdf.fCos = fCos;
    brdf.peak = [](std::span<const double> values) {
        const PhongValues p = phongValues(values);
        const double pi = glm::pi<double>();
        return p.energy ? p.diffuse / pi + p.specular * ((p.shininess + 2.0) / (2.0 * pi))
                        : p.diffuse + p.specular;
    };
    brdf.samplingLobes = lobes;
    brdf.area = phongArea(lobe);
    brdf.ambient = phongAmbient;
    brdf.lobeSharpness = [](std::span<const double> values) {
        const PhongValues p = phongValues(values);
        return p.specular == glm::dvec3(0.0) ? 0.0 : 2.0 * std::sqrt(p.shininess);
    };
    // The reflected direction turns twice as fast as the half vector: a Phong exponent is a quarter of
    // Blinn's.
    brdf.fromMetallicRoughness = [](const MetallicRoughness& surface) {
        return phongFromMetallicRoughness(surface, blinnExponent(surface.roughness) / 4.0);
    };
    return brdf;
}

}  // namespace lobe::brdf_entry
