#include "shading/area.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "math/cubature.hpp"
#include "math/sphere.hpp"

namespace lobe {
namespace {

constexpr double kPi = std::numbers::pi;

/// Adaptive integral over [0, 1]; the second dimension of the rule idles.
double integrate(const std::function<double(double)>& f) {
    CubatureOptions options;
    options.relativeError = 1e-8;
    options.absoluteError = 1e-13;
    options.cells = 12;
    options.evaluations = 400000;
    return integrateSquare([&f](double u, double) { return glm::dvec3(f(u)); }, options).integral.x;
}

/// Integral of max(n.d, 0) sin(theta) over 0 <= theta <= limit <= pi, with n.d = axial cos(theta) + radial sin(theta).
double polarIntegral(double axial, double radial, double limit) {
    const double middle = std::atan2(radial, axial);  // above the horizon: less than pi/2 from here
    const auto antiderivative = [&](double t) {
        return 0.5 * (axial * std::sin(t) * std::sin(t) + radial * (t - std::sin(t) * std::cos(t)));
    };
    const double low = std::max(0.0, middle - kPi / 2), high = std::min(limit, middle + kPi / 2);
    return high > low ? antiderivative(high) - antiderivative(low) : 0.0;
}

/// Of what is seen from the origin within `limit`(direction across) of a unit axis.
double factorAbout(const glm::dvec3& axis, const std::function<double(const glm::dvec3&)>& limit) {
    const glm::dmat3 frame = frameAbout(axis);
    return 2.0 * integrate([&](double u) {
               const glm::dvec3 across = std::cos(2.0 * kPi * u) * frame[0] + std::sin(2.0 * kPi * u) * frame[1];
               return polarIntegral(axis.z, across.z, limit(across));
           });
}

/// Of a flat shape: `edge` is the distance from `inner`, a place of it, to its edge in a unit direction in its plane.
double flatFactor(const glm::dvec3& inner, const glm::dvec3& facing,
                  const std::function<double(const glm::dvec3&)>& edge) {
    const double distance = glm::length(inner);
    const glm::dvec3 axis = inner / distance;
    const double slant = glm::dot(axis, facing);
    if (!(slant < 0.0)) return 0.0;
    return factorAbout(axis, [&](const glm::dvec3& across) {
        const glm::dvec3 inPlane = glm::normalize(across - axis * (glm::dot(across, facing) / slant));
        const glm::dvec3 rim = inner + edge(inPlane) * inPlane;
        return std::atan2(glm::dot(rim, across), glm::dot(rim, axis));
    });
}

}  // namespace

double rectFactor(const glm::dvec3& center, const glm::dvec3& halfU, const glm::dvec3& halfV,
                  const glm::dvec3& facing) {
    const double width = glm::length(halfU), height = glm::length(halfV);
    const glm::dvec3 u = halfU / width, v = halfV / height;
    // About its nearest place, where most of the light comes from when it is near.
    const double x = std::clamp(-glm::dot(center, u), -0.99 * width, 0.99 * width);
    const double y = std::clamp(-glm::dot(center, v), -0.99 * height, 0.99 * height);
    return flatFactor(center + x * u + y * v, facing, [&](const glm::dvec3& direction) {
        const auto side = [](double at, double step, double half) {
            return step == 0.0 ? HUGE_VAL : (std::copysign(half, step) - at) / step;
        };
        return std::min(side(x, glm::dot(direction, u), width), side(y, glm::dot(direction, v), height));
    });
}

double diskFactor(const glm::dvec3& center, const glm::dvec3& facing, double radius) {
    const glm::dvec3 toFoot = -(center - facing * glm::dot(center, facing));
    const double off = glm::length(toFoot);
    const glm::dvec3 shift = off > 0.0 ? toFoot * (std::min(off, 0.99 * radius) / off) : glm::dvec3(0.0);
    const double gap = (radius - glm::length(shift)) * (radius + glm::length(shift));
    return flatFactor(center + shift, facing, [&](const glm::dvec3& direction) {
        const double along = glm::dot(shift, direction);
        const double root = std::sqrt(along * along + gap);
        return along > 0.0 ? gap / (root + along) : root - along;
    });
}

double sphereFactor(const glm::dvec3& center, double radius) {
    const double distance = glm::length(center);
    if (distance <= radius) return 1.0;
    const double limit = std::asin(radius / distance);
    return factorAbout(center / distance, [limit](const glm::dvec3&) { return limit; });
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
    // Half planes through the origin along the tube, at an angle about it; each meets it in a strip with round ends.
    const double sum = integrate([&](double u) {
        const double tau = kPi * (u - 0.5);
        const double angle = std::asin(radius / distance * std::sin(tau));
        const double x = distance * std::cos(angle), rho = radius * std::cos(tau);
        const double gap = std::sqrt((distance - radius) * (distance + radius));  // sqrt(x^2 - rho^2)
        const double low = std::atan2(z1, x) - std::atan2(rho, std::hypot(gap, z1));
        const double high = std::atan2(z2, x) + std::atan2(rho, std::hypot(gap, z2));
        const double outwards = glm::dot(std::cos(angle) * across + std::sin(angle) * side, glm::dvec3(0, 0, 1));
        // Integral of max(outwards cos t + along.z sin t, 0) cos t from low to high.
        const double center2 = std::atan2(along.z, outwards);
        const double from = std::max(low, center2 - kPi / 2), to = std::min(high, center2 + kPi / 2);
        if (!(to > from)) return 0.0;
        const auto antiderivative = [&](double t) {
            return 0.5 * (outwards * (t + std::sin(t) * std::cos(t)) + along.z * std::sin(t) * std::sin(t));
        };
        return (antiderivative(to) - antiderivative(from)) * kPi * radius / distance * std::cos(tau) /
               std::cos(angle);
    });
    return sum / kPi;
}

}  // namespace lobe
