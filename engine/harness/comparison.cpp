#include "harness/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>

#include "math/ulp.hpp"

namespace lobe::harness {
namespace {

constexpr double kFactor = 16.0;

/// A power below e^-87 is 0 before it is multiplied by a lobe's scale, at most (1e6 + 2) / (2 pi).
constexpr double kUnderflow = 3e-33;

/// Lobes that one rounding of a direction takes across this share of their width can't be followed by
/// differences.
constexpr double kNarrowest = 0.03;

/// The least that 4 + c can be; and the largest c for which ulps are worth counting.
constexpr double kWellConditioned = 4.0;

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

bool Comparison::check(const BrdfRow& row, const Directions& d, const glm::vec3& got) {
    const ParameterValues values = valuesOf(brdf_, row);
    const glm::dvec3 exact = brdf_.fCos(d, values);
    std::optional<glm::dvec3> number;
    const auto conditionNumber = [&] {
        if (!number) {
            const Condition condition = conditionOf(brdf_, d, values);
            number = (axes_ == Axes::local ? condition.componentwise : condition.angular) + condition.length +
                     condition.parameters;
        }
        return *number;
    };
    if (conditions_ == Conditions::always) conditionNumber();
    const bool unresolved = brdf_.lobeSharpness(values) * kFloatRounding > kNarrowest;
    for (int c = 0; c < 3; ++c) {
        ++count_;
        const double value = double(got[c]);
        if (!std::isfinite(value) || value < 0.0) return fail(row, c, value, "finite and not negative");
        if (unresolved) {
            ++illConditioned_;
            continue;
        }
        if (exact[c] < 1e-38) {
            if (value >= 1e-30) return fail(row, c, value, "below 1e-30");
            continue;
        }
        if (exact[c] > kLargest) {
            if (value < 0.1 * kLargest)
                return fail(row, c, value, "about " + digits(kLargest, 1) + " or more");
            continue;
        }
        const double error = std::abs(value - exact[c]) / exact[c];
        const uint64_t ulps = ulpDistance(got[c], static_cast<float>(exact[c]));
        if (conditions_ == Conditions::whenNeeded && error <= worst_ * kWellConditioned * kFloatRounding &&
            ulps <= worstUlp_)
            continue;
        const double unit = kFloatRounding * (4.0 + conditionNumber()[c]);
        const double allowance = kFactor * unit;
        if (allowance > 0.1) {
            ++illConditioned_;
            continue;
        }
        if (error > allowance + kUnderflow / exact[c])
            return fail(row, c, value,
                        digits(exact[c], 9) + " within " + digits(allowance / kFloatRounding, 4) +
                            " x 2^-24; off by " + digits(error / kFloatRounding, 4));
        if (exact[c] <= 1e6 * kUnderflow) continue;
        if (conditionNumber()[c] <= kWellConditioned) worstUlp_ = std::max(worstUlp_, ulps);
        if (error > worst_ * unit) {
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
