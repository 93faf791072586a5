// Any GLSL function over a table: signatures as they are written, values to the last bit, errors with their
// place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "harness/signature.hpp"
#include "harness/table_evaluation.hpp"
#include "math/random.hpp"
#include "shading/on_contexts.hpp"

namespace lobe::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

gl::ShaderSource sourceOf(const std::string& text) {
    gl::ShaderSource source;
    source.text = text;
    const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
    for (int i = 0; i < lines; ++i)
        source.places.push_back({"f.glsl", i + 1});
    return source;
}

TEST(Signature, FindsFunctionsAmongCommentsMacrosAndBodies) {
    const auto found = declarationsOf(
        sourceOf("// float commented(float x) {}\n"
                 "/* float also(float x) {} */ #define LONG float\n"
                 "#define REAL float\n"
                 "#define TWICE(x) (2.0 * (x))\n"
                 "layout(std140) uniform Block { vec4 member; };\n"
                 "uniform float uScale; const vec3 kWhite = vec3(1.0);\n"
                 "highp REAL one(const in mediump float x, inout vec2 y,\n"
                 "   out int[2] z);\n"
                 "REAL one(float x, vec2 y, int z[2]) { if (x > 0.0) return x; return float(x); }\n"
                 "void none(void) { float inner; for (int i = 0; i < 2; ++i) { none(); } }\n"));
    ASSERT_EQ(found.functions.size(), 2u);
    EXPECT_EQ(describe(found.functions[0]), "float one(float x, inout vec2 y, out int[] z)");
    EXPECT_EQ(found.functions[0].line, 7);
    EXPECT_EQ(describe(found.functions[1]), "void none()");
}

TEST(Signature, FlattensStructs) {
    const auto found =
        declarationsOf(sourceOf("struct In { vec2 a, b; bool c; };\nstruct P { In i; uint n; float t[3], u; "
                                "};\nstruct Q { float x, y; ivec3 z; };"));
    std::vector<std::string> paths;
    for (const GlslLeaf& leaf : leavesOf(found, "In", "p.i"))
        paths.push_back(leaf.path);
    EXPECT_THAT(paths, ElementsAre("p.i.a.x", "p.i.a.y", "p.i.b.x", "p.i.b.y", "p.i.c"));
    EXPECT_EQ(leavesOf(found, "Q", "q").size(), 5u);
    EXPECT_EQ(leavesOf(found, "Q", "q")[4].scalar, GlslScalar::integer);
    EXPECT_THROW(leavesOf(found, "P", "p"), InputError);  // an array
    for (const char* type : {"mat3", "sampler2D", "Unknown", "float[]"})
        EXPECT_THROW(leavesOf(found, type, "x"), InputError) << type;
    EXPECT_THROW(leavesOf(declarationsOf(sourceOf("struct A { A a; };")), "A", "a"), InputError);
}

class FunctionTable : public test::OnContext {
protected:
    void SetUp() override {
        OnContext::SetUp();
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() /
                  ("lobe_" + std::to_string(getpid()) + "_" +
                   std::to_string(testing::UnitTest::GetInstance()->random_seed()) +
                   std::string(info->name()).substr(0, 8));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }

    std::vector<std::string> run(const std::filesystem::path& file, const std::string& function,
                                 const std::string& csv) const {
        std::istringstream stream(csv);
        CsvReader reader(stream, "t.csv");
        const auto evaluation = functionEvaluation(file, function, {reader.name(), reader.columns()});
        std::string names;
        for (const std::string& column : evaluation->resultColumns())
            names += (names.empty() ? "" : ",") + column;
        for (CsvRow row; reader.next(row);)
            evaluation->add(row);
        std::vector<std::string> lines = evaluation->finish();
        lines.insert(lines.begin(), names);
        return lines;
    }

    template<typename E>
    std::string failure(const std::filesystem::path& file, const std::string& function,
                        const std::string& csv) const {
        try {
            run(file, function, csv);
        } catch (const E& error) {
            return error.what();
        }
        return "(no such error)";
    }

private:
    std::filesystem::path folder_;
};

TEST_P(FunctionTable, FloatsAndWholeNumbersPassToTheLastBit) {
    const auto file = write("f.glsl",
                            "#version 330 core\n"
                            "uint bits(float x) { return floatBitsToUint(x); }\n"
                            "int minus(int a, bool b) { return b ? -a : a; }\n"
                            "float same(float pixel) { return pixel; }\n"
                            "uvec2 swapped(uvec2 result) { return result.yx; }\n"
                            "void main() {}\n");
    EXPECT_THAT(run(file, "bits", "x\n1\n-0\ninf\n-0x1.8p3\n"),
                ElementsAre("result", "1065353216", "2147483648", "2139095040", "3242196992"));
    EXPECT_THAT(run(file, "minus", "b,a\ntrue,2147483647\n0,-2147483648\n1,-1\nfalse,65536\n"),
                ElementsAre("result", "-2147483647", "-2147483648", "1", "65536"));
    EXPECT_THAT(run(file, "swapped", "result_x,result_y\n4294967295,65535\n"),
                ElementsAre("result.x,result.y", "65535,4294967295"));
    Pcg32 random(3);
    std::string csv = "pixel\n";
    std::vector<float> floats;
    for (int i = 0; i < 5000; ++i) {
        floats.push_back(static_cast<float>(random.logUniform(1e-37, 3e38)));
        csv += numberText(double{floats.back()}) + "\n";
    }
    const auto lines = run(file, "same", csv + "nan\n-inf\n");
    for (size_t i = 0; i < floats.size(); ++i)
        ASSERT_EQ(static_cast<float>(parseNumber(lines[i + 1]).value()), floats[i]);
    EXPECT_EQ(lines[5001], "nan");
    EXPECT_EQ(lines[5002], "-inf");
}

TEST_P(FunctionTable, TakesStructsOutParametersOverloadsAndIncludes) {
    write("part.glsl", "struct Material { vec3 albedo; float rough; };\n");
    const auto file = write("f.glsl",
                            "#include \"part.glsl\"\n#include \"common/constants.glsl\"\n"
                            "vec3 shade(Material m, inout float n, out bool big) { n *= 2.0; big = n > 3.0; "
                            "return m.albedo * m.rough; }\n"
                            "float over(float a) { return a * PI; }\nvec2 over(vec2 a) { return a.yx; }\n");
    EXPECT_THAT(run(file, "shade", "id,m.albedo.r,m.albedo_g,m_albedo_b,m.rough,n\n1,1,2,3,0.5,2\n"),
                ElementsAre("result.x,result.y,result.z,n,big", "0.5,1,1.5,4,1"));
    EXPECT_THAT(run(file, "over", "a\n1\n"), ElementsAre("result", "3.14159274"));
    EXPECT_THAT(run(file, "over", "a.x,a.y\n1,2\n"), ElementsAre("result.x,result.y", "2,1"));
    EXPECT_THAT(failure<InputError>(file, "over", "b\n1\n"),
                HasSubstr("the columns fit none of float over(float a); vec2"));
}

TEST_P(FunctionTable, MistakesAreNamedWithTheirPlace) {
    const auto file = write(
        "f.glsl",
        "float square(float x) { return x * x; }\nmat2 m(float x) { return mat2(x); }\nfloat i(int x) "
        "{ return float(x); }\nvoid v(float x) {}\nfloat b(bool x) { return 1.0; }\nfloat unnamed(float);\n");
    EXPECT_THAT(failure<UsageError>(file, "sqare", "x\n1\n"),
                HasSubstr("no function 'sqare'; did you mean 'square'?"));
    EXPECT_THAT(failure<InputError>(file, "square", "y\n1\n"),
                HasSubstr("t.csv:1: no column x for float square(float x)"));
    EXPECT_THAT(failure<InputError>(file, "square", "x,xx\n1,1\n"),
                HasSubstr("t.csv:1: column 'xx' is no parameter"));
    EXPECT_THAT(failure<InputError>(file, "square", "x\n1\n1e39\n"),
                HasSubstr("t.csv:3: x: 1e39; expected a float"));
    EXPECT_THAT(failure<InputError>(file, "square", "x\none\n"),
                HasSubstr("t.csv:2: x: 'one'; expected a number"));
    EXPECT_THAT(failure<InputError>(file, "i", "x\n1.5\n"),
                HasSubstr("t.csv:2: x: '1.5'; expected a whole number"));
    EXPECT_THAT(failure<InputError>(file, "i", "x\n2147483648\n"),
                HasSubstr("expected a whole number, -2147483648..2147483647"));
    EXPECT_THAT(failure<InputError>(file, "b", "x\nyes\n"), HasSubstr("expected true, false, 1 or 0"));
    EXPECT_THAT(failure<InputError>(file, "m", "x\n1\n"), HasSubstr("result is a mat2"));
    EXPECT_THAT(failure<InputError>(file, "v", "x\n1\n"), HasSubstr("void v(float x) returns nothing"));
    EXPECT_THAT(failure<InputError>(file, "unnamed", "x\n1\n"), HasSubstr("a parameter has no name"));
    EXPECT_THAT(failure<InputError>("/nowhere/f.glsl", "f", "x\n1\n"),
                HasSubstr("/nowhere/f.glsl: can't be read"));
    const auto broken = write("broken.glsl", "float f(float x)\n{\n    return y;\n}\n");
    EXPECT_THAT(failure<ShaderError>(broken, "f", "x\n1\n"), HasSubstr("broken.glsl:3"));
    const auto missing =
        write("missing.glsl", "\n#include \"absent.glsl\"\nfloat f(float x) { return x; }\n");
    EXPECT_THAT(failure<ShaderError>(missing, "f", "x\n1\n"), HasSubstr("missing.glsl:2"));
}

LOBE_ON_EVERY_BACKEND(FunctionTable);

}  // namespace
}  // namespace lobe::harness
