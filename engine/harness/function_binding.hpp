/// A function of a GLSL file bound to the columns of a table, and the GLSL that calls it.
#pragma once

#include <string>
#include <vector>

#include "harness/evaluator.hpp"
#include "harness/signature.hpp"
#include "harness/table_evaluation.hpp"

namespace lobe::harness {

/// Floats by which a number goes to and from GLSL: whole numbers as two, of 16 bits each.
int floatsOf(GlslScalar scalar);

/// A function, what it reads and returns, and the shader for it.
struct FunctionBinding {
    struct Input {
        GlslLeaf leaf;
        size_t column = 0;
    };
    struct Output {
        GlslLeaf leaf;
        std::string variable;  ///< of ours that holds it
    };
    std::vector<Input> inputs;
    std::vector<Output> outputs;
    Snippet snippet;

    /// `file` is for messages, `path` for the shader. Throws as functionEvaluation() does.
    FunctionBinding(const gl::ShaderLibrary& library, const std::string& path, const std::string& file,
                    const std::string& name, const TableHeader& header);
};

}  // namespace lobe::harness
