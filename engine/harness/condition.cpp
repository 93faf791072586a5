#include "harness/condition.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "math/sphere.hpp"

namespace lobe::harness {
namespace {

/// |f(+step) - f(-step)| / (2 step f), channel by channel.
glm::dvec3 relativeSlope(const std::function<glm::dvec3(double)>& f, double step, const glm::dvec3& centre) {
    const glm::dvec3 difference = glm::abs(f(step) - f(-step)) / (2.0 * step);
    glm::dvec3 slope(0.0);
    for (int c = 0; c < 3; ++c)
        if (centre[c] > 0.0) slope[c] = difference[c] / centre[c];
    return slope;
}

glm::dvec3 turnedBy(const glm::dvec3& w, const glm::dvec3& perpendicular, double angle) {
    return w * std::cos(angle) + perpendicular * std::sin(angle);
}

glm::dvec3 gradientLength(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::sqrt(a * a + b * b);
}

}  // namespace

Condition conditionOf(const Brdf& brdf, const Directions& d, std::span<const double> values) {
    Condition condition;
    const glm::dvec3 f = brdf.fCos(d, values);
    if (f == glm::dvec3(0.0)) return condition;

    // A thousandth of the narrowest lobe: the differences' own error is below 1e-5 of the slope.
    const double step = 1e-3 / (10.0 + brdf.lobeSharpness(values));
    for (int k = 0; k < 3; ++k) {
        const auto scaled = [k](glm::dvec3 w, double by) {
            w[k] *= 1.0 + by;
            return glm::normalize(w);
        };
        condition.componentwise += relativeSlope(
                                       [&](double by) {
                                           return brdf.fCos({scaled(d.wi, by), d.wo}, values);
                                       },
                                       step, f) +
                                   relativeSlope(
                                       [&](double by) {
                                           return brdf.fCos({d.wi, scaled(d.wo, by)}, values);
                                       },
                                       step, f);
    }

    // Never across the horizon, where f is cut off.
    const double angle = std::min(step, 0.1 * std::min(d.wi.z, d.wo.z));
    const glm::dmat3 atLight = frameAbout(d.wi);
    const glm::dmat3 atEye = frameAbout(d.wo);
    const auto light = [&](int axis) {
        return relativeSlope(
            [&](double by) {
                return brdf.fCos({turnedBy(d.wi, atLight[axis], by), d.wo}, values);
            },
            angle, f);
    };
    const auto eye = [&](int axis) {
        return relativeSlope(
            [&](double by) {
                return brdf.fCos({d.wi, turnedBy(d.wo, atEye[axis], by)}, values);
            },
            angle, f);
    };
    condition.angular = gradientLength(light(0), light(1)) + gradientLength(eye(0), eye(1));

    size_t offset = 0;
    for (const Parameter& parameter : brdf.parameters) {
        const bool continuous = parameter.kind != ParameterKind::choice;
        for (int c = 0; c < parameter.components(); ++c, ++offset) {
            if (!continuous || values[offset] == 0.0) continue;
            ParameterValues changed(values.begin(), values.end());
            condition.parameters += relativeSlope(
                [&](double by) {
                    changed[offset] = values[offset] * (1.0 + by);
                    return brdf.fCos(d, changed);
                },
                1e-6, f);
        }
    }
    return condition;
}

}  // namespace lobe::harness
