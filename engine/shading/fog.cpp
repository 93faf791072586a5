#include "shading/fog.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "math/quadrature.hpp"
#include "shading/punctual.hpp"

namespace lobe {
namespace {

/// Integral over [a, b]: halved until the rule of 16 nodes agrees with itself on both halves, to `allowed` of
/// the whole.
glm::dvec3 integrate(const std::function<glm::dvec3(double)>& f, double a, double b) {
    static const QuadratureRule rule = gaussLegendre(16);
    const auto panel = [&](double low, double high) {
        glm::dvec3 sum(0.0);
        for (size_t i = 0; i < rule.nodes.size(); ++i)
            sum += rule.weights[i] * f(0.5 * (low + high) + 0.5 * (high - low) * rule.nodes[i]);
        return sum * (0.5 * (high - low));
    };
    glm::dvec3 total = panel(a, b);
    const std::function<glm::dvec3(double, double, const glm::dvec3&, int)> refined =
        [&](double low, double high, const glm::dvec3& whole, int depth) {
            const double middle = 0.5 * (low + high);
            const glm::dvec3 left = panel(low, middle), right = panel(middle, high);
            const glm::dvec3 difference = glm::abs(left + right - whole);
            constexpr double kRelative = 1e-10;
            constexpr int kDeepest = 40;
            total = glm::max(total, left + right);
            if (depth == kDeepest || glm::all(glm::lessThanEqual(difference, kRelative * total)))
                return left + right;
            return refined(low, middle, left, depth + 1) + refined(middle, high, right, depth + 1);
        };
    return refined(a, b, total, 0);
}

}  // namespace

double fogPhi(double x) {
    return x > 0.0 ? -std::expm1(-x) / x : 1.0;
}

double fogOpacity(double depth) {
    return -std::expm1(-depth);
}

glm::dvec3 fogOpticalDepth(const FogMedium& fog, double start, double rise, double length) {
    if (length == 0.0) return glm::dvec3(0.0);
    const double slope = fog.heightFalloff * std::abs(rise);
    // Metres at the lower end's density that count as much as the whole way.
    const double effective = slope > 0.0 ? fogOpacity(slope * length) / slope : length;
    const double lower = rise < 0.0 && fog.heightFalloff > 0.0 ? start + rise * length : start;
    const double density = std::exp(-fog.heightFalloff * (lower - fog.height));
    glm::dvec3 depth;
    for (int c = 0; c < 3; ++c)
        // A density of nothing over an endless way is nothing; an endless one of no extinction too.
        depth[c] = fog.extinction[c] == 0.0 || density == 0.0 ? 0.0 : fog.extinction[c] * density * effective;
    return depth;
}

glm::dvec3 fogTransmittance(const FogMedium& fog, double start, double rise, double length) {
    return glm::exp(-fogOpticalDepth(fog, start, rise, length));
}

double henyeyGreenstein(double cosine, double anisotropy) {
    const double g = std::abs(anisotropy);
    const double away = anisotropy < 0.0 ? 1.0 + cosine : 1.0 - cosine;
    const double q = (1.0 - g) * (1.0 - g) + 2.0 * g * away;
    return (1.0 - g) * (1.0 + g) / (4.0 * glm::pi<double>() * q * std::sqrt(q));
}

/// With p the place on the ray that is nearest to the light and h its distance, s = p + h tan t makes ds /
/// r^2 equal to dt / h (Kulla and Fajardo, Importance sampling techniques for path tracing in participating
/// media, EGSR 2012); s + r is p + h tan(t / 2 + pi / 4), and the cosine of scattering -sin t.
glm::dvec3 airlight(const FogMedium& fog, const FogLight& light, const glm::dvec3& origin,
                    const glm::dvec3& direction, double length) {
    const glm::dvec3 toLight = light.position - origin;
    const double p = glm::dot(toLight, direction);
    const glm::dvec3 aside = toLight - p * direction;
    const double h = std::max(glm::length(aside), kAirlightNearest);
    double low = std::atan2(-p, h);
    double high = std::isinf(length) ? glm::half_pi<double>() : std::atan2(length - p, h);
    if (light.range) {
        if (*light.range <= h) return glm::dvec3(0.0);
        const double reach = std::acos(h / *light.range);
        low = std::max(low, -reach);
        high = std::min(high, reach);
    }
    std::vector<double> breaks;
    const double along = glm::dot(direction, light.axis), across = glm::dot(aside, light.axis) / h;
    if (light.outerConeAngle) {
        // The cone cuts the plane of ray and light in a wedge about the axis's shadow there.
        const double shadow = std::hypot(along, across), middle = std::atan2(along, -across);
        const double outer = std::cos(*light.outerConeAngle);
        const double inner = outer + std::max(0.001, std::cos(light.innerConeAngle) - outer);
        if (!(shadow > outer)) return glm::dvec3(0.0);
        const double half = std::acos(outer / shadow);
        for (const double turn : {-glm::two_pi<double>(), 0.0, glm::two_pi<double>()}) {
            const double a = std::max(low, middle - half + turn), b = std::min(high, middle + half + turn);
            if (!(a < b)) continue;
            breaks.push_back(a);
            if (shadow > inner)
                for (const double edge :
                     {middle - std::acos(inner / shadow) + turn, middle + std::acos(inner / shadow) + turn})
                    if (edge > a && edge < b) breaks.push_back(edge);
            breaks.push_back(b);
        }
    } else if (low < high) {
        breaks = {low, high};
    }
    const auto inScattered = [&](double t) {
        const double distance = h / std::cos(t);
        const double way = p + h * std::tan(0.5 * t + glm::quarter_pi<double>());
        double strength =
            rangeWindow(distance * distance, light.range) * henyeyGreenstein(-std::sin(t), fog.anisotropy);
        if (light.outerConeAngle)
            strength *= spotAttenuation(along * std::sin(t) - across * std::cos(t), light.innerConeAngle,
                                        *light.outerConeAngle);
        return strength * glm::exp(-fog.extinction * way);
    };
    glm::dvec3 sum(0.0);
    for (size_t i = 1; i < breaks.size(); ++i)
        sum += integrate(inScattered, breaks[i - 1], breaks[i]);
    return fog.scattering * light.intensity * sum / h;
}

}  // namespace lobe
