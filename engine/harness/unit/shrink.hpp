/// Finds the simplest input that fails in the same way.
#pragma once

#include "harness/unit/unit_judge.hpp"

namespace lobe::harness {

/// Sum over the inputs, and the partner of a monotone one.
double complexityOfRow(const TestCase& test, const UnitRow& row);

/// `row` fails with `fault`; so does what is returned. Candidates are evaluated on the GPU, a table a round.
UnitRow shrunk(UnitJudge& judge, const TestCase& test, UnitRow row, const Fault& fault);

}  // namespace lobe::harness
