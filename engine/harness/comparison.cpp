#include "harness/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>

#include "math/ulp.hpp"

namespace lobe::harness {
namespace {

constexpr double kRoundings = 4.0;

/// The unit of tolerance of a row whose value does not depend on the rounding of its inputs.
constexpr double kLeastUnit = kRoundings * kFloatRounding;

/// A power below e^-87 is 0 before it is multiplied by a lobe's scale, at most (1e6 + 2) / (2 pi).
constexpr double kUnderflow = 3e-33;

/// Beyond this a float is near its end: such values only have to be large and finite.
constexpr double kLargest = 1e37;

std::string digits(double value, int significant) {
    std::ostringstream text;
    text << std::setprecision(significant) << value;
    return text.str();
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

glm::dvec3 roundingUnit(const Brdf& brdf, const Directions& d, std::span<const double> values, Axes axes) {
    const Condition condition = conditionOf(brdf, d, values);
    const glm::dvec3 directions = axes == Axes::local ? condition.componentwise : condition.angular;
    return kFloatRounding *
           (kRoundings * condition.terms + directions + condition.length + condition.parameters);
}

bool tooNarrow(const Brdf& brdf, const Directions& d, std::span<const double> values) {
    const double turning = kFloatRounding / (brdf.traits.halfVectorLobe ? 0.5 * glm::length(d.h) : 1.0);
    return brdf.lobeSharpness(values) * turning > 0.03;
}

bool Comparison::check(const BrdfRow& row, const Directions& d, const glm::vec3& got) {
    const ParameterValues values = valuesOf(brdf_, row);
    const glm::dvec3 exact = brdf_.fCos(d, values);
    // Sixty evaluations of the twin, where a row's error alone does not tell.
    std::optional<glm::dvec3> known;
    const auto unitOf = [&](int channel) {
        if (!known) known = roundingUnit(brdf_, d, values, axes_);
        return (*known)[channel];
    };
    const bool unresolved = tooNarrow(brdf_, d, values);
    for (int c = 0; c < 3; ++c) {
        ++count_;
        const double value = double(got[c]);
        if (!std::isfinite(value) || value < 0.0) return fail(row, c, value, "finite and not negative");
        // No comparison with it would fail.
        if (std::isnan(exact[c])) return fail(row, c, value, "a value of the twin, which gave NaN");
        const auto unjudged = [&] { return unresolved || kAllowedUnits * unitOf(c) > kLargestAllowance; };
        if (exact[c] < 1e-38) {
            if (value < 1e-30) continue;
            if (!unjudged()) return fail(row, c, value, "below 1e-30");
            ++illConditioned_;
            continue;
        }
        if (exact[c] > kLargest) {
            if (value < 0.1 * kLargest && !unresolved)
                return fail(row, c, value, "about " + digits(kLargest, 1) + " or more");
            continue;
        }
        const double error = std::abs(value - exact[c]) / exact[c];
        // No condition number lets such a row fail or be the worst.
        const uint64_t ulps = ulpDistance(got[c], static_cast<float>(exact[c]));
        if (error <= worst_ * kLeastUnit && ulps <= worstUlp_) continue;
        if (unjudged()) {
            if (error > kAllowedUnits * kLeastUnit) ++illConditioned_;
            continue;
        }
        const double unit = unitOf(c);
        if (error > kAllowedUnits * unit + kUnderflow / exact[c])
            return fail(row, c, value,
                        digits(exact[c], 9) + " within " + digits(kAllowedUnits * unit / kFloatRounding, 4) +
                            " x 2^-24; off by " + digits(error / kFloatRounding, 4));
        if (exact[c] <= 1e6 * kUnderflow) continue;
        if (unit <= 2.0 * kLeastUnit) worstUlp_ = std::max(worstUlp_, ulps);
        if (error / unit > worst_) {
            worst_ = error / unit;
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
