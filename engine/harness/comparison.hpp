/// A model's GLSL against its double-precision twin, row by row.
///
/// Tolerance of a row: 16 x 2^-24 (4 + c), relative, c the condition number of the row (condition.hpp); 4
/// times the size of the terms over their sum where terms cancel. Rows whose allowance exceeds 10 % say
/// nothing about the formula and only have to be finite and not negative; other rows below 1e-38 have to stay
/// below 1e-30. The condition number is computed only where the error exceeds the worst one so far with c =
/// 0, which leaves every verdict and the worst row as they are.
#pragma once

#include <string>

#include "harness/brdf_table.hpp"
#include "harness/condition.hpp"

namespace lobe::harness {

/// How the rows' directions reached the GLSL.
enum class Axes {
    local,  ///< as components in the local frame: rounding is relative in each
    world   ///< in other axes: rounding turns them
};

/// 2^-24 (4 + c) of a row, channel by channel, of which kAllowedUnits are allowed.
glm::dvec3 roundingUnit(const Brdf& brdf, const Directions& d, std::span<const double> values, Axes axes);
inline constexpr double kAllowedUnits = 16.0;
/// Relative allowance above which a row says nothing about the formula.
inline constexpr double kLargestAllowance = 0.1;
/// Whether one rounding of a direction takes the lobe across 3 % of its width or more, so that differences
/// can't follow it. A rounding turns the half vector by that much over cos(theta_d): where the directions
/// nearly oppose each other, wide lobes are among them.
bool tooNarrow(const Brdf& brdf, const Directions& d, std::span<const double> values);

/// Keeps the worst error of a table in units of 2^-24 (4 + c).
class Comparison {
public:
    /// Throws UsageError for a model without a twin.
    Comparison(const Brdf& brdf, Axes axes) : brdf_(brdf), axes_(axes) { requireTwin(brdf); }

    /// False if the row fails; message() then says where, with both values and the tolerance. `d` are the
    /// row's directions in the local frame, in double.
    bool check(const BrdfRow& row, const Directions& d, const glm::vec3& got);

    const std::string& message() const { return message_; }
    size_t count() const { return count_; }
    double worst() const { return worst_; }                  ///< of 16
    double worstRelative() const { return worstRelative_; }  ///< of the row of worst()
    const std::string& worstRow() const { return worstRow_; }
    /// Of the values whose condition number is at most 4.
    uint64_t worstUlp() const { return worstUlp_; }
    /// Share of the values that were not judged: off by more than 16 x 2^-24 x 4 where the allowance exceeds
    /// 10 %, or of a lobe too narrow to be resolved.
    double illConditionedShare() const {
        return static_cast<double>(illConditioned_) / static_cast<double>(count_);
    }
    std::string report() const;

private:
    bool fail(const BrdfRow& row, int channel, double value, const std::string& expected);

    const Brdf& brdf_;
    Axes axes_;
    std::string message_;
    size_t count_ = 0;
    size_t illConditioned_ = 0;
    double worst_ = 0.0;
    double worstRelative_ = 0.0;
    uint64_t worstUlp_ = 0;
    std::string worstRow_;
};

/// A row with all digits, for messages.
std::string describe(const BrdfRow& row);

}  // namespace lobe::harness
