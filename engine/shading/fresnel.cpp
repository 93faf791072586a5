#include "shading/fresnel.hpp"

#include <cmath>
#include <complex>

#include "shading/bands.hpp"

namespace lobe::shading {
namespace {

using Complex = std::complex<double>;

double schlick(double f0, double cosTheta) {
    return f0 + (1.0 - f0) * std::pow(1.0 - cosTheta, 5.0);
}

}  // namespace

/// Amplitudes of both polarisations from Snell's law with a complex index; unpolarised light has the mean of
/// their squares.
double exactReflectance(Complex index, double cosTheta) {
    const double sin2 = (1.0 - cosTheta) * (1.0 + cosTheta);
    const Complex transmitted = std::sqrt(1.0 - sin2 / (index * index));
    const Complex s = (cosTheta - index * transmitted) / (cosTheta + index * transmitted);
    const Complex p = (index * cosTheta - transmitted) / (index * cosTheta + transmitted);
    return 0.5 * (std::norm(s) + std::norm(p));
}

std::vector<Parameter> fresnelParameters() {
    std::vector<Parameter> parameters{
        choiceParameter("fresnel", {"schlick", "dielectric", "conductor"},
                        "schlick from f0; dielectric exact from eta; conductor exact from eta + i k"),
        colorParameter("f0", glm::dvec3(kDielectricF0), "reflectance at normal incidence, for schlick"),
        rgbParameter("eta", glm::dvec3(1.5), "index of refraction over that of the medium outside"),
        rgbParameter("k", glm::dvec3(0.0), "extinction coefficient, for conductor")};
    parameters[2].minimum = 0.01;
    parameters[2].maximum = 20.0;
    parameters[2].usual = {1.0001, 4.0};
    parameters[3].maximum = 20.0;
    parameters[3].usual = {0.0, 10.0};
    for (Parameter& parameter : parameters)
        parameter.group = "fresnel";
    return parameters;
}

glm::dvec3 fresnelReflectance(std::span<const double> values, double cosTheta) {
    const auto type = static_cast<FresnelType>(static_cast<int>(values[0]));
    // Half vectors of unit vectors can exceed the cosine of 0 by a rounding.
    const double c = std::min(cosTheta, 1.0);
    if (type == FresnelType::bands) return bandReflectance(bandsIn(values.subspan(4, 3)), c);
    glm::dvec3 reflectance;
    for (size_t i = 0; i < 3; ++i) {
        const auto channel = static_cast<int>(i);
        const double eta = values[4 + i];
        reflectance[channel] =
            type == FresnelType::schlick
                ? schlick(values[1 + i], c)
                : exactReflectance({eta, type == FresnelType::conductor ? values[7 + i] : 0.0}, c);
    }
    return reflectance;
}

std::vector<double> fresnelFromMetallicRoughness(const MetallicRoughness& surface) {
    const glm::dvec3 f0 = glm::mix(glm::dvec3(kDielectricF0), surface.baseColor, surface.metallic);
    return {0.0, f0.r, f0.g, f0.b, 1.5, 1.5, 1.5, 0.0, 0.0, 0.0};
}

}  // namespace lobe::shading
