#include "shading/ward.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace lobe::shading {
namespace {

const double kPi = glm::pi<double>();

double square(double x) {
    return x * x;
}

/// Ward 1992, equations 5a and 5b.
double exponent(const glm::dvec3& unitH, const WardLobe& lobe) {
    // sin(theta_h) times cos(phi_h) and sin(phi_h), phi_h from the turned tangent
    const double c = std::cos(lobe.rotation);
    const double s = std::sin(lobe.rotation);
    const double widths =
        square((c * unitH.x + s * unitH.y) / lobe.alphaX) + square((c * unitH.y - s * unitH.x) / lobe.alphaY);
    return lobe.form == WardForm::exact ? widths / square(unitH.z) : 2.0 * widths / (1.0 + unitH.z);
}

double factor(const Directions& d, WardVariant variant) {
    const double cosines = d.wi.z * d.wo.z;
    switch (variant) {
        case WardVariant::ward:
            return 1.0 / std::sqrt(cosines);
        case WardVariant::duer:
            return 1.0 / cosines;
        case WardVariant::bounded:
            break;
    }
    return 4.0 * glm::dot(d.h, d.h) / std::pow(d.h.z, 4.0);
}

}  // namespace

double wardLobe(const Directions& d, const WardLobe& lobe) {
    return std::exp(-exponent(glm::normalize(d.h), lobe)) / (4.0 * kPi * lobe.alphaX * lobe.alphaY) *
           factor(d, lobe.variant);
}

Parameter wardAlpha(std::string name, double defaultValue, std::string description) {
    Parameter parameter =
        scalarParameter(std::move(name), defaultValue, kMinWardAlpha, kMaxWardAlpha, std::move(description));
    parameter.usual = {1e-3, 1.0};
    return parameter;
}

Parameter wardVariantParameter() {
    return choiceParameter("variant", {"ward", "duer", "bounded"},
                           "ward: Ward 1992, darkens at grazing angles; duer: keeps its albedo but gains at "
                           "grazing; bounded: albedo at most 1");
}

glm::dvec3 wardFCos(const Directions& d, std::span<const double> values, const WardLobe& lobe) {
    if (!aboveSurface(d)) return glm::dvec3(0.0);
    return (rgbAt(values, 0) / kPi + rgbAt(values, 3) * wardLobe(d, lobe)) * d.wi.z;
}

WardImitation wardFromMetallicRoughness(const MetallicRoughness& surface) {
    const glm::dvec3 diffuse = surface.baseColor * (1.0 - surface.metallic) * (1.0 - kDielectricF0);
    const glm::dvec3 specular = glm::mix(glm::dvec3(kDielectricF0), surface.baseColor, surface.metallic);
    return {{diffuse.r, diffuse.g, diffuse.b, specular.r, specular.g, specular.b},
            std::max(square(surface.roughness), kMinWardAlpha)};
}

}  // namespace lobe::shading
