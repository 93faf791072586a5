/// A failing row in words, and as a test to paste.
#pragma once

#include "harness/unit/unit_judge.hpp"
#include "harness/unit/unit_result.hpp"

namespace lobe::harness {

UnitFailure describeFailure(const UnitProgram& program, const TestCase& test, const Evaluation& evaluation,
                            const Fault& fault);

/// A test of this one row, to stand at the end of the same file.
std::string regressionTest(const TestCase& test, const Evaluation& evaluation);

}  // namespace lobe::harness
