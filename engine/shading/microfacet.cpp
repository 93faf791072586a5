#include "shading/microfacet.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

namespace lobe::shading {
namespace {

bool isSchlick(std::span<const double> values) {
    return values[values.size() - kFresnelValues] == static_cast<double>(FresnelType::schlick);
}

}  // namespace

std::vector<Parameter> microfacetParameters(std::vector<Parameter> lobe) {
    std::vector<Parameter> parameters{colorParameter("diffuse", glm::dvec3(0.0), "k_d: diffuse reflectance"),
                                      colorParameter("specular", glm::dvec3(1.0), "k_s: scale of the lobe")};
    parameters.insert(parameters.end(), lobe.begin(), lobe.end());
    for (Parameter& parameter : fresnelParameters())
        parameters.push_back(std::move(parameter));
    return parameters;
}

glm::dvec3 microfacetFCos(const Directions& d, std::span<const double> values, double lobe) {
    const glm::dvec3 fresnel = fresnelReflectance(values.last(kFresnelValues), d);
    return (rgbAt(values, 0) / glm::pi<double>() + rgbAt(values, 3) * fresnel * lobe) * d.wi.z;
}

std::vector<BrdfFactor> microfacetFactors(const Directions& d, std::span<const double> values,
                                          double distribution, double masking) {
    return {{"D", glm::dvec3(distribution)},
            {"F", fresnelReflectance(values.last(kFresnelValues), d)},
            {"G", glm::dvec3(masking)}};
}

glm::dvec3 microfacetAmbient(std::span<const double> values) {
    return rgbAt(values, 0) + rgbAt(values, 3) * fresnelReflectance(values.last(kFresnelValues), 1.0);
}

glm::dvec3 microfacetPeak(std::span<const double> values, double lobe) {
    const auto type = static_cast<FresnelType>(values[values.size() - kFresnelValues]);
    if (type == FresnelType::bands) return glm::dvec3(std::numeric_limits<double>::infinity());
    return rgbAt(values, 0) / glm::pi<double>() + rgbAt(values, 3) * lobe;
}

SamplingLobes microfacetLobes(const glm::dvec3& wo, std::span<const double> values, SamplingLobe lobe) {
    lobe.weight = meanOf(rgbAt(values, 3) * fresnelReflectance(values.last(kFresnelValues), wo.z));
    return baseAndLobe(meanOf(rgbAt(values, 0)), lobe);
}

AreaModel microfacetArea(std::function<double(const Directions&, std::span<const double>)> lobe) {
    AreaModel area;
    area.terms = 2;
    area.colors = {"diffuse", "specular", "f0"};
    area.weights = [](std::span<const double> values) {
        const glm::dvec3 specular = rgbAt(values, 3);
        if (!isSchlick(values)) return AreaWeights{rgbAt(values, 0), {specular, glm::dvec3(0.0)}};
        return AreaWeights{rgbAt(values, 0), {specular * rgbAt(values, values.size() - 9), specular}};
    };
    area.parts = [lobe = std::move(lobe)](const Directions& d, std::span<const double> values) {
        const double value = lobe(d, values) * d.wi.z;
        if (!isSchlick(values))
            return AreaTerms{1.0,
                             {fresnelReflectance(values.last(kFresnelValues), d) * value, glm::dvec3(0.0)}};
        const double schlick = std::pow(oneMinusCosThetaD(d), 5.0);
        return AreaTerms{1.0, {glm::dvec3((1.0 - schlick) * value), glm::dvec3(schlick * value)}};
    };
    return area;
}

ParameterValues microfacetFromMetallicRoughness(const MetallicRoughness& surface,
                                                const std::vector<double>& lobe) {
    const glm::dvec3 diffuse = surface.baseColor * (1.0 - surface.metallic) * (1.0 - kDielectricF0);
    ParameterValues values{diffuse.r, diffuse.g, diffuse.b, 1.0, 1.0, 1.0};
    values.insert(values.end(), lobe.begin(), lobe.end());
    const std::vector<double> fresnel = fresnelFromMetallicRoughness(surface);
    values.insert(values.end(), fresnel.begin(), fresnel.end());
    return values;
}

bool hasSpecular(std::span<const double> values) {
    return values[3] > 0.0 || values[4] > 0.0 || values[5] > 0.0;
}

double beckmann(const glm::dvec3& h, double m) {
    const double cos2 = h.z * h.z;
    const double tan2 = (h.x * h.x + h.y * h.y) / cos2;
    return std::exp(-tan2 / (m * m)) / (glm::pi<double>() * m * m * cos2 * cos2);
}

}  // namespace lobe::shading
