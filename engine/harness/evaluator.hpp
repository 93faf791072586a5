/// Evaluates GLSL over tables of inputs on the GPU: a fragment a row, full floats in and out.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gl/context.hpp"
#include "gl/program.hpp"

namespace lobe::harness {

/// A named input of a snippet: float, vec2, vec3, vec4, or int (passed as a float, so exact to 2^24).
struct Variable {
    std::string type;
    std::string name;
};

/// A piece of GLSL that reads its inputs by name and writes `result`, an array of vec4, all zero at first.
struct Snippet {
    std::string name;                   ///< for messages
    std::vector<std::string> includes;  ///< files of the GLSL library
    std::vector<Variable> inputs;       ///< one row holds them one after the other
    std::string body;                   ///< statements
    int results = 1;                    ///< vec4s in `result`, 1..8
    std::string functions;              ///< optional GLSL before main()
};

/// Floats in a row of inputs.
int inputWidth(const Snippet& snippet);

/// Rows of 4 * results floats.
struct ResultTable {
    int width = 4;
    std::vector<float> values;
    size_t rows() const { return values.size() / static_cast<size_t>(width); }
    std::span<const float> row(size_t i) const {
        return std::span(values).subspan(i * static_cast<size_t>(width), static_cast<size_t>(width));
    }
};

/// Compiles once, evaluates any number of tables. The context must be current and outlive it.
class Evaluator {
public:
    /// Throws ShaderError as gl::Program does; lines of the body are named "generated/NAME.frag".
    Evaluator(const gl::ShaderLibrary& library, Snippet snippet);

    /// `inputs` holds rows of inputWidth() floats; every bit pattern arrives as it is. `brdfTable` is what
    /// common/table.glsl reads, four floats a row.
    ResultTable evaluate(std::span<const float> inputs, std::span<const float> brdfTable = {}) const;

    /// For benchmarks: milliseconds of each of `runs` draws of the table, without upload and reading back. On
    /// software drivers those of all cores together, which other programs do not stretch.
    std::vector<double> drawTimes(std::span<const float> inputs, std::span<const float> brdfTable, int runs,
                                  bool softwareDriver) const;

    const Snippet& snippet() const { return snippet_; }

private:
    Snippet snippet_;
    gl::Program program_;
};

/// The fragment shader that a snippet becomes.
std::string snippetSource(const Snippet& snippet);

}  // namespace lobe::harness
