// Programs: messages that name the library's own file and line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "drawing.hpp"

namespace lobe::gl {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kVertex = "void main() { gl_Position = vec4(0.0); }\n";

class ProgramTest : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override { context_ = Context::create({.backend = GetParam()}); }

    static std::string refusal(const ShaderSource& vertex, const ShaderSource& fragment) {
        try {
            const Program program(vertex, fragment, "broken");
        } catch (const ShaderError& error) {
            EXPECT_EQ(error.exitCode(), ExitCode::shader);
            return error.what();
        }
        ADD_FAILURE() << "the program was taken";
        return {};
    }

    std::unique_ptr<Context> context_;
};

TEST_P(ProgramTest, NamesFileAndLineOfAFaultInAnInclude) {
    const ShaderSource fragment =
        ShaderLibrary("/nowhere")
            .source(
                "pass/main.frag", {{"A", "1"}, {"B", "2"}},
                {{"pass/main.frag", "#include \"brdf/bad.glsl\"\nout vec4 c;\nvoid main() { c = bad(); }\n"},
                 {"brdf/bad.glsl", "// first\nvec4 bad() {\n    return vec4(missing);\n}\n"}});
    const std::string message = refusal(test::glsl("plain.vert", kVertex), fragment);
    EXPECT_THAT(message, HasSubstr("fragment shader of broken"));
    EXPECT_THAT(message, HasSubstr("\nbrdf/bad.glsl:3:"));
    EXPECT_THAT(message, HasSubstr("missing"));
    EXPECT_THAT(message, HasSubstr("> 3 |     return vec4(missing);"));
    EXPECT_THAT(message, HasSubstr("2 | vec4 bad() {"));
    EXPECT_THAT(message, HasSubstr("4 | }"));
}

TEST_P(ProgramTest, NamesTheIncludersLineAfterAnInclude) {
    const ShaderSource fragment =
        ShaderLibrary("/nowhere")
            .source(
                "pass/main.frag", {},
                {{"pass/main.frag", "#include \"good.glsl\"\n\nout vec4 c;\nvoid main() { c = wrong; }\n"},
                 {"good.glsl", "float a;\nfloat b;\nfloat d;\n"}});
    EXPECT_THAT(refusal(test::glsl("plain.vert", kVertex), fragment), HasSubstr("\npass/main.frag:4:"));
}

TEST_P(ProgramTest, NamesTheVertexShader) {
    EXPECT_THAT(refusal(test::glsl("bad.vert", "void main() { gl_Position = 1; }\n"),
                        test::glsl("plain.frag", "void main() {}\n")),
                testing::AllOf(HasSubstr("vertex shader of broken"), HasSubstr("\nbad.vert:1:")));
}

TEST_P(ProgramTest, SaysWhyAProgramDoesNotLink) {
    const std::string message = refusal(
        test::glsl("four.vert", "out vec4 lonely;\nvoid main() { gl_Position = lonely = vec4(0.0); }\n"),
        test::glsl("three.frag", "in vec3 lonely;\nout vec3 c;\nvoid main() { c = lonely; }\n"));
    EXPECT_THAT(message, HasSubstr("broken does not link"));
    EXPECT_THAT(message, HasSubstr("lonely"));
}

TEST_P(ProgramTest, AMovedProgramKeepsItsUniforms) {
    Program first(test::glsl("plain.vert", kVertex),
                  test::glsl("u.frag", "uniform float u;\nout vec4 c;\nvoid main() { c = vec4(u); }\n"),
                  "first");
    EXPECT_GE(first.uniform("u"), 0);
    EXPECT_EQ(first.uniform("absent"), -1);
    Program second(std::move(first));
    EXPECT_GE(second.uniform("u"), 0);
    EXPECT_NE(second.id(), 0u);
    second.use();
    second.set("u", 0.5f);
    EXPECT_NO_THROW(checkErrors("AMovedProgramKeepsItsUniforms"));
}

INSTANTIATE_TEST_SUITE_P(, ProgramTest, testing::Values(Backend::egl, Backend::osmesa), test::backendOf);

}  // namespace
}  // namespace lobe::gl
