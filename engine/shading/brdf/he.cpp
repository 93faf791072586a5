/// Wave optics of a rough surface with Gaussian heights: He, Torrance, Sillion and Greenberg.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shading/fresnel.hpp"
#include "shading/he_surfaces.hpp"
#include "shading/metals.hpp"

namespace lobe::brdf_entry {
namespace {

const double kPi = glm::pi<double>();

/// Wavelengths of red, green and blue.
const glm::dvec3 kBands(645e-9, 526e-9, 444e-9);

struct HeValues {
    glm::dvec3 diffuse;
    double sigma, tau;
    glm::dvec3 wavelength;
    std::span<const double> fresnel;
};

HeValues heValues(std::span<const double> v) {
    using shading::rgbAt;
    return {rgbAt(v, 0), v[3], v[4], rgbAt(v, 5), v.subspan(8)};
}

double tangent(const glm::dvec3& w) {
    return std::hypot(w.x, w.y) / w.z;
}

/// tau / (2 sigma) cot(theta), infinite along the normal and for a smooth surface.
double shadowingArgument(const glm::dvec3& w, const HeValues& p) {
    return p.tau / (2.0 * p.sigma * tangent(w));
}

/// Equation 24 with Lambda of equation 25, into which the factor exp(-x^2), left out in print, is put back.
double shadowing(const glm::dvec3& w, const HeValues& p) {
    const double x = shadowingArgument(w, p);
    if (!std::isfinite(x)) return 1.0;
    const double lambda = 0.5 * (std::exp(-x * x) / (std::sqrt(kPi) * x) - std::erfc(x));
    return (1.0 - 0.5 * std::erfc(x)) / (lambda + 1.0);
}

double hiddenTangent(const glm::dvec3& w, const HeValues& p) {
    const double x = shadowingArgument(w, p);
    return std::isfinite(x) ? tangent(w) * std::erfc(x) : 0.0;
}

/// Equations 80 and 81: sqrt(pi / 2) z0 = sigma / 4 (K_i + K_r) exp(-z0^2 / (2 sigma^2)) for x = z0 / sigma,
/// by Newton's method on the logarithm of x exp(x^2 / 2) = K / sqrt(8 pi); then sigma / sqrt(1 + x^2).
double effectiveRoughness(double k, double sigma) {
    const double target = k / std::sqrt(8.0 * kPi);
    if (target == 0.0) return sigma;
    double x = target < 1.0 ? target : std::sqrt(2.0 * std::log(target) + 0.5);
    for (int i = 0; i < 60; ++i) {
        const double step = (std::log(x / target) + 0.5 * x * x) / (1.0 / x + x);
        x = std::max(x - step, 0.1 * x);
        if (std::abs(step) < 1e-17 * x) break;
    }
    return sigma / std::sqrt(1.0 + x * x);
}

/// x - ln(1 + x) for x = (g - m) / m, by its series where x is small.
double logGap(double m, double g) {
    const double x = (g - m) / m;
    if (std::abs(x) > 0.1) return x - std::log(g / m);
    double power = x * x, sum = 0.0;
    for (int n = 2; n < 24; ++n, power *= -x)
        sum += power / n;
    return sum;
}

/// ln of the Poisson probability g^m exp(-g) / m!. Where m ln g and ln m! are large and nearly equal, by
/// their difference: Stirling's series for m! leaves m (x - ln(1 + x)).
double logPoisson(double m, double g) {
    if (m < 10.0) return m * std::log(g) - g - std::lgamma(m + 1.0);
    const double r2 = 1.0 / (m * m);
    const double stirling =
        (1.0 / 12.0 - r2 * (1.0 / 360.0 - r2 * (1.0 / 1260.0 - r2 * (1.0 / 1680.0 - r2 / 1188.0)))) / m;
    return -m * logGap(m, g) - stirling - 0.5 * std::log(2.0 * kPi * m);
}

/// ln of the series' term at m.
double logTerm(double m, double g, double q) {
    return logPoisson(m, g) - std::log(m) - q / m;
}

/// sum over m of g^m exp(-g) / (m! m) exp(-q / m), outwards from the largest term. Where the terms change
/// slowly, only every n-th is taken, n a third of the peak's width: for a peak this smooth the sum differs
/// by exp(-2 pi^2 9). Beyond g = 1e14 it is the mean of h(m) = exp(-q / m) / m over a Poisson distribution so
/// narrow that h(g) + g h''(g) / 2 is left: the next term is (q / g)^4 / (8 g^2), below 1e-17 where exp(-q /
/// g) is above the least double.
double series(double g, double q) {
    if (g <= 0.0) return 0.0;
    if (g > 1e14) {
        const double u = q / g;
        return std::exp(-u) / g * (1.0 + (0.5 * u * u - 2.0 * u + 1.0) / g);
    }
    double low = 1e-3, high = std::max(10.0, 2.0 * (g + std::sqrt(q)) + 10.0);
    const auto slope = [&](double m) { return std::log(g / m) + q / (m * m) - 1.5 / m; };
    for (int i = 0; i < 60 && high > (1.0 + 1e-9) * low; ++i) {
        const double middle = std::sqrt(low * high);
        (slope(middle) > 0.0 ? low : high) = middle;
    }
    const double centre = std::max(1.0, std::round(low));
    const double width = 1.0 / std::sqrt(1.0 / centre + 2.0 * q / (centre * centre * centre));
    const double step = centre > 100.0 ? std::max(1.0, std::floor(width / 3.0)) : 1.0;
    const double largest = logTerm(centre, g, q);
    double sum = 0.0;
    for (const double direction : {step, -step})
        for (double m = direction > 0.0 ? centre : centre - step; m >= 1.0; m += direction) {
            const double term = std::exp(logTerm(m, g, q) - largest);
            sum += term;
            if (!(term >= 1e-18)) break;
        }
    return sum * step * std::exp(largest);
}

glm::dvec3 fCos(const Directions& d, std::span<const double> values) {
    if (!shading::aboveSurface(d)) return glm::dvec3(0.0);
    const HeValues p = heValues(values);
    const double sigma = effectiveRoughness(hiddenTangent(d.wi, p) + hiddenTangent(d.wo, p), p.sigma);
    const double cosines = d.wi.z + d.wo.z;
    const double h2 = glm::dot(d.h, d.h);
    const double geometry = (h2 / cosines) * (h2 / cosines);
    const double s = shadowing(d.wi, p) * shadowing(d.wo, p);
    const glm::dvec3 fresnel = shading::fresnelReflectance(p.fresnel, d);
    glm::dvec3 f = p.diffuse / kPi;
    for (int c = 0; c < 3; ++c) {
        const double waves = 1.0 / p.wavelength[c];
        const double g = std::pow(2.0 * kPi * sigma * waves * cosines, 2.0);
        const double q = std::pow(kPi * p.tau * waves, 2.0) * (d.h.x * d.h.x + d.h.y * d.h.y);
        const double distribution = std::pow(kPi * p.tau * waves, 2.0) / 4.0 * series(g, q);
        f[c] += fresnel[c] / kPi * geometry * s * distribution / (d.wi.z * d.wo.z);
    }
    return f * d.wi.z;
}

/// Equation 78's specular term as a reflectance: |F|^2 exp(-g) S.
glm::dvec3 mirrorReflectance(double cosTheta, std::span<const double> values) {
    const HeValues p = heValues(values);
    const glm::dvec3 w(std::sqrt((1.0 - cosTheta) * (1.0 + cosTheta)), 0.0, cosTheta);
    const double sigma = effectiveRoughness(2.0 * hiddenTangent(w, p), p.sigma);
    const double s = shadowing(w, p) * shadowing(w, p);
    glm::dvec3 reflectance = shading::fresnelReflectance(p.fresnel, cosTheta) * s;
    for (int c = 0; c < 3; ++c)
        reflectance[c] *= std::exp(-std::pow(4.0 * kPi * sigma / p.wavelength[c] * cosTheta, 2.0));
    return reflectance;
}

double sharpness(std::span<const double> values) {
    const HeValues p = heValues(values);
    const double shortest = std::min({p.wavelength.r, p.wavelength.g, p.wavelength.b});
    const double smooth = 4.0 * kPi * p.tau / shortest;
    return p.sigma > 0.0 ? std::min(smooth, p.tau / p.sigma) : smooth;
}

Parameter length(std::string name, double defaultValue, double minimum, std::pair<double, double> usual,
                 std::string description) {
    Parameter parameter =
        shading::scalarParameter(std::move(name), defaultValue, minimum, 1000.0, std::move(description));
    parameter.unit = "m";
    parameter.usual = usual;
    return parameter;
}

std::vector<BrdfPreset> presets() {
    using shading::FresnelType;
    std::vector<BrdfPreset> presets;
    for (const shading::HeSurface& surface : shading::heSurfaces()) {
        ParameterValues values{0.0, 0.0, 0.0, surface.sigma, surface.tau};
        const auto append = [&](const glm::dvec3& rgb) {
            values.insert(values.end(), {rgb.r, rgb.g, rgb.b});
        };
        append(surface.wavelength > 0.0 ? glm::dvec3(surface.wavelength) : kBands);
        const auto& metals = shading::metals();
        const auto metal = std::find_if(metals.begin(), metals.end(), [&](const shading::Metal& known) {
            return known.name == surface.metal;
        });
        const bool conductor = metal != metals.end();
        values.push_back(static_cast<double>(conductor ? FresnelType::conductor : FresnelType::dielectric));
        append(glm::dvec3(shading::kDielectricF0));
        append(conductor ? metal->eta : glm::dvec3(surface.eta));
        append(conductor ? metal->k : glm::dvec3(0.0));
        presets.push_back({surface.name, surface.source, std::move(values)});
    }
    return presets;
}

}  // namespace

Brdf he() {
    using namespace shading;
    Brdf brdf;
    brdf.name = "he";
    brdf.title = "He-Torrance-Sillion-Greenberg";
    brdf.source = "X. D. He et al., A comprehensive physical model for light reflection, SIGGRAPH 1991";
    Parameter wavelength = length("wavelength", 0.0, 1e-9, {4e-7, 7e-7}, "of the red, green and blue band");
    wavelength.kind = ParameterKind::rgb;
    wavelength.defaultValue = kBands;
    wavelength.mayBeTextured = false;
    brdf.parameters = {colorParameter("diffuse", glm::dvec3(0.0), "a: uniform-diffuse reflectance"),
                       length("sigma", 2e-7, 0.0, {1e-8, 2e-6}, "RMS height of the surface"),
                       length("tau", 2e-6, 1e-9, {3e-7, 3e-5}, "autocorrelation length of the heights"),
                       wavelength};
    for (Parameter& parameter : fresnelParameters())
        brdf.parameters.push_back(std::move(parameter));
    brdf.presets = presets();
    // 4 % over at some angles even without the uniform-diffuse part, which nothing bounds.
    brdf.traits.energyConserving = false;
    brdf.baseColorParameter = "diffuse";
    brdf.fCos = fCos;
    brdf.mirror = mirrorReflectance;
    brdf.ambient = [](std::span<const double> values) {
        return rgbAt(values, 0) + fresnelReflectance(heValues(values).fresnel, 1.0);
    };
    brdf.lobeSharpness = sharpness;
    brdf.fromMetallicRoughness = [](const MetallicRoughness& surface) {
        // Heights of a micrometre scatter all of visible light; the slope is glTF's alpha.
        const glm::dvec3 diffuse = surface.baseColor * (1.0 - surface.metallic) * (1.0 - kDielectricF0);
        const double sigma = 1e-6;
        const double slope = std::max(surface.roughness * surface.roughness, 1e-3);
        ParameterValues values{diffuse.r,           diffuse.g, diffuse.b, sigma,
                               2.0 * sigma / slope, kBands.r,  kBands.g,  kBands.b};
        const std::vector<double> fresnel = fresnelFromMetallicRoughness(surface);
        values.insert(values.end(), fresnel.begin(), fresnel.end());
        return values;
    };
    return brdf;
}

}  // namespace lobe::brdf_entry
