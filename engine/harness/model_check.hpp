/// Many rows of a model's GLSL against its twin, on all cores.
#pragma once

#include <string>
#include <vector>

#include "harness/comparison.hpp"

namespace lobe::harness {

struct ModelFault {
    size_t row = 0;  ///< counted over all that was added
    std::string message;
};

/// What Comparison knows, of all rows.
struct ModelFigures {
    size_t values = 0;           ///< three a row
    double worstUnits = 0.0;     ///< of 16 allowed
    double worstRelative = 0.0;  ///< of the row of worstUnits
    std::string worstRow;
    uint64_t worstUlp = 0;  ///< of values with a condition number of at most 4
    double illConditionedShare = 0.0;
};

class ModelCheck {
public:
    /// Throws UsageError for a model without a twin.
    explicit ModelCheck(const Brdf& brdf);

    /// `got` are values of NAME_f_cos, one a row, directions given in the local frame.
    void add(const std::vector<BrdfRow>& rows, const std::vector<glm::vec3>& got);

    ModelFigures figures() const;
    const std::vector<ModelFault>& faults() const { return faults_; }  ///< in the order of the rows

private:
    const Brdf& brdf_;
    std::vector<Comparison> parts_;  ///< one a thread
    std::vector<ModelFault> faults_;
    size_t rows_ = 0;
};

}  // namespace lobe::harness
