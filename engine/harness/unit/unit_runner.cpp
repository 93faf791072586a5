#include "harness/unit/unit_runner.hpp"

#include <chrono>

#include "base/resources.hpp"
#include "harness/unit/shrink.hpp"
#include "harness/unit/unit_report.hpp"

namespace lobe::harness {
namespace {

/// Of each table, so many failing rows are looked at for the simplest.
constexpr size_t kMostCompared = 256;

struct Worst {
    UnitRow row;
    Fault fault;
    double complexity = 0.0;
};

/// Runs all rows; keeps the simplest of those that fail.
std::optional<Worst> runRows(UnitJudge& judge, const TestCase& test, const RowSource& source,
                             UnitResult& result) {
    std::optional<Worst> simplest;
    const size_t step = UnitProgram::kMostRows;
    for (uint64_t first = 0; first < source.count(); first += step) {
        const auto n = static_cast<size_t>(std::min<uint64_t>(step, source.count() - first));
        const UnitRows rows = source.rows(first, n);
        const Verdicts verdicts = judge.judge(rows);
        result.failing += verdicts.faults.size();
        result.skipped += verdicts.skipped;
        for (size_t i = 0; i < std::min(verdicts.faults.size(), kMostCompared); ++i) {
            const auto& [index, fault] = verdicts.faults[i];
            UnitRow row = rows.row(index);
            const double complexity = complexityOfRow(test, row);
            if (!simplest || complexity < simplest->complexity)
                simplest = Worst{std::move(row), fault, complexity};
        }
    }
    return simplest;
}

void fail(UnitResult& result, const std::string& message) {
    result.status = UnitResult::Status::failed;
    result.message = message;
}

void invertIfMustFail(UnitResult& result) {
    if (!result.mustFail) return;
    if (result.status == UnitResult::Status::passed) {
        fail(result, "passed, but must fail: " + *result.mustFail);
    } else {
        result.status = UnitResult::Status::passed;
        result.message.clear();
    }
}

}  // namespace

UnitResult resultFor(const TestFile& file, const TestCase& test) {
    UnitResult result;
    result.file = file.name;
    result.name = test.name;
    result.line = test.place.line;
    result.tags = test.tags;
    result.mustFail = test.mustFail;
    return result;
}

gl::ShaderLibrary unitLibrary(std::vector<std::filesystem::path> folders) {
    folders.push_back(shaderDirectory());
    return gl::ShaderLibrary::ofFiles(std::move(folders));
}

UnitResult runTest(const gl::ShaderLibrary& library, const TestFile& file, const TestCase& test,
                   const RunSettings& settings) {
    const auto started = std::chrono::steady_clock::now();
    UnitResult result = resultFor(file, test);
    result.seed = settings.seed.value_or(test.seed.value_or(kDefaultSeed)) + settings.repetition;
    const RowSource source(test, settings.rows.value_or(test.rows.value_or(kDefaultRows)), result.seed);
    result.rows = source.count();
    const UnitProgram program(library, file, test);
    UnitJudge judge(program, test);
    if (const std::optional<Worst> worst = runRows(judge, test, source, result)) {
        const UnitRow row = shrunk(judge, test, worst->row, worst->fault);
        UnitRows one;
        one.append(row);
        const Verdicts verdicts = judge.judge(one);
        const Fault fault = verdicts.faults.empty() ? worst->fault : verdicts.faults.front().second;
        result.failure = describeFailure(program, test, judge.evaluate(row), fault);
        fail(result, std::to_string(result.failing) + " of " + std::to_string(result.rows) + " inputs fail");
    }
    if (result.skipped == result.rows)
        fail(result,
             "assume() left no input out of " + std::to_string(result.rows));  // also of one that must
    else
        invertIfMustFail(result);
    result.milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - started).count();
    return result;
}

}  // namespace lobe::harness
