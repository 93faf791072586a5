#include "shading/area.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "math/cubature.hpp"
#include "math/sphere.hpp"

namespace lobe {
namespace {

constexpr double kPi = std::numbers::pi;

/// Adaptive integral from `low` to `high`; the second dimension of the rule idles.
double integrate(const std::function<double(double)>& f, double low, double high, int cells) {
    if (!(high > low)) return 0.0;
    CubatureOptions options;
    options.relativeError = 1e-8;
    options.absoluteError = 1e-30;
    options.cells = cells;
    options.evaluations = 100000;
    const auto scaled = [&](double u, double) { return glm::dvec3(f(low + u * (high - low))); };
    return (high - low) * integrateSquare(scaled, options).integral.x;
}

/// Integral of max(n.d, 0) sin(theta) over from <= theta <= to, 0..pi, with n.d = axial cos(theta) + radial
/// sin(theta).
double polarIntegral(double axial, double radial, double from, double to) {
    const double middle = std::atan2(radial, axial);  // above the horizon: less than pi/2 from here
    const double low = std::max(from, middle - kPi / 2), high = std::min(to, middle + kPi / 2);
    if (!(high > low)) return 0.0;
    const double sum = low + high, difference = high - low;
    return 0.5 * (axial * std::sin(sum) * std::sin(difference) +
                  radial * (difference - std::cos(sum) * std::sin(difference)));
}

struct Chord {
    double from, to;  ///< distances from the foot
};

/// Of a flat shape: half planes about the perpendicular to its plane, at azimuths from `low` to `high` about
/// `facing` (frameAbout), each of which it meets in a chord.
double flatFactor(const glm::dvec3& facing, double above, double low, double high,
                  const std::function<Chord(double)>& chord, bool roundEnds = false) {
    const glm::dmat3 frame = frameAbout(facing);
    const auto slice = [&](double azimuth) {
        const glm::dvec3 across = std::cos(azimuth) * frame[0] + std::sin(azimuth) * frame[1];
        const Chord c = chord(azimuth);
        return c.to > c.from
                   ? polarIntegral(-facing.z, across.z, std::atan2(c.from, above), std::atan2(c.to, above))
                   : 0.0;
    };
    if (!roundEnds) return integrate(slice, low, high, 24) / kPi;
    // Chords end in square roots where the half planes touch.
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
    const auto eased = [&](double t) { return slice(middle + half * std::sin(t)) * half * std::cos(t); };
    return integrate(eased, -kPi / 2, kPi / 2, 48) / kPi;
}

}  // namespace

double rectFactor(const glm::dvec3& center, const glm::dvec3& halfU, const glm::dvec3& halfV,
                  const glm::dvec3& facing) {
    const double above = -glm::dot(center, facing);
    if (!(above > 0.0)) return 0.0;
    const glm::dmat3 frame = frameAbout(facing);
    const auto flat = [&](const glm::dvec3& p) {
        return glm::dvec2(glm::dot(p, frame[0]), glm::dot(p, frame[1]));
    };
    const glm::dvec2 c = flat(center), u = flat(halfU), v = flat(halfV);
    const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
    const double area = cross(u, v);
    std::vector<double> breaks;
    for (const glm::dvec2& corner : {c + u + v, c + u - v, c - u - v, c - u + v})
        breaks.push_back(std::atan2(corner.y, corner.x));
    std::sort(breaks.begin(), breaks.end());
    breaks.push_back(breaks.front() + 2.0 * kPi);
    const auto chord = [&](double azimuth) {
        const glm::dvec2 d(std::cos(azimuth), std::sin(azimuth));
        // t d = c + a u + b v with |a|, |b| <= 1
        Chord result{0.0, HUGE_VAL};
        for (const auto& [at, step] : {std::pair(-cross(c, v) / area, cross(d, v) / area),
                                       std::pair(-cross(u, c) / area, cross(u, d) / area)}) {
            if (step == 0.0) {
                if (std::abs(at) > 1.0) return Chord{0.0, 0.0};
                continue;
            }
            const double t1 = (-1.0 - at) / step, t2 = (1.0 - at) / step;
            result.from = std::max(result.from, std::min(t1, t2));
            result.to = std::min(result.to, std::max(t1, t2));
        }
        return result;
    };
    double sum = 0.0;
    for (size_t i = 0; i + 1 < breaks.size(); ++i)
        sum += flatFactor(facing, above, breaks[i], breaks[i + 1], chord);
    return sum;
}

double diskFactor(const glm::dvec3& center, const glm::dvec3& facing, double radius) {
    const double above = -glm::dot(center, facing);
    if (!(above > 0.0)) return 0.0;
    const glm::dmat3 frame = frameAbout(facing);
    const glm::dvec2 c(glm::dot(center, frame[0]), glm::dot(center, frame[1]));
    const double off = glm::length(c), toCenter = std::atan2(c.y, c.x);
    const auto chord = [&](double azimuth) {
        const double along = off * std::cos(azimuth - toCenter), side = off * std::sin(azimuth - toCenter);
        const double root = std::sqrt(std::max(0.0, (radius - side) * (radius + side)));
        const double far = along + root;
        return Chord{off > radius ? (off - radius) * (off + radius) / far : 0.0, far};
    };
    const double reach = off > radius ? std::asin(radius / off) : kPi;
    return flatFactor(facing, above, toCenter - reach, toCenter + reach, chord, off > radius);
}

double sphereFactor(const glm::dvec3& center, double radius) {
    const double distance = glm::length(center);
    if (distance <= radius) return 1.0;
    const double limit = std::asin(radius / distance);
    const glm::dvec3 axis = center / distance;
    const glm::dmat3 frame = frameAbout(axis);
    const auto slice = [&](double azimuth) {
        const glm::dvec3 across = std::cos(azimuth) * frame[0] + std::sin(azimuth) * frame[1];
        return polarIntegral(axis.z, across.z, 0.0, limit);
    };
    return integrate(slice, 0.0, 2.0 * kPi, 64) / kPi;
}

double tubeFactor(const glm::dvec3& center, const glm::dvec3& halfAxis, double radius) {
    const double half = glm::length(halfAxis);
    const glm::dvec3 along = half > 0.0 ? halfAxis / half : glm::dvec3(1.0, 0.0, 0.0);
    const double middle = glm::dot(center, along);
    const glm::dvec3 toAxis = center - middle * along;
    const double distance = glm::length(toAxis);
    const double z1 = middle - half, z2 = middle + half;
    if (std::hypot(distance, std::clamp(0.0, z1, z2)) <= radius) return 1.0;
    // Off its end and within its cylinder, the nearer end hides the rest.
    if (distance <= radius) return sphereFactor(toAxis + std::clamp(0.0, z1, z2) * along, radius);
    const glm::dvec3 across = toAxis / distance, side = glm::cross(along, across);
    // Half planes through the origin along the tube, at an angle about it; each meets it in a strip with
    // round ends.
    const auto slice = [&](double tau) {
        const double angle = std::asin(radius / distance * std::sin(tau));
        const double x = distance * std::cos(angle), rho = radius * std::cos(tau);
        const double gap = std::sqrt((distance - radius) * (distance + radius));  // sqrt(x^2 - rho^2)
        const double low = std::atan2(z1, x) - std::atan2(rho, std::hypot(gap, z1));
        const double high = std::atan2(z2, x) + std::atan2(rho, std::hypot(gap, z2));
        const double outwards =
            glm::dot(std::cos(angle) * across + std::sin(angle) * side, glm::dvec3(0, 0, 1));
        // Integral of max(outwards cos t + along.z sin t, 0) cos t from low to high.
        const double middle2 = std::atan2(along.z, outwards);
        const double from = std::max(low, middle2 - kPi / 2), to = std::min(high, middle2 + kPi / 2);
        if (!(to > from)) return 0.0;
        const auto antiderivative = [&](double t) {
            return 0.5 * (outwards * (t + std::sin(t) * std::cos(t)) + along.z * std::sin(t) * std::sin(t));
        };
        return (antiderivative(to) - antiderivative(from)) * radius / distance * std::cos(tau) /
               std::cos(angle);
    };
    return integrate(slice, -kPi / 2, kPi / 2, 32) / kPi;
}

}  // namespace lobe
