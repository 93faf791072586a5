#include "harness/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "math/ulp.hpp"

namespace lobe::harness {
namespace {

constexpr double kFactor = 16.0;

/// A power below 2^-126 may be flushed to zero before it is multiplied by a lobe's scale, at most (1e6 + 2) /
/// (2 pi).
constexpr double kUnderflow = 2e-33;

std::string digits(double value, int significant) {
    std::ostringstream text;
    text << std::setprecision(significant) << value;
    return text.str();
}

/// Relative error that exp, log and exp2 bring in, from their measured bounds on llvmpipe (16.8e6 inputs
/// each): exp is off by 3.8 ulp on [-1, 1] and 64 ulp at 88, that is 4 + |x| ulp or less; log by 1.7e-7
/// absolute on [0.5, 2]; exp2 by 3.3 ulp. The lobe is exp(-E); where its logarithm is the built-in's, |log| >
/// 0.26, E carries 1.7e-7 / 0.26 relative. Only the lobe's share of the value is touched.
glm::dvec3 builtInError(const Brdf& brdf, const Directions& d, std::span<const double> values,
                        const glm::dvec3& f) {
    constexpr double kUlp = 0x1p-23;
    if (brdf.name != "phong" && brdf.name != "blinn_phong") return glm::dvec3(0.0);
    const double base =
        brdf.name == "phong" ? 2.0 * d.wi.z * d.wo.z - glm::dot(d.wi, d.wo) : glm::normalize(d.h).z;
    if (!(base > 0.0)) return glm::dvec3(0.0);
    const auto offset = [&](const char* name) {
        return static_cast<size_t>(brdf.valueOffset(brdf.parameterIndex(name)));
    };
    const double exponent = -values[offset("shininess")] * std::log(base);
    const double relative = (4.0 + exponent) * kUlp + exponent * 1.7e-7 / 0.26 + 3.3 * kUlp;
    ParameterValues withoutLobe(values.begin(), values.end());
    std::fill_n(withoutLobe.begin() + static_cast<std::ptrdiff_t>(offset("specular")), 3, 0.0);
    return relative * (f - brdf.fCos(d, withoutLobe)) / glm::max(f, glm::dvec3(1e-300));
}

}  // namespace

std::string describe(const BrdfRow& row) {
    std::ostringstream text;
    text << std::setprecision(9) << row.kind;
    for (const auto& [name, w] : {std::pair(": wi (", row.wi), std::pair(" wo (", row.wo)})
        text << name << w.x << ", " << w.y << ", " << w.z << ")";
    text << " values";
    for (float value : row.values)
        text << " " << value;
    return text.str();
}

bool Comparison::check(const BrdfRow& row, const Directions& d, const glm::vec3& got) {
    const ParameterValues values = valuesOf(row);
    const glm::dvec3 exact = brdf_.fCos(d, values);
    const Condition condition = conditionOf(brdf_, d, values);
    const glm::dvec3 directions = axes_ == Axes::local ? condition.componentwise : condition.angular;
    const glm::dvec3 unit = kFloatRounding * (4.0 + directions + condition.length + condition.parameters);
    const glm::dvec3 allowance = kFactor * unit + builtInError(brdf_, d, values, exact);
    for (int c = 0; c < 3; ++c) {
        ++count_;
        const double value = double(got[c]);
        if (!std::isfinite(value) || value < 0.0) return fail(row, c, value, "finite and not negative");
        if (exact[c] < 1e-38) {
            if (value >= 1e-30) return fail(row, c, value, "below 1e-30");
            continue;
        }
        if (allowance[c] > 0.1) {
            ++illConditioned_;
            continue;
        }
        const double error = std::abs(value - exact[c]) / exact[c];
        if (error > allowance[c] + kUnderflow / exact[c])
            return fail(row, c, value,
                        digits(exact[c], 9) + " within " + digits(allowance[c] / kFloatRounding, 4) +
                            " x 2^-24; off by " + digits(error / kFloatRounding, 4));
        if (error / unit[c] > worst_ && exact[c] > 1e6 * kUnderflow) {
            worst_ = error / unit[c];
            worstRelative_ = error;
            worstRow_ = describe(row);
        }
    }
    return true;
}

bool Comparison::fail(const BrdfRow& row, int channel, double value, const std::string& expected) {
    std::ostringstream text;
    text << brdf_.name << ", " << describe(row) << "\n  channel " << channel << ": " << std::setprecision(9)
         << value << "; expected " << expected;
    message_ = text.str();
    return false;
}

std::string Comparison::report() const {
    std::ostringstream text;
    text << count_ << " values, worst " << std::setprecision(3) << worst_ << " of 16 units (relative "
         << worstRelative_ << "), " << 100.0 * illConditionedShare()
         << " % too ill-conditioned to tell\n  worst at " << worstRow_;
    return text.str();
}

}  // namespace lobe::harness
