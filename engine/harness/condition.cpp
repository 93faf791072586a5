#include "harness/condition.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "math/sphere.hpp"
#include "math/ulp.hpp"

namespace lobe::harness {
namespace {

/// Larger of |f(+step) - f| and |f(-step) - f|, over step and f, channel by channel.
glm::dvec3 relativeSlope(const std::function<glm::dvec3(double)>& f, double step, const glm::dvec3& centre) {
    const glm::dvec3 difference = glm::max(glm::abs(f(step) - centre), glm::abs(f(-step) - centre)) / step;
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

/// By what a parameter's rounding is a share of: itself, or its distance from 1 where its range ends there.
double roundedSize(const Parameter& parameter, double value) {
    if (parameter.kind == ParameterKind::choice || parameter.kind == ParameterKind::table) return 0.0;
    const double size = std::abs(value);
    return parameter.maximum == 1.0 ? std::min(size, 1.0 - value) : size;
}

}  // namespace

Condition conditionOf(const Brdf& brdf, const Directions& d, std::span<const double> values, double step) {
    Condition condition;
    const glm::dvec3 f = brdf.fCos(d, values);
    if (f == glm::dvec3(0.0)) return condition;

    if (brdf.termSizes) {
        const glm::dvec3 sizes = brdf.termSizes(d, values);
        for (int c = 0; c < 3; ++c)
            if (f[c] > 0.0) condition.terms[c] = std::max(sizes[c] / f[c], 1.0);
    }
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

    for (const bool ofLight : {true, false})
        condition.length += relativeSlope(
            [&](double by) {
                Directions stretched = d;
                stretched.h += by * (ofLight ? d.wi : d.wo);
                if (!brdf.traits.anglesOnly) (ofLight ? stretched.wi : stretched.wo) *= 1.0 + by;
                return brdf.fCos(stretched, values);
            },
            step, f);

    size_t offset = 0;
    for (const Parameter& parameter : brdf.parameters) {
        for (int c = 0; c < parameter.components(); ++c, ++offset) {
            const double size = roundedSize(parameter, values[offset]);
            if (size <= 0.0) continue;
            ParameterValues changed(values.begin(), values.end());
            condition.parameters += relativeSlope(
                [&](double by) {
                    changed[offset] = values[offset] + by * size;
                    return brdf.fCos(d, changed);
                },
                step, f);
        }
    }
    return condition;
}

}  // namespace lobe::harness
