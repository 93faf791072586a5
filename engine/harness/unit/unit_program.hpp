/// A test as a GLSL program, run over rows of inputs in the fragment or the vertex stage.
#pragma once

#include <span>
#include <vector>

#include "gl/program.hpp"
#include "harness/unit/test_file.hpp"

namespace lobe::harness {

/// What a row gave, in four words each.
struct RowOutput {
    std::span<const uint32_t> words;

    std::span<const uint32_t> value(int components) const {
        return words.subspan(0, static_cast<size_t>(components));
    }
    uint32_t failedLine() const { return words[4]; }  ///< of the program's text, 0 if no check failed
    uint32_t failedKind() const { return words[5]; }
    GlslType::Base failedBase() const { return static_cast<GlslType::Base>(words[6]); }
    bool skipped() const { return words[7] != 0; }
    std::span<const uint32_t> failedValues() const { return words.subspan(8, 3); }
    /// Of expectation number `i` that equals a function.
    std::span<const uint32_t> reference(size_t i) const { return words.subspan(12 + 4 * i, 4); }
};

struct RowOutputs {
    size_t width = 0;  ///< words a row
    std::vector<uint32_t> words;
    RowOutput row(size_t i) const { return {std::span(words).subspan(i * width, width)}; }
};

/// The context must be current and outlive it.
class UnitProgram {
public:
    /// Rows that are evaluated at once, at most.
    static constexpr size_t kMostRows = size_t{1} << 18;

    /// `library` finds what the file includes, and test/check.glsl. Throws ShaderError.
    UnitProgram(const gl::ShaderLibrary& library, const TestFile& file, const TestCase& test);

    /// Rows of test.width() words.
    RowOutputs evaluate(std::span<const uint32_t> rows) const;

    /// A line of the program's text: where it is from, and what it says.
    SourcePlace placeOf(size_t line) const;
    std::string lineText(size_t line) const;

private:
    RowOutputs evaluateFragments(unsigned inputs, size_t rows) const;
    RowOutputs evaluateVertices(unsigned inputs, size_t rows) const;

    const TestCase& test_;
    gl::ShaderSource source_;
    gl::Program program_;
    std::vector<float> tables_;
    std::vector<int> firstRows_;
    int outputs_ = 0;  ///< uvec4s a row
};

/// The shader that a test becomes.
std::string unitSource(const TestFile& file, const TestCase& test);
/// uvec4s that it writes a row.
int unitOutputs(const TestCase& test);

}  // namespace lobe::harness
