#include "harness/function_binding.hpp"

#include <algorithm>
#include <optional>

#include "base/closest_name.hpp"
#include "base/error.hpp"

namespace lobe::harness {
namespace {

using Input = FunctionBinding::Input;
using Output = FunctionBinding::Output;

constexpr size_t kMostFloats = 32;  ///< that the evaluator returns for a row

/// Before the names of their parameters.
constexpr const char* kArgument = "lobe_arg_";

std::string underscored(std::string name) {
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
}

/// The names that a column for this number may have, with underscores for dots.
std::vector<std::string> spellings(const GlslLeaf& leaf) {
    std::vector<std::string> names{underscored(leaf.path)};
    const size_t dot = leaf.path.rfind('.');
    const std::string component = dot == std::string::npos ? "" : leaf.path.substr(dot + 1);
    const size_t index = std::string("xyzw").find(component);
    if (component.size() == 1 && index != std::string::npos)
        names.push_back(underscored(leaf.path.substr(0, dot)) + "_" + "rgba"[index]);
    return names;
}

/// Which column each of the function's numbers is read from. Throws InputError.
std::vector<Input> bind(const GlslDeclarations& declarations, const GlslFunction& function,
                        const TableHeader& header) {
    std::vector<Input> inputs;
    std::vector<bool> used(header.columns.size(), false);
    std::vector<std::string> known{"id"};
    for (const GlslVariable& parameter : function.parameters) {
        if (parameter.name.empty())
            throw InputError(function.file + ":" + std::to_string(function.line) + ": " + describe(function) +
                             ": a parameter has no name, so no column can be its");
        const auto leaves = leavesOf(declarations, parameter.type, parameter.name);
        for (size_t l = 0; parameter.in && l < leaves.size(); ++l) {
            std::vector<size_t> found;
            for (const std::string& name : spellings(leaves[l]))
                for (size_t i = 0; i < header.columns.size(); ++i)
                    if (underscored(header.columns[i]) == name) found.push_back(i);
            known.push_back(leaves[l].path);
            if (found.empty())
                throw InputError(header.name + ":1: no column " + leaves[l].path + " for " +
                                 describe(function) + didYouMean(leaves[l].path, header.columns));
            if (found.size() > 1)
                throw InputError(header.name + ":1: columns " + header.columns[found[0]] + " and " +
                                 header.columns[found[1]] + " both name " + leaves[l].path);
            used[found[0]] = true;
            inputs.push_back({leaves[l], found[0]});
        }
    }
    for (size_t i = 0; i < used.size(); ++i)
        if (!used[i] && header.columns[i] != "id")
            throw InputError(header.name + ":1: column '" + header.columns[i] + "' is no parameter of " +
                             describe(function) + didYouMean(header.columns[i], known));
    return inputs;
}

/// Of functions of one name, the one that fits the columns.
std::pair<GlslFunction, std::vector<Input>> choose(const GlslDeclarations& declarations,
                                                   const std::string& name, const std::string& file,
                                                   const TableHeader& header) {
    std::vector<std::string> names, signatures;
    std::optional<std::pair<GlslFunction, std::vector<Input>>> chosen;
    std::string why;
    for (const GlslFunction& function : declarations.functions) {
        names.push_back(function.name);
        if (function.name != name) continue;
        signatures.push_back(describe(function));
        try {
            chosen = {function, bind(declarations, function, header)};
        } catch (const InputError& error) {
            why = error.what();
        }
    }
    if (signatures.empty()) throw UsageError(file + ": no function '" + name + "'" + didYouMean(name, names));
    if (chosen) return *chosen;
    if (signatures.size() == 1) throw InputError(why);
    std::string all;
    for (const std::string& signature : signatures)
        all += (all.empty() ? "" : "; ") + signature;
    throw InputError(header.name + ":1: the columns fit none of " + all);
}

/// The function's numbers that come back: its result, then its `out` parameters.
std::vector<Output> outputsOf(const GlslDeclarations& declarations, const GlslFunction& function) {
    std::vector<Output> outputs;
    const auto append = [&](const std::string& type, const std::string& path, const std::string& prefix) {
        for (const GlslLeaf& leaf : leavesOf(declarations, type, path))
            outputs.push_back({leaf, prefix + leaf.path});
    };
    if (function.result != "void") append(function.result, "result", "lobe_");
    for (const GlslVariable& parameter : function.parameters)
        if (parameter.out) append(parameter.type, parameter.name, kArgument);
    if (outputs.empty()) throw InputError(describe(function) + " returns nothing");
    return outputs;
}

std::string inputName(size_t i) {
    return "lobe_in" + std::to_string(i);
}

/// GLSL that puts the number together from the floats that came.
std::string fromFloats(GlslScalar scalar, size_t first) {
    std::string a = inputName(first);
    const std::string b = inputName(first + 1);
    switch (scalar) {
        case GlslScalar::integer:
            return "(int(" + a + ") << 16) | int(" + b + ")";
        case GlslScalar::unsignedInteger:
            return "(uint(" + a + ") << 16u) | uint(" + b + ")";
        case GlslScalar::boolean:
            return a + " != 0.0";
        case GlslScalar::floating:
            break;
    }
    return a;
}

std::vector<std::string> toFloats(GlslScalar scalar, const std::string& value) {
    switch (scalar) {
        case GlslScalar::integer:
            return {"float(" + value + " >> 16)", "float(" + value + " & 0xffff)"};
        case GlslScalar::unsignedInteger:
            return {"float(" + value + " >> 16u)", "float(" + value + " & 0xffffu)"};
        case GlslScalar::boolean:
            return {value + " ? 1.0 : 0.0"};
        case GlslScalar::floating:
            break;
    }
    return {value};
}

/// A function of ours between the evaluator's main() and theirs, so that no name of ours hides one of theirs.
Snippet snippetFor(const std::string& file, const GlslFunction& function, const std::vector<Input>& inputs,
                   const std::vector<Output>& outputs) {
    Snippet snippet;
    snippet.name = "eval_" + function.name;
    size_t floats = 0;
    std::string parameters, arguments, locals, call, assignments, collected;
    for (const Input& input : inputs) {
        assignments += std::string("    ") + kArgument + input.leaf.path + " = " +
                       fromFloats(input.leaf.scalar, floats) + ";\n";
        for (int i = 0; i < floatsOf(input.leaf.scalar); ++i, ++floats) {
            snippet.inputs.push_back({"float", inputName(floats)});
            parameters += "float " + inputName(floats) + ", ";
            arguments += inputName(floats) + ", ";
        }
    }
    if (snippet.inputs.empty()) snippet.inputs.push_back({"float", "lobe_unused"});
    for (const GlslVariable& parameter : function.parameters) {
        locals += "    " + parameter.type + " " + kArgument + parameter.name + ";\n";
        call += (call.empty() ? "" : ", ") + (kArgument + parameter.name);
    }
    call = function.name + "(" + call + ");\n";
    if (function.result != "void") call = function.result + " lobe_result = " + call;
    size_t results = 0;
    for (const Output& output : outputs)
        for (const std::string& value : toFloats(output.leaf.scalar, output.variable))
            collected += "    lobe_out[" + std::to_string(results++) + "] = " + value + ";\n";
    if (results > kMostFloats)
        throw InputError(describe(function) + " returns " + std::to_string(results) +
                         " numbers; expected at most " + std::to_string(kMostFloats) +
                         " (whole numbers count twice)");
    const std::string count = std::to_string(results);
    snippet.functions = "#define main lobe_main_of_file\n#include \"" + file +
                        "\"\n#undef main\n"
                        "void lobe_evaluate(" +
                        parameters + "out float lobe_out[" + count + "])\n{\n" + locals + assignments +
                        "    " + call + collected + "}\n";
    snippet.results = static_cast<int>((results + 3) / 4);
    snippet.body = "    float lobe_out[" + count + "];\n    lobe_evaluate(" + arguments + "lobe_out);\n";
    for (size_t i = 0; i < results; ++i)
        snippet.body += "    result[" + std::to_string(i / 4) + "][" + std::to_string(i % 4) +
                        "] = lobe_out[" + std::to_string(i) + "];\n";
    return snippet;
}

}  // namespace

int floatsOf(GlslScalar scalar) {
    return scalar == GlslScalar::integer || scalar == GlslScalar::unsignedInteger ? 2 : 1;
}

FunctionBinding::FunctionBinding(const gl::ShaderLibrary& library, const std::string& path,
                                 const std::string& file, const std::string& name,
                                 const TableHeader& header) {
    const GlslDeclarations declarations = declarationsOf(library.source(path, {}));
    auto [function, bound] = choose(declarations, name, file, header);
    inputs = std::move(bound);
    outputs = outputsOf(declarations, function);
    snippet = snippetFor(path, function, inputs, outputs);
}

}  // namespace lobe::harness
