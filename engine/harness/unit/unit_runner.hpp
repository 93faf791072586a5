/// Runs a test: all its rows, then the search for the simplest that fails.
#pragma once

#include "harness/unit/unit_result.hpp"
#include "harness/unit/unit_rows.hpp"

#include "gl/program.hpp"

namespace lobe::harness {

/// What takes the place of @inputs and @seed.
struct RunSettings {
    std::optional<int64_t> rows;
    std::optional<uint64_t> seed;
    uint64_t repetition = 0;  ///< added to the seed
};

/// The context must be current. Throws ShaderError and InputError.
UnitResult runTest(const gl::ShaderLibrary& library, const TestFile& file, const TestCase& test,
                   const RunSettings& settings);

/// A result with the test's name and place.
UnitResult resultFor(const TestFile& file, const TestCase& test);

/// Where test files find what they include, beside their own folders: `folders`, then Lobe's GLSL.
gl::ShaderLibrary unitLibrary(std::vector<std::filesystem::path> folders);

}  // namespace lobe::harness
