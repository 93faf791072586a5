#include "shading/fresnel.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "shading/bands.hpp"
#include "shading/metals.hpp"

namespace lobe::shading {
namespace {

using Complex = std::complex<double>;

double schlick(double f0, double oneMinusCos) {
    return f0 + (1.0 - f0) * std::pow(oneMinusCos, 5.0);
}

glm::dvec3 reflectanceAt(std::span<const double> values, double cosTheta, double oneMinusCos) {
    const auto type = static_cast<FresnelType>(static_cast<int>(values[0]));
    if (type == FresnelType::bands)
        return bandReflectance(bandsIn(values.subspan(4, 3)), cosTheta, oneMinusCos);
    glm::dvec3 reflectance;
    for (size_t i = 0; i < 3; ++i) {
        const double eta = values[4 + i];
        const double k = type == FresnelType::conductor ? values[7 + i] : 0.0;
        reflectance[static_cast<int>(i)] = type == FresnelType::schlick
                                               ? schlick(values[1 + i], oneMinusCos)
                                               : exactReflectance({eta, k}, cosTheta, oneMinusCos);
    }
    return reflectance;
}

}  // namespace

/// Amplitudes of both polarisations from Snell's law with a complex index.
PolarisedReflectance polarisedReflectance(Complex index, double cosTheta, double oneMinusCos) {
    const double sin2 = oneMinusCos * (1.0 + cosTheta);
    const Complex transmitted = std::sqrt(1.0 - sin2 / (index * index));
    const Complex s = (cosTheta - index * transmitted) / (cosTheta + index * transmitted);
    const Complex p = (index * cosTheta - transmitted) / (index * cosTheta + transmitted);
    return {std::norm(s), std::norm(p)};
}

double exactReflectance(Complex index, double cosTheta, double oneMinusCos) {
    const auto [s, p] = polarisedReflectance(index, cosTheta, oneMinusCos);
    return 0.5 * (s + p);
}

double exactReflectance(Complex index, double cosTheta) {
    return exactReflectance(index, cosTheta, 1.0 - cosTheta);
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
    return reflectanceAt(values, cosTheta, 1.0 - cosTheta);
}

glm::dvec3 fresnelReflectance(std::span<const double> values, const Directions& d) {
    // Half vectors of unit vectors can exceed the cosine of 0 by a rounding.
    const double cosTheta = std::min(0.5 * glm::length(d.h), 1.0);
    return reflectanceAt(values, cosTheta, oneMinusCosThetaD(d));
}

double oneMinusCosThetaD(const Directions& d) {
    const glm::dvec3 half = 0.5 * (d.wi - d.wo);  // as long as the sine
    return std::min(glm::dot(half, half) / (1.0 + 0.5 * glm::length(d.h)), 1.0);
}

void setMetal(const Brdf& brdf, std::span<double> values, const Metal& metal) {
    const auto place = [&](const char* name) {
        return values.subspan(static_cast<size_t>(brdf.valueOffset(brdf.parameterIndex(name))));
    };
    place("fresnel")[0] = static_cast<double>(FresnelType::conductor);
    for (size_t c = 0; c < 3; ++c) {
        place("eta")[c] = metal.eta[static_cast<int>(c)];
        place("k")[c] = metal.k[static_cast<int>(c)];
    }
}

FresnelType fresnelTypeFor(FresnelType present, const std::vector<std::string>& named,
                           const std::string& choice, const std::string& where) {
    const auto has = [&](const char* name) {
        return std::find(named.begin(), named.end(), name) != named.end();
    };
    const auto refuse = [&](const std::string& one, const std::string& other) {
        throw UsageError(where + ": " + one + " and " + other +
                         " contradict each other; expected one of them");
    };
    for (const char* name : {"fresnel", "f0", "eta", "k"})
        if (has("metal") && has(name)) refuse("metal", name);
    for (const char* name : {"eta", "k"})
        if (has("f0") && has(name)) refuse("f0", name);
    if (has("metal")) return FresnelType::conductor;
    if (has("fresnel")) {
        const std::string stated = "fresnel=" + choice;
        if (choice != "schlick" && has("f0")) refuse(stated, "f0");
        if (choice == "schlick" && has("eta")) refuse(stated, "eta");
        if (choice != "conductor" && has("k")) refuse(stated, "k");
        return choice == "schlick"      ? FresnelType::schlick
               : choice == "dielectric" ? FresnelType::dielectric
               : choice == "conductor"  ? FresnelType::conductor
                                        : present;
    }
    if (has("f0")) return FresnelType::schlick;
    if (has("k")) return FresnelType::conductor;
    return has("eta") && present == FresnelType::schlick ? FresnelType::dielectric : present;
}

std::vector<double> fresnelFromMetallicRoughness(const MetallicRoughness& surface) {
    const glm::dvec3 f0 = glm::mix(glm::dvec3(kDielectricF0), surface.baseColor, surface.metallic);
    return {0.0, f0.r, f0.g, f0.b, 1.5, 1.5, 1.5, 0.0, 0.0, 0.0};
}

}  // namespace lobe::shading
