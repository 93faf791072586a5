/// Functions and structs that GLSL text declares, as far as calling one from outside needs.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gl/program.hpp"

namespace lobe::harness {

/// A variable's type and name: a parameter of a function, a field of a struct.
struct GlslVariable {
    std::string type;  ///< as written, arrays with "[]" behind it
    std::string name;  ///< empty where a parameter has none
    bool in = true;    ///< parameters: `out` alone is not read
    bool out = false;  ///< parameters: `out` or `inout`
};

struct GlslFunction {
    std::string result;  ///< its type, or "void"
    std::string name;
    std::vector<GlslVariable> parameters;
    std::string file;  ///< where it stands
    int line = 0;
};

/// "vec3 brdf(vec3 l, vec3 v)"
std::string describe(const GlslFunction& function);

/// What a text declares at its outermost level. Branches of #if are all taken; macros without arguments that
/// stand for one word are replaced.
struct GlslDeclarations {
    std::vector<GlslFunction> functions;  ///< definitions and prototypes, each signature once
    std::map<std::string, std::vector<GlslVariable>> structs;
};
GlslDeclarations declarationsOf(const gl::ShaderSource& source);

enum class GlslScalar { floating, integer, unsignedInteger, boolean };

/// One number of a variable, and how GLSL reaches it: "v.x", "p.alpha".
struct GlslLeaf {
    std::string path;
    GlslScalar scalar = GlslScalar::floating;
};

/// The numbers that a variable consists of, in the order of its declaration, structs flattened. Throws
/// InputError for types that can't be written as numbers in a table (matrices, arrays, samplers), naming
/// `path` and type.
std::vector<GlslLeaf> leavesOf(const GlslDeclarations& declarations, const std::string& type,
                               const std::string& path);

}  // namespace lobe::harness
