/// Lambertian facets that shadow, mask and light each other: Oren and Nayar's rough diffuse surface.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shading/parameters.hpp"

namespace lobe::brdf_entry {
namespace {

const double kPi = glm::pi<double>();

/// Angle above the horizon. The paper's polar angles are pi/2 less it; where they are near pi/2, it keeps the
/// digits.
double elevation(const glm::dvec3& w) {
    return std::atan2(w.z, std::hypot(w.x, w.y));
}

struct Angles {
    double low, high;  ///< elevations: the paper's alpha = pi/2 - low, beta = pi/2 - high
    double phi;        ///< phi_r - phi_i

    explicit Angles(const Directions& d)
        : low(std::min(elevation(d.wi), elevation(d.wo))),
          high(std::max(elevation(d.wi), elevation(d.wo))),
          phi(std::atan2(d.wo.y, d.wo.x) - std::atan2(d.wi.y, d.wi.x)) {}
    double alpha() const { return kPi / 2.0 - low; }
    double beta() const { return kPi / 2.0 - high; }
    double cosPhi() const { return std::cos(phi); }
    double tanBeta() const { return 1.0 / std::tan(high); }
    double tanMean() const { return 1.0 / std::tan(0.5 * (low + high)); }  ///< tan((alpha + beta) / 2)
    /// 1 - |cos phi|
    double azimuthGap() const {
        const double half = cosPhi() >= 0.0 ? std::sin(0.5 * phi) : std::cos(0.5 * phi);
        return 2.0 * half * half;
    }
    /// sin(alpha) - (2 beta / pi)^3, as a difference of the distances of both from 1.
    double cut() const {
        const double x = 2.0 * beta() / kPi;
        const double sine = std::sin(0.5 * low);
        return (2.0 * high / kPi) * (1.0 + x + x * x) - 2.0 * sine * sine;
    }
};

/// f_r pi / rho as a sum, of which some terms may be negative.
struct Terms {
    double constant, facing, across, between;

    double sum() const { return constant + facing + across + between; }
    double size() const { return constant + std::abs(facing) + across + std::abs(between); }
};

/// Equation 30.
Terms qualitative(const Angles& a, double s2) {
    const double A = 1.0 - 0.5 * s2 / (s2 + 0.33);
    const double B = 0.45 * s2 / (s2 + 0.09);
    return {A, B * std::max(a.cosPhi(), 0.0) * std::cos(a.low) * a.tanBeta(), 0.0, 0.0};
}

/// Equations 27 and 28.
Terms full(const Angles& a, double s2, double rho) {
    const double c1 = 1.0 - 0.5 * s2 / (s2 + 0.33);
    const double c2 = 0.45 * s2 / (s2 + 0.09) * (a.cosPhi() >= 0.0 ? std::cos(a.low) : a.cut());
    const double c3 = 0.125 * s2 / (s2 + 0.09) * std::pow(4.0 * a.alpha() * a.beta() / (kPi * kPi), 2.0);
    return {c1, a.cosPhi() * c2 * a.tanBeta(), a.azimuthGap() * c3 * a.tanMean(),
            0.17 * rho * s2 / (s2 + 0.13) * (1.0 - a.cosPhi() * std::pow(2.0 * a.beta() / kPi, 2.0))};
}

/// Each channel's `part` of its terms, times rho / pi cos(theta_i).
glm::dvec3 ofTerms(const Directions& d, std::span<const double> values, double (Terms::*part)() const) {
    if (!shading::aboveSurface(d)) return glm::dvec3(0.0);
    const glm::dvec3 rho = shading::rgbAt(values, 0);
    const double s2 = values[3] * values[3];
    const Angles angles(d);
    glm::dvec3 f;
    for (int c = 0; c < 3; ++c) {
        const Terms terms = values[4] == 0.0 ? full(angles, s2, rho[c]) : qualitative(angles, s2);
        f[c] = rho[c] / kPi * std::max((terms.*part)(), 0.0) * d.wi.z;
    }
    return f;
}

/// rho times what does not depend on it, and rho^2 times the light between facets.
AreaTerms areaParts(const Directions& d, std::span<const double> values) {
    const double s2 = values[3] * values[3];
    const Angles angles(d);
    const bool isFull = values[4] == 0.0;
    const Terms terms = isFull ? full(angles, s2, 1.0) : qualitative(angles, s2);
    const double direct = std::max(terms.constant + terms.facing + terms.across, 0.0);
    return {1.0,
            {glm::dvec3(direct / kPi * d.wi.z), glm::dvec3(std::max(terms.between, 0.0) / kPi * d.wi.z)}};
}

}  // namespace

Brdf oren_nayar() {
    using namespace shading;
    Brdf brdf;
    brdf.name = "oren_nayar";
    brdf.title = "Oren-Nayar";
    brdf.source = "M. Oren and S. K. Nayar, Generalization of Lambert's reflectance model, SIGGRAPH 1994";
    Parameter sigma = scalarParameter("sigma", 0.5, 0.0, kPi / 2.0, "RMS slope angle of the facets");
    sigma.unit = "rad";
    brdf.parameters = {
        colorParameter("diffuse", glm::dvec3(0.8), "rho: reflectance of the facets"), sigma,
        choiceParameter("form", {"full", "qualitative"},
                        "full: with light between facets, 0 where the fit goes negative; qualitative: the "
                        "paper's short form")};
    // 4.7 % over at grazing angles in the full form.
    brdf.traits.energyConserving = false;
    brdf.traits.halfVectorLobe = false;
    brdf.baseColorParameter = "diffuse";
    brdf.fCos = [](const Directions& d, std::span<const double> values) {
        return ofTerms(d, values, &Terms::sum);
    };
    brdf.termSizes = [](const Directions& d, std::span<const double> values) {
        return ofTerms(d, values, &Terms::size);
    };
    AreaModel area;
    area.terms = 2;
    area.colors = {"diffuse"};
    area.weights = [](std::span<const double> values) {
        const glm::dvec3 rho = rgbAt(values, 0);
        return AreaWeights{glm::dvec3(0.0), {rho, rho * rho}};
    };
    area.parts = areaParts;
    brdf.area = std::move(area);
    brdf.ambient = [](std::span<const double> values) { return rgbAt(values, 0); };
    brdf.lobeSharpness = [](std::span<const double>) { return 0.0; };
    // Of the terms times cos(theta_i): tan(beta) cos(theta_i) <= 1 and tan((alpha + beta) / 2) cos(theta_i)
    // <= 2, so full <= 1 + 0.45 + 2 x 0.125 + 2 x 0.17 and qualitative <= 1 + 0.45.
    brdf.peak = [](std::span<const double> values) {
        return rgbAt(values, 0) * ((values[4] == 0.0 ? 2.04 : 1.45) / kPi);
    };
    brdf.samplingLobes = [](const glm::dvec3&, std::span<const double>) {
        SamplingLobes lobes;
        lobes.add({LobeShape::cosine});
        return lobes;
    };
    brdf.fromMetallicRoughness = [](const MetallicRoughness& surface) {
        // The angle of the RMS slope alpha / sqrt(2) of Beckmann's facets.
        const double alpha = surface.roughness * surface.roughness;
        const glm::dvec3& base = surface.baseColor;
        return ParameterValues{base.r, base.g, base.b, std::atan(alpha / std::sqrt(2.0)), 0.0};
    };
    return brdf;
}

}  // namespace lobe::brdf_entry
