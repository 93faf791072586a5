/// Each model's GLSL against its double-precision twin (harness/comparison.hpp has the tolerance).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "harness/comparison.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"
#include "math/ulp.hpp"
#include "on_contexts.hpp"

namespace lobe {
namespace {

using harness::Axes;
using harness::BrdfRow;
using harness::Comparison;
using harness::describe;

class BrdfTwin : public test::OnContext {};

TEST_P(BrdfTwin, AgreesWithDirectionsInTheLocalFrame) {
    for (const Brdf& brdf : allBrdfs()) {
        const std::vector<BrdfRow> rows = harness::brdfRows(brdf, test::tableScale(4000), 1);
        const auto results = harness::BrdfEvaluator(library(), brdf).evaluate(rows);
        Comparison comparison(brdf, Axes::local);
        bool agrees = true;
        for (size_t i = 0; i < rows.size() && agrees; ++i)
            agrees = comparison.check(rows[i], harness::directionsOf(rows[i]), results[i].fCos);
        EXPECT_TRUE(agrees) << comparison.message();
        EXPECT_LT(comparison.illConditionedShare(), 0.1) << brdf.name;
        std::printf("%s, local frame: %s\n", brdf.name.c_str(), comparison.report().c_str());
    }
}

/// Directions and normals in world axes, through common/dirs.glsl. The normal is a float vector like the
/// others, so its rounding turns both directions.
TEST_P(BrdfTwin, AgreesWithDirectionsInWorldAxes) {
    for (const Brdf& brdf : allBrdfs()) {
        std::vector<BrdfRow> rows = harness::brdfRows(brdf, test::tableScale(2000), 2);
        std::vector<glm::vec3> normals;
        Pcg32 random(3);
        for (BrdfRow& row : rows) {
            const glm::dvec3 n = uniformSphere({random.uniform(), random.uniform()});
            normals.emplace_back(n);
            row.wi = glm::vec3(frameAbout(n) * glm::dvec3(row.wi));
            row.wo = glm::vec3(frameAbout(n) * glm::dvec3(row.wo));
        }
        const auto results = harness::WorldBrdfEvaluator(library(), brdf).evaluate(rows, normals);
        Comparison comparison(brdf, Axes::world);
        bool agrees = true;
        for (size_t i = 0; i < rows.size() && agrees; ++i) {
            const glm::dmat3 toLocal = glm::transpose(frameAbout(glm::normalize(glm::dvec3(normals[i]))));
            const Directions d(toLocal * glm::normalize(glm::dvec3(rows[i].wi)),
                               toLocal * glm::normalize(glm::dvec3(rows[i].wo)));
            // Within rounding of the horizon either side of it is right.
            if (std::abs(d.wi.z) < 8 * kFloatRounding || std::abs(d.wo.z) < 8 * kFloatRounding) continue;
            agrees = comparison.check(rows[i], d, results[i]);
        }
        EXPECT_TRUE(agrees) << comparison.message();
        EXPECT_LT(comparison.illConditionedShare(), 0.2) << brdf.name;
        std::printf("%s, world axes: %s\n", brdf.name.c_str(), comparison.report().c_str());
    }
}

/// The same lobes as textbooks arrange them, in floats.
constexpr const char* kTextbookFunctions = R"(
float ggx(float nh, float a, float nl, float nv)
{
    float k = nh * nh * (a * a - 1.0) + 1.0;
    float v = nl * sqrt(a * a + (1.0 - a * a) * nv * nv) + nv * sqrt(a * a + (1.0 - a * a) * nl * nl);
    return a * a / (3.14159265 * k * k) * 0.5 / v * nl;
}
)";

struct Textbook {
    const char* brdf;
    const char* lobe;                ///< of wi, wo and the width x
    std::vector<float> beforeWidth;  ///< values that leave the bare lobe
    std::vector<float> afterWidth;
};

const std::vector<Textbook>& textbooks() {
    static const std::vector<Textbook> list{
        {"phong", "pow(max(dot(vec3(-wi.xy, wi.z), wo), 0.0), x)", {0, 0, 0, 0, 0, 0, 1, 1, 1}, {0}},
        {"blinn_phong", "pow(normalize(wi + wo).z, x)", {0, 0, 0, 0, 0, 0, 1, 1, 1}, {0}},
        {"metallic_roughness", "ggx(normalize(wi + wo).z, max(x * x, 1e-4), wi.z, wo.z)", {1, 1, 1, 1}, {}}};
    return list;
}

/// The tolerance tells arrangements apart: textbook forms fail it on the same rows.
TEST_P(BrdfTwin, TextbookArrangementsFail) {
    for (const Textbook& textbook : textbooks()) {
        const Brdf& brdf = requireBrdf(textbook.brdf);
        std::vector<BrdfRow> rows = harness::brdfRows(brdf, test::tableScale(1000), 6);
        std::vector<float> inputs;
        for (BrdfRow& row : rows) {
            const float width =
                std::max(row.values[textbook.beforeWidth.size()], 1e-6f);  // pow(0, 0) is undefined
            for (const glm::vec3& w : {row.wi, row.wo})
                inputs.insert(inputs.end(), {w.x, w.y, w.z});
            inputs.push_back(width);
            row.values = textbook.beforeWidth;
            row.values.push_back(width);
            row.values.insert(row.values.end(), textbook.afterWidth.begin(), textbook.afterWidth.end());
        }
        harness::Snippet snippet{
            std::string("textbook_") + textbook.brdf,
            {},
            {{"vec3", "wi"}, {"vec3", "wo"}, {"float", "x"}},
            std::string("    result[0].xyz = vec3(wi.z > 0.0 && wo.z > 0.0 ? ") + textbook.lobe + " : 0.0);",
            1,
            kTextbookFunctions};
        const harness::ResultTable table = harness::Evaluator(library(), snippet).evaluate(inputs);
        Comparison comparison(brdf, Axes::local);
        size_t failures = 0;
        for (size_t i = 0; i < rows.size(); ++i) {
            const auto r = table.row(i);
            if (!comparison.check(rows[i], harness::directionsOf(rows[i]), {r[0], r[1], r[2]})) ++failures;
        }
        EXPECT_GT(failures, rows.size() / 50) << textbook.brdf;
        std::printf("%s as in textbooks: %zu of %zu rows fail\n", textbook.brdf, failures, rows.size());
    }
}

TEST_P(BrdfTwin, IsFiniteAndNotNegativeWhereNoSceneShouldBe) {
    for (const Brdf& brdf : allBrdfs()) {
        const std::vector<BrdfRow> rows = harness::hostileRows(brdf, 4);
        const auto results = harness::BrdfEvaluator(library(), brdf).evaluate(rows);
        for (size_t i = 0; i < rows.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const float value = results[i].fCos[c];
                ASSERT_TRUE(std::isfinite(value) && value >= 0.0f)
                    << brdf.name << " " << describe(rows[i]) << ": " << value;
                if (!(rows[i].wi.z > 0.0f && rows[i].wo.z > 0.0f)) {
                    ASSERT_EQ(value, 0.0f) << brdf.name << " " << describe(rows[i]);
                }
            }
    }
}

/// 16 x 2^-24 (4 + c) of a function of the parameters alone, c from differences over four float roundings.
glm::dvec3 toleranceOf(const Brdf& brdf, const ParameterValues& values,
                       const std::function<glm::dvec3(const ParameterValues&)>& f) {
    const glm::dvec3 centre = f(values);
    glm::dvec3 change(0.0);
    for (size_t p = 0; p < static_cast<size_t>(brdf.valueCount()); ++p) {
        ParameterValues changed = values;
        changed[p] *= 1.0 + 4.0 * kFloatRounding;
        change += glm::abs(f(changed) - centre) / 4.0;
    }
    return 16.0 * (4.0 * kFloatRounding * centre + change);
}

/// The part that no light without extent shows, against its twin.
TEST_P(BrdfTwin, MirrorReflectance) {
    for (const Brdf& brdf : allBrdfs()) {
        if (!brdf.mirror) continue;
        const std::vector<BrdfRow> rows = harness::brdfRows(brdf, test::tableScale(1000), 7);
        const auto results = harness::BrdfEvaluator(library(), brdf).evaluate(rows);
        for (size_t i = 0; i < rows.size(); ++i) {
            const ParameterValues values = harness::valuesOf(brdf, rows[i]);
            const double cosTheta = harness::directionsOf(rows[i]).wo.z;
            if (cosTheta < 0.0) continue;
            const glm::dvec3 exact = brdf.mirror(cosTheta, values);
            const glm::dvec3 byAngle =
                glm::abs(brdf.mirror(cosTheta * (1.0 - 4.0 * kFloatRounding), values) - exact) / 4.0;
            const glm::dvec3 tolerance =
                16.0 * byAngle +
                toleranceOf(brdf, values, [&](const ParameterValues& v) { return brdf.mirror(cosTheta, v); });
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(double(results[i].mirror[c]), exact[c], tolerance[c] + 1e-37)
                    << brdf.name << " " << describe(rows[i]);
                EXPECT_GE(results[i].mirror[c], 0.0f);
            }
        }
    }
}

TEST_P(BrdfTwin, AmbientFactorAndRoughness) {
    for (const Brdf& brdf : allBrdfs()) {
        const std::vector<BrdfRow> rows = harness::brdfRows(brdf, test::tableScale(200), 5);
        const auto results = harness::BrdfEvaluator(library(), brdf).evaluate(rows);
        for (size_t i = 0; i < rows.size(); ++i) {
            const ParameterValues values = harness::valuesOf(brdf, rows[i]);
            const glm::dvec3 ambient = brdf.ambient(values);
            const glm::dvec3 tolerance =
                toleranceOf(brdf, values, [&](const ParameterValues& v) { return brdf.ambient(v); });
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(double(results[i].ambient[c]), ambient[c], tolerance[c])
                    << brdf.name << " " << describe(rows[i]);
            EXPECT_GE(results[i].roughness, 0.0f);
            EXPECT_LE(results[i].roughness, 1.0f);
        }
    }
}

/// A surface imitated from glTF reports glTF's roughness, but for lobes narrower than the exponent's range
/// allows.
TEST_P(BrdfTwin, RoughnessSurvivesImitation) {
    for (const char* name : {"phong", "blinn_phong", "metallic_roughness"}) {
        const Brdf& brdf = requireBrdf(name);
        std::vector<BrdfRow> rows;
        std::vector<double> roughness;
        for (double r : {0.05, 0.1, 0.3, 0.5, 0.8, 1.0}) {
            const ParameterValues values = brdf.fromMetallicRoughness({glm::dvec3(0.5), 0.5, r});
            rows.push_back({"imitated", {0, 0, 1}, {0, 0, 1}, {values.begin(), values.end()}});
            roughness.push_back(r);
        }
        const auto results = harness::BrdfEvaluator(library(), brdf).evaluate(rows);
        for (size_t i = 0; i < rows.size(); ++i) {
            // phong's exponent would be negative above roughness 0.96 only beyond 1; the float exponent costs
            // a few ulp.
            EXPECT_NEAR(double(results[i].roughness), roughness[i], 1e-6) << name;
        }
    }
}

LOBE_ON_EVERY_BACKEND(BrdfTwin);

}  // namespace
}  // namespace lobe
