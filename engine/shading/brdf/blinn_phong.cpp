/// Cosine power about the half vector: k_s (N.H)^n.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shading/phong_family.hpp"

namespace lobe::brdf_entry {
namespace {

/// Makes the albedo of the lobe 1 at normal incidence: 1 / integral of (N.H)^n cos over the hemisphere.
double energyConstant(double n) {
    return (n + 2.0) * (n + 4.0) / (8.0 * glm::pi<double>() * (std::exp2(-n / 2.0) + n));
}

/// (N.H)^n with what is beside k_s, and cos(theta_i) in the form "energy".
double lobe(const Directions& d, const shading::PhongValues& p) {
    const glm::dvec3 h = glm::normalize(d.h);
    const double power = shading::cosinePower(h.z, std::hypot(h.x, h.y), p.shininess);
    return p.energy ? energyConstant(p.shininess) * power * d.wi.z : power;
}

glm::dvec3 fCos(const Directions& d, std::span<const double> values) {
    using namespace shading;
    if (!aboveSurface(d)) return glm::dvec3(0.0);
    const PhongValues p = phongValues(values);
    return p.diffuse * (p.energy ? d.wi.z / glm::pi<double>() : d.wi.z) + p.specular * lobe(d, p);
}

/// Half vectors with density cos^(n + 1).
SamplingLobes lobes(const glm::dvec3&, std::span<const double> values) {
    const shading::PhongValues p = shading::phongValues(values);
    // Of the classic form, in units of pi: k_d, and 8 / (n + 2) for the lobe.
    const double scale = p.energy ? 1.0 : 8.0 / (p.shininess + 2.0);
    return shading::baseAndLobe(
        shading::meanOf(p.diffuse),
        {LobeShape::powerNormals, scale * shading::meanOf(p.specular), p.shininess + 1.0, p.shininess + 1.0});
}

}  // namespace

Brdf blinn_phong() {
    using namespace shading;
    Brdf brdf;
    brdf.name = "blinn_phong";
    brdf.title = "Blinn-Phong";
    brdf.source =
        "J. F. Blinn, Models of light reflection for computer synthesized pictures, SIGGRAPH 1977; energy: "
        "the lobe "
        "divided by its integral at normal incidence";
    brdf.parameters = phongParameters();
    // "classic" is neither; "energy" is reciprocal, and conserving where diffuse + specular <= 1.
    brdf.traits.reciprocal = false;
    brdf.traits.energyConserving = false;
    brdf.baseColorParameter = "diffuse";
    brdf.fCos = fCos;
    brdf.peak = [](std::span<const double> values) {
        const PhongValues p = phongValues(values);
        return p.energy ? p.diffuse / glm::pi<double>() + p.specular * energyConstant(p.shininess)
                        : p.diffuse + p.specular;
    };
    brdf.samplingLobes = lobes;
    brdf.area = phongArea(lobe);
    brdf.ambient = phongAmbient;
    brdf.lobeSharpness = [](std::span<const double> values) {
        const PhongValues p = phongValues(values);
        return p.specular == glm::dvec3(0.0) ? 0.0 : std::sqrt(p.shininess);
    };
    brdf.fromMetallicRoughness = [](const MetallicRoughness& surface) {
        return phongFromMetallicRoughness(surface, blinnExponent(surface.roughness));
    };
    return brdf;
}

}  // namespace lobe::brdf_entry
