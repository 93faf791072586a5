/// Many rows of a model's GLSL against its twin, on all cores.
#pragma once

#include <string>
#include <vector>

#include "harness/comparison.hpp"

namespace lobe::harness {

struct ModelFault {
    size_t row = 0;
    std::string message;
};

/// Figures as Comparison has them; each is the true one although condition numbers are only computed for rows
/// that may change it.
struct ModelComparison {
    std::vector<ModelFault> faults;  ///< in the order of the rows
    size_t values = 0;               ///< three a row
    double worstUnits = 0.0;         ///< of 16 allowed
    double worstRelative = 0.0;      ///< of the row of worstUnits
    std::string worstRow;
    uint64_t worstUlp = 0;  ///< of values with a condition number of at most 4
};

/// `got` are values of NAME_f_cos, one a row, directions given in the local frame.
ModelComparison compareWithTwin(const Brdf& brdf, const std::vector<BrdfRow>& rows,
                                const std::vector<glm::vec3>& got);

/// The share of values that say nothing of the formula, in a table with condition numbers for every row.
double illConditionedShare(const Brdf& brdf, const std::vector<BrdfRow>& rows,
                           const std::vector<glm::vec3>& got);

}  // namespace lobe::harness
