/// Whether rows are as their test expects.
#pragma once

#include <memory>
#include <optional>

#include "harness/unit/unit_program.hpp"
#include "harness/unit/unit_rows.hpp"

namespace lobe::harness {

/// What is wrong with a row.
struct Fault {
    enum class Kind : uint8_t { check, returnedFalse, expectation };
    Kind kind = Kind::check;
    size_t place = 0;   ///< check: line of the program's text; expectation: its number
    int component = 0;  ///< of the value

    bool isAlike(const Fault& other) const { return kind == other.kind && place == other.place; }
};

struct Verdicts {
    std::vector<std::pair<size_t, Fault>> faults;  ///< with the number of the row
    size_t skipped = 0;                            ///< by assume()
};

/// What a row gave, with all that words about it need.
struct Evaluation {
    UnitRow row;
    Words output, partnerOutput;
    RowOutput result() const { return {output}; }
};

class UnitJudge {
public:
    UnitJudge(const UnitProgram& program, const TestCase& test) : program_(program), test_(test) {}

    /// Evaluates rows and judges each.
    Verdicts judge(const UnitRows& rows);
    /// One row again.
    Evaluation evaluate(const UnitRow& row) const;

private:
    std::optional<Fault> faultOf(const UnitRows& rows, size_t i, const RowOutput& output,
                                 const RowOutput& partner, const std::vector<bool>& twinFaults) const;

    const UnitProgram& program_;
    const TestCase& test_;
};

/// Number of a function's reference among the outputs.
size_t referenceIndex(const TestCase& test, size_t expectation);

/// The value that expectation number `i` compares with: a reference's, a constant, a row of a file. Nothing
/// where there is none.
std::optional<Words> expectedWords(const TestCase& test, size_t expectation, const Evaluation& evaluation);

}  // namespace lobe::harness
