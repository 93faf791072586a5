/// common/numeric.glsl and common/dirs.glsl, and the evaluator itself.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "base/error.hpp"
#include "harness/evaluator.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"
#include "math/ulp.hpp"
#include "on_contexts.hpp"

namespace lobe {
namespace {

using harness::Evaluator;
using harness::Snippet;

class GlslBasics : public test::OnContext {};

TEST_P(GlslBasics, TablesOfAnyLengthKeepTheirRows) {
    const Evaluator evaluator(library(),
                              {"sum",
                               {},
                               {{"float", "a"}, {"vec3", "b"}, {"int", "i"}, {"vec2", "c"}},
                               "    result[0] = vec4(a, b);\n    result[1] = vec4(float(i), c, a + b.x);",
                               2,
                               {}});
    for (int rows : {0, 1, 1023, 1024, 1025, 3000}) {
        std::vector<float> inputs;
        for (int i = 0; i < rows; ++i)
            for (int k = 0; k < 7; ++k)
                inputs.push_back(static_cast<float>(7 * i + k));
        const harness::ResultTable table = evaluator.evaluate(inputs);
        ASSERT_EQ(table.rows(), static_cast<size_t>(rows));
        for (int i = 0; i < rows; ++i) {
            const auto base = static_cast<float>(7 * i);
            const std::vector<float> expected{base,     base + 1, base + 2, base + 3,
                                              base + 4, base + 5, base + 6, 2 * base + 1};
            const auto row = table.row(static_cast<size_t>(i));
            ASSERT_EQ(std::vector<float>(row.begin(), row.end()), expected) << i;
        }
    }
}

TEST_P(GlslBasics, SpecialValuesPassThrough) {
    const Evaluator evaluator(library(), {"copy", {}, {{"float", "a"}}, "    result[0].x = a;", 1, {}});
    const std::vector<float> values{0.0f, -0.0f, 1e-44f, INFINITY, -INFINITY, 3.4e38f, std::nanf("")};
    const harness::ResultTable table = evaluator.evaluate(values);
    for (size_t i = 0; i + 1 < values.size(); ++i)
        EXPECT_EQ(std::bit_cast<uint32_t>(table.row(i)[0]), std::bit_cast<uint32_t>(values[i])) << values[i];
    EXPECT_TRUE(std::isnan(table.row(values.size() - 1)[0]));
}

TEST_P(GlslBasics, MistakesNameTheSnippet) {
    try {
        const Evaluator evaluator(library(), {"broken", {}, {}, "    result[0].x = undefined_name;", 1, {}});
        FAIL() << "compiled";
    } catch (const ShaderError& error) {
        EXPECT_NE(std::string(error.what()).find("generated/broken.frag"), std::string::npos) << error.what();
    }
}

TEST_P(GlslBasics, Log1p) {
    const Evaluator evaluator(
        library(),
        {"log1p", {"common/numeric.glsl"}, {{"float", "x"}}, "    result[0].x = numeric_log1p(x);\n", 1, {}});
    Pcg32 random(31);
    std::vector<float> inputs{0.0f, 0.3f, -0.3f, 1.0f, -0.999f};
    for (int i = 0; i < test::tableScale(100000); ++i) {
        const double sign = random.below(2) == 0 ? -1.0 : 1.0;
        inputs.push_back(static_cast<float>(sign * random.logUniform(1e-30, sign < 0 ? 0.999 : 1e30)));
    }
    const harness::ResultTable table = evaluator.evaluate(inputs);
    double worstSmall = 0.0, worstLarge = 0.0;
    for (size_t i = 0; i < inputs.size(); ++i) {
        const double exact = std::log1p(double(inputs[i]));
        const double error = exact == 0.0 ? std::abs(double(table.row(i)[0]))
                                          : std::abs(double(table.row(i)[0]) - exact) / std::abs(exact);
        double& worst = std::abs(inputs[i]) < 0.3f ? worstSmall : worstLarge;
        worst = std::max(worst, error);
    }
    // Small: about five roundings. Large: the rounding of 1 + x, 2^-24, against a logarithm above 0.26, and
    // about five roundings.
    EXPECT_LT(worstSmall, 5 * kFloatRounding);
    EXPECT_LT(worstLarge, (1.0 / 0.26 + 5) * kFloatRounding);
    std::printf("log1p: %.2e relative for |x| < 0.3, %.2e beyond\n", worstSmall, worstLarge);
}

TEST_P(GlslBasics, Exp) {
    const Evaluator evaluator(
        library(),
        {"exp", {"common/numeric.glsl"}, {{"float", "x"}}, "    result[0].x = numeric_exp(x);", 1, {}});
    Pcg32 random(34);
    std::vector<float> inputs{0.0f, -0.0f, 1.0f, -87.0f, 88.0f, -87.001f, -1e6f, -INFINITY};
    for (int i = 0; i < test::tableScale(100000); ++i) {
        inputs.push_back(static_cast<float>(random.uniform(-87.0, 88.0)));
        inputs.push_back(
            static_cast<float>((random.below(2) == 0 ? -1.0 : 1.0) * random.logUniform(1e-30, 80.0)));
    }
    const harness::ResultTable table = evaluator.evaluate(inputs);
    double worst = 0.0;
    for (size_t i = 0; i < inputs.size(); ++i) {
        const double value = double(table.row(i)[0]);
        if (inputs[i] < -87.0f) {
            EXPECT_EQ(value, 0.0) << inputs[i];
            continue;
        }
        const double exact = std::exp(double(inputs[i]));
        worst = std::max(worst, std::abs(value - exact) / exact);
    }
    // The argument's reduction, the last step of the series and its coefficients: four roundings at most.
    EXPECT_LT(worst, 4 * kFloatRounding);
    std::printf("exp: %.2e relative\n", worst);
}

TEST_P(GlslBasics, Log) {
    const Evaluator evaluator(
        library(),
        {"log", {"common/numeric.glsl"}, {{"float", "x"}}, "    result[0].x = numeric_log(x);", 1, {}});
    Pcg32 random(35);
    std::vector<float> inputs{1.0f, 0x1.fffffep-1f, 0x1.000002p0f, 0x1p-126f, 0x1.fffffep127f, 2.0f, 0.5f};
    for (int i = 0; i < test::tableScale(100000); ++i) {
        inputs.push_back(static_cast<float>(random.logUniform(1.2e-38, 3.4e38)));
        inputs.push_back(static_cast<float>(random.uniform(0.5, 2.0)));
        inputs.push_back(static_cast<float>(1.0 + random.logUniform(1e-7, 0.1)));
    }
    const harness::ResultTable table = evaluator.evaluate(inputs);
    double worst = 0.0;
    for (size_t i = 0; i < inputs.size(); ++i) {
        const double exact = std::log(double(inputs[i]));
        const double value = double(table.row(i)[0]);
        if (exact == 0.0)
            EXPECT_EQ(value, 0.0);
        else
            worst = std::max(worst, std::abs(value - exact) / std::abs(exact));
    }
    EXPECT_LT(worst, 5 * kFloatRounding);
    std::printf("log: %.2e relative\n", worst);
}

TEST_P(GlslBasics, Pow) {
    const Evaluator evaluator(library(), {"pow",
                                          {"common/numeric.glsl"},
                                          {{"float", "x"}, {"float", "y"}},
                                          "    result[0].x = numeric_pow(x, y);",
                                          1,
                                          {}});
    Pcg32 random(36);
    std::vector<float> inputs;
    for (int i = 0; i < test::tableScale(100000); ++i) {
        const auto x = static_cast<float>(random.logUniform(1e-6, 1e6));
        inputs.push_back(x);
        inputs.push_back(
            static_cast<float>(random.uniform(-80.0, 80.0) / std::max(std::abs(std::log(double(x))), 1e-3)));
    }
    const harness::ResultTable table = evaluator.evaluate(inputs);
    for (size_t i = 0; i < table.rows(); ++i) {
        const double exponent = double(inputs[2 * i + 1]) * std::log(double(inputs[2 * i]));
        const double exact = std::exp(exponent);
        // The exponent carries the logarithm's five roundings and its own; exp adds four.
        EXPECT_NEAR(double(table.row(i)[0]), exact, (4 + 6 * std::abs(exponent)) * kFloatRounding * exact)
            << inputs[2 * i] << " ^ " << inputs[2 * i + 1];
    }
}

std::vector<glm::vec3> testNormals(int count) {
    Pcg32 random(32);
    std::vector<glm::vec3> normals{{0, 0, 1},      {0, 0, -1},      {1, 0, 0},          {0, -1, 0},
                                   {1e-4f, 0, -1}, {0.6f, 0.8f, 0}, {0.6f, 0.8f, -0.0f}};
    for (int i = 0; i < count; ++i)
        normals.emplace_back(uniformSphere({random.uniform(), random.uniform()}));
    return normals;
}

void expectOrthonormal(std::span<const float> row, double handedness) {
    const glm::dvec3 t(row[0], row[1], row[2]), b(row[4], row[5], row[6]), n(row[8], row[9], row[10]);
    // A few roundings of unit vectors; Duff et al. report 6e-7 at worst.
    const double tolerance = 12 * kFloatRounding;
    EXPECT_NEAR(glm::length(t), 1.0, tolerance);
    EXPECT_NEAR(glm::length(b), 1.0, tolerance);
    EXPECT_NEAR(glm::dot(t, n), 0.0, tolerance);
    EXPECT_NEAR(glm::dot(b, n), 0.0, tolerance);
    EXPECT_NEAR(glm::dot(t, b), 0.0, tolerance);
    EXPECT_NEAR(glm::dot(glm::cross(t, b), n), handedness, tolerance);
}

TEST_P(GlslBasics, FrameFromNormal) {
    const Evaluator evaluator(library(), {"frame",
                                          {"common/dirs.glsl"},
                                          {{"vec3", "n"}},
                                          "    Frame f = frame_from_normal(n);\n    result[0].xyz = f.t;\n"
                                          "    result[1].xyz = f.b;\n    result[2].xyz = f.n;",
                                          3,
                                          {}});
    std::vector<float> inputs;
    for (const glm::vec3& n : testNormals(test::tableScale(20000)))
        inputs.insert(inputs.end(), {n.x, n.y, n.z});
    const harness::ResultTable table = evaluator.evaluate(inputs);
    for (size_t i = 0; i < table.rows(); ++i)
        expectOrthonormal(table.row(i), 1.0);
}

TEST_P(GlslBasics, FrameFromNormalAndTangent) {
    const Evaluator evaluator(
        library(), {"tangent_frame",
                    {"common/dirs.glsl"},
                    {{"vec3", "n"}, {"vec4", "tangent"}},
                    "    Frame f = frame_from_normal_tangent(n, tangent);\n    result[0].xyz = f.t;\n"
                    "    result[1].xyz = f.b;\n    result[2].xyz = f.n;",
                    3,
                    {}});
    std::vector<float> inputs;
    std::vector<glm::dvec3> tangents;
    std::vector<double> handedness;
    Pcg32 random(33);
    const std::vector<glm::vec3> normals = testNormals(test::tableScale(20000));
    for (size_t i = 0; i < normals.size(); ++i) {
        // At least 0.05 rad from the normal, of any length, and every tenth degenerate.
        const glm::dmat3 frame = frameAbout(glm::normalize(glm::dvec3(normals[i])));
        glm::dvec3 tangent = frame * fromPolar(random.uniform(0.05, 3.09), random.uniform(0.0, 6.28)) *
                             random.logUniform(1e-12, 1e12);
        if (i % 10 == 0) tangent = i % 20 == 0 ? glm::dvec3(0.0) : glm::dvec3(normals[i]);
        const double w = random.below(2) == 0 ? -1.0 : 1.0;
        const glm::vec3 rounded(tangent);
        inputs.insert(inputs.end(), {normals[i].x, normals[i].y, normals[i].z, rounded.x, rounded.y,
                                     rounded.z, static_cast<float>(w)});
        tangents.push_back(tangent);
        handedness.push_back(i % 10 == 0 ? 1.0 : w);
    }
    const harness::ResultTable table = evaluator.evaluate(inputs);
    for (size_t i = 0; i < table.rows(); ++i) {
        const auto row = table.row(i);
        const glm::dvec3 t(row[0], row[1], row[2]), n(normals[i]);
        if (i % 10 == 0) {
            expectOrthonormal(row, 1.0);
            continue;
        }
        // Rounding of the projection is relative to the tangent, not to its part along the surface: 1 /
        // sin(0.05) = 20.
        EXPECT_NEAR(glm::dot(t, n), 0.0, 100 * kFloatRounding);
        EXPECT_NEAR(glm::length(t), 1.0, 12 * kFloatRounding);
        const glm::dvec3 expected = glm::normalize(tangents[i] - n * glm::dot(n, tangents[i]));
        EXPECT_NEAR(glm::length(t - expected), 0.0, 200 * kFloatRounding);
        const glm::dvec3 b(row[4], row[5], row[6]);
        EXPECT_NEAR(glm::dot(glm::cross(t, b), n), handedness[i], 100 * kFloatRounding);
    }
}

LOBE_ON_EVERY_BACKEND(GlslBasics);

}  // namespace
}  // namespace lobe
