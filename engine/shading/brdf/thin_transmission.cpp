/// glTF's model for a thin surface that lets light through (KHR_materials_transmission without a volume):
/// metallic-roughness whose diffuse base gives way to what lies behind.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shading/fresnel.hpp"

namespace lobe::brdf_entry {

Brdf metallic_roughness();

namespace {

constexpr size_t kTransmission = 5;  // after baseColor, metallic, roughness

std::span<const double> surfaceOf(std::span<const double> values) {
    return values.first(kTransmission);
}

/// The diffuse term of metallic-roughness, times cos(theta_i).
glm::dvec3 diffuse(const Directions& d, std::span<const double> values) {
    using namespace shading;
    const glm::dvec3 f0 = glm::mix(glm::dvec3(kDielectricF0), rgbAt(values, 0), values[3]);
    const glm::dvec3 fresnel = f0 + (1.0 - f0) * std::pow(oneMinusCosThetaD(d), 5.0);
    return (1.0 - fresnel) * rgbAt(values, 0) * ((1.0 - values[3]) * d.wi.z / glm::pi<double>());
}

}  // namespace

Brdf thin_transmission() {
    using namespace shading;
    static const Brdf base = metallic_roughness();
    Brdf brdf = base;
    brdf.name = "thin_transmission";
    brdf.title = "glTF thin transmission";
    brdf.source =
        "Khronos, KHR_materials_transmission; and as metallic_roughness, which it is for a transmission of 0";
    brdf.parameters.push_back(
        scalarParameter("transmission", 0.0, 0.0, 1.0, "share of the diffuse base that lets light through"));
    brdf.area->colors.emplace_back("transmission");
    brdf.area->weights = [](std::span<const double> values) {
        AreaWeights weights = base.area->weights(surfaceOf(values));
        weights.lambert *= 1.0 - values[kTransmission];
        return weights;
    };
    brdf.fCos = [](const Directions& d, std::span<const double> values) {
        if (!aboveSurface(d)) return glm::dvec3(0.0);
        return base.fCos(d, surfaceOf(values)) - values[kTransmission] * diffuse(d, values);
    };
    brdf.factors = [](const Directions& d, std::span<const double> values) {
        return base.factors(d, surfaceOf(values));
    };
    brdf.ambient = [](std::span<const double> values) {
        return rgbAt(values, 0) * (1.0 - values[kTransmission] * (1.0 - values[3]));
    };
    // What the dielectric's lobe does not reflect goes through the base, which colours it.
    brdf.transmittance = [](double cosine, std::span<const double> values) {
        const double fresnel = kDielectricF0 + (1.0 - kDielectricF0) * std::pow(1.0 - cosine, 5.0);
        return rgbAt(values, 0) * ((1.0 - values[3]) * values[kTransmission] * (1.0 - fresnel));
    };
    brdf.lobeSharpness = [](std::span<const double> values) { return base.lobeSharpness(surfaceOf(values)); };
    brdf.samplingLobes = [](const glm::dvec3& wo, std::span<const double> values) {
        return base.samplingLobes(wo, surfaceOf(values));
    };
    brdf.fromMetallicRoughness = [](const MetallicRoughness& surface) {
        ParameterValues values = base.fromMetallicRoughness(surface);
        values.push_back(0.0);
        return values;
    };
    return brdf;
}

}  // namespace lobe::brdf_entry
