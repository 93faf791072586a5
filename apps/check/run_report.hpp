/// All results of a run, and the forms in which others read them.
#pragma once

#include <string>
#include <vector>

#include "harness/unit/unit_result.hpp"

namespace lobe::app {

struct RunReport {
    std::vector<harness::UnitResult> results;
    std::string backend, renderer;
    double seconds = 0.0;

    size_t count(harness::UnitResult::Status status) const;
    /// Of the worst: unreadable input, shader error, other errors, failed test; 0 if all passed.
    ExitCode exitCode() const;
};

/// What a person reads of a failure, without colours, line by line.
std::vector<std::string> failureLines(const harness::UnitResult& result);

std::string junitXml(const RunReport& report);
std::string jsonText(const RunReport& report);
std::string tapText(const RunReport& report);

/// Writes a report to a file, or to standard output for "-". Throws OutputError.
void writeReport(const std::string& target, const std::string& text);

}  // namespace lobe::app
