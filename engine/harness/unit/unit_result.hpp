/// What became of a test, as data: for people, JUnit, JSON and TAP, and for the way from the worker.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace lobe::harness {

/// One input of a failing row.
struct FailedInput {
    std::string name, type;
    std::string value;    ///< for people: decimal, and hexadecimal where it is a float
    std::string literal;  ///< as a test writes it: parses to the same bits
};

/// The simplest failing row that was found.
struct UnitFailure {
    std::vector<FailedInput> inputs;
    std::string expected;  ///< the expectation, or the check's line of GLSL
    std::string place;     ///< FILE:LINE of the expectation or the check
    std::vector<std::pair<std::string, std::string>> values;  ///< what they are, and the values
    std::string regression;                                   ///< GLSL to paste
};

struct UnitResult {
    enum class Status : uint8_t { passed, failed, error };

    std::string file, name;
    int line = 0;
    std::vector<std::string> tags;
    Status status = Status::passed;
    ExitCode code = ExitCode::ok;  ///< of an error
    std::string message;           ///< one line or more; empty if passed
    uint64_t rows = 0, failing = 0, skipped = 0;
    uint64_t seed = 0;
    double milliseconds = 0.0;
    std::optional<std::string> mustFail;  ///< the reason
    std::optional<UnitFailure> failure;   ///< also of one that failed as it must
};

nlohmann::ordered_json toJson(const UnitResult& result);
/// From toJson's; throws nlohmann::json::exception.
UnitResult unitResultFrom(const nlohmann::json& json);

}  // namespace lobe::harness
