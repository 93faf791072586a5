/// Test files: ordinary GLSL, in which `///` comments before a function make it a test (docs/lobe_check.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/unit/expectation.hpp"
#include "harness/unit/generator.hpp"
#include "shading/brdf.hpp"

namespace lobe::harness {

enum class Stage : uint8_t { fragment, vertex };

/// One input of a test. For models: "wi", "wo" and the model's parameters.
struct TestInput {
    std::string name;
    GlslType type;
    std::optional<Generator> generator;  ///< nothing: the model's table
    int offset = 0;                      ///< of its first word in a row
};

struct TestCase {
    std::string name;
    std::vector<std::string> tags;
    SourcePlace place;  ///< of the function
    std::string function;
    std::optional<GlslType> result;  ///< nothing: void
    std::vector<TestInput> inputs;
    std::vector<Expectation> expectations;
    const Brdf* model = nullptr;  ///< the function takes (Dirs, NAMEParams)
    std::optional<int64_t> rows;
    std::optional<uint64_t> seed;
    Stage stage = Stage::fragment;
    std::optional<std::string> mustFail;  ///< the reason

    int width() const;  ///< words in a row
    /// The expectation that needs two rows, if any.
    const Expectation* monotone() const;
    const TestInput& monotoneInput() const;
};

struct TestFile {
    std::filesystem::path path;
    std::string name;  ///< for people
    std::vector<TestCase> tests;
    std::vector<std::filesystem::path> csvFiles;
};

/// Throws InputError "FILE:LINE: ..." for a file that can't be read and for directives that are wrong.
TestFile readTestFile(const std::filesystem::path& path);

}  // namespace lobe::harness
