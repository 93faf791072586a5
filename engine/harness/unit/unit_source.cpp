#include "harness/unit/unit_program.hpp"

namespace lobe::harness {
namespace {

std::string numbered(const std::string& name, int i) {
    return name + std::to_string(i);
}

/// The inputs as local variables named lobe_in_NAME.
std::string inputDeclarations(const TestCase& test) {
    const int texels = (test.width() + 3) / 4;
    std::string text;
    for (int i = 0; i < texels; ++i)
        text += "    uvec4 " + numbered("lobe_word", i) +
                " = texelFetch(lobe_inputs, ivec2(lobe_row.x, lobe_row.y * " + std::to_string(texels) +
                " + " + std::to_string(i) + "), 0);\n";
    for (const TestInput& input : test.inputs) {
        std::vector<std::string> words;
        for (int c = input.offset; c < input.offset + input.type.components; ++c)
            words.push_back(numbered("lobe_word", c / 4) + "." + std::string(1, "xyzw"[c % 4]));
        text += "    " + input.type.name() + " lobe_in_" + input.name + " = " +
                glslFromWords(input.type, words) + ";\n";
    }
    return text;
}

std::string callArguments(const TestCase& test) {
    std::string list;
    for (const TestInput& input : test.inputs)
        if (test.model == nullptr || (input.name != "wi" && input.name != "wo"))
            list += (list.empty() ? "lobe_in_" : ", lobe_in_") + input.name;
    return test.model == nullptr ? list
                                 : "Dirs(lobe_in_wi, lobe_in_wo, lobe_in_wi + lobe_in_wo), " +
                                       glslParameterType(*test.model) + "(" + list + ")";
}

}  // namespace

int unitOutputs(const TestCase& test) {
    int outputs = 3;
    for (const Expectation& expectation : test.expectations)
        outputs += expectation.kind == Expectation::Kind::equalsFunction ? 1 : 0;
    return outputs;
}

std::string unitSource(const TestFile& file, const TestCase& test) {
    const bool vertex = test.stage == Stage::vertex;
    std::string text = "#include \"test/check.glsl\"\n#include \"" +
                       std::filesystem::absolute(file.path).lexically_normal().generic_string() +
                       "\"\nuniform usampler2D lobe_inputs;\n";
    for (int i = 0; i < unitOutputs(test); ++i)
        text += (vertex ? "flat out uvec4 " : "layout(location = " + std::to_string(i) + ") out uvec4 ") +
                numbered("lobe_output", i) + ";\n";
    text += "void main()\n{\n    ivec2 lobe_row = ";
    text += vertex ? "ivec2(gl_VertexID % 1024, gl_VertexID / 1024);\n" : "ivec2(gl_FragCoord.xy);\n";
    text += inputDeclarations(test);
    const std::string call = "(" + callArguments(test) + ")";
    if (test.result)
        text += "    " + test.result->name() + " lobe_result = " + test.function + call +
                ";\n    lobe_output0 = " + glslToWords(*test.result, "lobe_result") + ";\n";
    else
        text += "    " + test.function + call + ";\n    lobe_output0 = uvec4(0u);\n";
    // What the references check is their own affair: the words are taken before.
    text +=
        "    lobe_output1 = uvec4(uint(lobe_check_line), uint(lobe_check_kind), uint(lobe_check_base), "
        "lobe_check_skipped ? 1u : 0u);\n    lobe_output2 = uvec4(lobe_check_values, 0u);\n";
    int output = 3;
    for (const Expectation& expectation : test.expectations)
        if (expectation.kind == Expectation::Kind::equalsFunction)
            text += "    " + numbered("lobe_output", output++) + " = " +
                    glslToWords(*test.result, expectation.function + call) + ";\n";
    if (vertex) text += "    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);\n";
    return text + "}\n";
}

}  // namespace lobe::harness
