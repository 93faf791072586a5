#include "math/quadrature.hpp"

#include <cassert>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "math/sphere.hpp"

namespace lobe {
namespace {

struct Legendre {
    double value;
    double derivative;
};

/// P_n by its three-term recurrence.
Legendre legendre(int n, double x) {
    double previous = 1.0;
    double current = x;
    for (int k = 2; k <= n; ++k) {
        const double next = ((2.0 * k - 1.0) * x * current - (k - 1.0) * previous) / k;
        previous = current;
        current = next;
    }
    return {current, n * (x * current - previous) / (x * x - 1.0)};
}

}  // namespace

QuadratureRule gaussLegendre(int n) {
    assert(n >= 1);
    QuadratureRule rule;
    rule.nodes.resize(static_cast<size_t>(n));
    rule.weights.resize(static_cast<size_t>(n));
    for (int i = 0; i < n; ++i) {
        // Tricomi's estimate, good to O(n^-4), then Newton: quadratic, six steps reach the last digit from
        // any n.
        double x = -std::cos(glm::pi<double>() * (i + 0.75) / (n + 0.5));
        if (2 * i + 1 == n) x = 0.0;
        for (int step = 0; step < 6; ++step) {
            const Legendre p = legendre(n, x);
            x -= p.value / p.derivative;
        }
        const double slope = legendre(n, x).derivative;
        rule.nodes[static_cast<size_t>(i)] = x;
        rule.weights[static_cast<size_t>(i)] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
    return rule;
}

double integratePanels(const std::function<double(double)>& f, std::span<const double> breaks,
                       const QuadratureRule& rule) {
    double sum = 0.0;
    for (size_t panel = 0; panel + 1 < breaks.size(); ++panel) {
        const double half = 0.5 * (breaks[panel + 1] - breaks[panel]);
        const double middle = 0.5 * (breaks[panel + 1] + breaks[panel]);
        for (size_t i = 0; i < rule.nodes.size(); ++i)
            sum += half * rule.weights[i] * f(middle + half * rule.nodes[i]);
    }
    return sum;
}

std::vector<double> gradedBreaks(double first, double last, int count) {
    std::vector<double> breaks{0.0};
    for (int i = 0; i < count; ++i)
        breaks.push_back(first * std::pow(last / first, static_cast<double>(i) / (count - 1)));
    breaks.back() = last;
    return breaks;
}

double integrateHemisphere(const std::function<double(const glm::dvec3&)>& f, const glm::dvec3& axis,
                           std::span<const double> polarBreaks, int azimuthPanels,
                           const QuadratureRule& rule) {
    assert(axis.z > 0.0);
    const glm::dmat3 frame = frameAbout(axis);
    std::vector<double> azimuths;
    for (int i = 0; i <= azimuthPanels; ++i)
        azimuths.push_back(glm::two_pi<double>() * i / azimuthPanels);
    const auto wedge = [&](double azimuth) {
        // w.z = axis.z cos(polar) + side sin(polar) is zero at the horizon.
        const double side = (frame * fromPolar(glm::half_pi<double>(), azimuth)).z;
        const double horizon = std::atan2(axis.z, -side);
        return horizon * integratePanels(
                             [&](double fraction) {
                                 const double polar = horizon * fraction;
                                 return std::sin(polar) * f(frame * fromPolar(polar, azimuth));
                             },
                             polarBreaks, rule);
    };
    return integratePanels(wedge, azimuths, rule);
}

}  // namespace lobe
