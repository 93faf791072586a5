/// Punctual lights: GLSL against the twins, over the scales that scenes have.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "harness/evaluator.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"
#include "math/ulp.hpp"
#include "on_contexts.hpp"
#include "shading/punctual.hpp"

namespace lobe {
namespace {

class Punctual : public test::OnContext {
protected:
    harness::Evaluator geometry() const {
        return {library(),
                {"punctual_geometry",
                 {"light/punctual.glsl"},
                 {{"vec3", "to_light"}, {"float", "inv_range2"}},
                 "    PunctualGeometry g = punctual_geometry(to_light, inv_range2);\n"
                 "    result[0] = vec4(g.wi, g.attenuation);",
                 1,
                 {}}};
    }
    harness::Evaluator spot() const {
        return {library(),
                {"spot_attenuation",
                 {"light/punctual.glsl"},
                 {{"vec3", "axis"}, {"vec3", "wi"}, {"float", "scale"}, {"float", "offset"}},
                 "    result[0].x = spot_attenuation(axis, wi, scale, offset);",
                 1,
                 {}}};
    }
};

struct Sample {
    glm::vec3 toLight;
    float inverseRange2;
};

std::vector<Sample> samples(int count) {
    Pcg32 random(11);
    std::vector<Sample> list;
    for (int i = 0; i < count; ++i) {
        const double d = random.logUniform(1e-15, 1e18);
        const glm::vec3 toLight(d * uniformSphere({random.uniform(), random.uniform()}));
        // From far outside the range to far inside, and the last percent before its end.
        const double ratio = i % 3 == 0 ? random.uniform(0.99, 1.001) : random.logUniform(1e-3, 10.0);
        list.push_back({toLight, i % 5 == 0 ? 0.0f : static_cast<float>(inverseRange2(d / ratio))});
    }
    return list;
}

/// Tolerance 16 x 2^-24 (4 + c): attenuation w / d^2 has c = 2 |dw / w| t + 2 in the direction's components,
/// with w = 1 - t^2 and t = d^2 / range^2.
TEST_P(Punctual, GeometryAgreesFromAtomsToGalaxies) {
    const std::vector<Sample> list = samples(test::tableScale(20000));
    std::vector<float> inputs;
    for (const Sample& s : list)
        inputs.insert(inputs.end(), {s.toLight.x, s.toLight.y, s.toLight.z, s.inverseRange2});
    const harness::ResultTable table = geometry().evaluate(inputs);
    double worst = 0.0;
    for (size_t i = 0; i < list.size(); ++i) {
        const glm::dvec3 toLight(list[i].toLight);
        const double d2 = glm::dot(toLight, toLight);
        std::optional<double> range;
        if (list[i].inverseRange2 > 0.0f) range = 1.0 / std::sqrt(double(list[i].inverseRange2));
        const double exact = distanceAttenuation(d2, range);
        const double got = double(table.row(i)[3]);
        ASSERT_TRUE(std::isfinite(got) && got >= 0.0) << std::sqrt(d2);
        const glm::dvec3 wi(table.row(i)[0], table.row(i)[1], table.row(i)[2]);
        ASSERT_LT(glm::length(wi - glm::normalize(toLight)), 4.0 * 2 * kFloatRounding) << std::sqrt(d2);
        const double t = range ? d2 / (*range * *range) : 0.0;
        if (t >= 1.0) {
            // Nothing beyond the range, up to rounding of 1 - t^2.
            ASSERT_LE(got, 1e-6 / std::max(d2, kMinDistance2)) << std::sqrt(d2);
            if (t > 1.001) {
                ASSERT_EQ(got, 0.0) << std::sqrt(d2);
            }
            continue;
        }
        const double unit = kFloatRounding * (4.0 + 2.0 + 4.0 * t * t / std::max(1.0 - t * t, 1e-300));
        if (16.0 * unit > 0.1) continue;
        if (exact > 1e-30) worst = std::max(worst, std::abs(got - exact) / exact / unit);
        // 1.2e-38: what may be flushed to zero.
        ASSERT_LE(std::abs(got - exact), 16.0 * unit * exact + 1.2e-38)
            << "d " << std::sqrt(d2) << ", t " << t;
    }
    std::printf("punctual attenuation: worst %.2f of 16 units\n", worst);
}

TEST_P(Punctual, EndsOfRangeAndDistance) {
    const float most = std::numeric_limits<float>::max();
    const std::vector<float> inputs{0,      0,     0,     0,      // at the light
                                    0,      0,     0,     1,      //
                                    1e-7f,  0,     0,     0,      // below a micrometre
                                    1e-30f, 0,     0,     most,   //
                                    2,      0,     0,     0.25f,  // exactly at the range
                                    3,      0,     0,     0.25f,  // beyond
                                    1,      0,     0,     0.25f,  // (1 - 1/16) / 1
                                    1e19f,  1e19f, 1e19f, 0,      // d^2 beyond float
                                    most,   most,  most,  most,   //
                                    1e-44f, 0,     0,     0};     // denormal
    const harness::ResultTable table = geometry().evaluate(inputs);
    const auto attenuation = [&](size_t i) { return table.row(i)[3]; };
    for (size_t i = 0; i < table.rows(); ++i)
        for (float value : table.row(i))
            ASSERT_TRUE(std::isfinite(value)) << i;
    EXPECT_EQ(attenuation(0), 0.0f);
    EXPECT_EQ(attenuation(1), 0.0f);
    EXPECT_EQ(table.row(0)[0], 0.0f);
    EXPECT_FLOAT_EQ(attenuation(2), 1e12f);
    EXPECT_EQ(attenuation(4), 0.0f);
    EXPECT_EQ(attenuation(5), 0.0f);
    EXPECT_FLOAT_EQ(attenuation(6), 0.9375f);
    EXPECT_LT(attenuation(7), 1e-38f);
    EXPECT_EQ(attenuation(8), 0.0f);
}

/// Two spots: glTF's cos theta form and ours, both in floats. t = offset - scale v; its terms carry a few
/// roundings each, and v = |axis + wi|^2 / 2 is relative to itself.
TEST_P(Punctual, SpotConesOfAnyWidth) {
    Pcg32 random(12);
    std::vector<float> inputs;
    std::vector<double> exact, allowance, gltf;
    const double eps = kFloatRounding;
    for (int i = 0; i < test::tableScale(20000); ++i) {
        const double outer = random.logUniform(1e-3, glm::half_pi<double>());
        const double inner = i % 4 == 0 ? outer * random.uniform(0.9, 0.9999) : outer * random.uniform();
        const glm::vec3 axis(uniformSphere({random.uniform(), random.uniform()}));
        const double theta =
            i % 3 == 0 ? outer * random.uniform(0.99, 1.01) : outer * random.uniform(0.0, 1.5);
        const glm::vec3 wi(-(frameAbout(glm::normalize(glm::dvec3(axis))) *
                             fromPolar(theta, random.uniform(0.0, glm::two_pi<double>()))));
        const SpotScaleOffset cone = spotScaleOffset(inner, outer);
        inputs.insert(inputs.end(), {axis.x, axis.y, axis.z, wi.x, wi.y, wi.z, static_cast<float>(cone.scale),
                                     static_cast<float>(cone.offset)});
        const double cosine = -glm::dot(glm::normalize(glm::dvec3(axis)), glm::normalize(glm::dvec3(wi)));
        exact.push_back(std::sqrt(spotAttenuation(cosine, inner, outer)));
        // 16 roundings of each term.
        allowance.push_back(16.0 * eps * (cone.offset + cone.scale * (1.0 - cosine)) + 1e-15 * cone.scale);
        const auto scale = static_cast<float>(cone.scale);
        const auto offset = static_cast<float>(-std::cos(outer) * cone.scale);
        gltf.push_back(
            std::abs(double(glm::clamp(-glm::dot(axis, wi) * scale + offset, 0.0f, 1.0f)) - exact.back()));
    }
    const harness::ResultTable table = spot().evaluate(inputs);
    double worst = 0.0;
    size_t gltfFailures = 0;
    for (size_t i = 0; i < exact.size(); ++i) {
        const double got = std::sqrt(double(table.row(i)[0]));
        const double error = std::abs(got - exact[i]);
        worst = std::max(worst, error / allowance[i]);
        ASSERT_LE(error, allowance[i] + 2 * eps * exact[i]) << i << ": " << got << ", exact " << exact[i];
        if (gltf[i] > allowance[i] + 2 * eps * exact[i]) ++gltfFailures;
    }
    std::printf("spot cone: worst %.2f of 16 roundings; cos theta * scale + offset fails %zu of %zu\n",
                16.0 * worst, gltfFailures, exact.size());
    EXPECT_GT(gltfFailures, exact.size() / 10);
}

TEST_P(Punctual, SpotEnds) {
    const SpotScaleOffset half = spotScaleOffset(0.0, glm::half_pi<double>());
    const SpotScaleOffset step = spotScaleOffset(0.5, 0.5);
    const auto row = [](double theta, const SpotScaleOffset& cone) {
        const glm::vec3 wi(-fromPolar(theta, 0.0));
        return std::vector<float>{
            0, 0, 1, wi.x, wi.y, wi.z, static_cast<float>(cone.scale), static_cast<float>(cone.offset)};
    };
    std::vector<float> inputs;
    for (const auto& r : {row(0.0, half), row(1.6, half), row(glm::pi<double>(), half), row(0.499, step),
                          row(0.501, step), std::vector<float>{0, 0, 1, 0, 0, 0, 1, 1}})
        inputs.insert(inputs.end(), r.begin(), r.end());
    const harness::ResultTable table = spot().evaluate(inputs);
    EXPECT_EQ(table.row(0)[0], 1.0f);
    EXPECT_EQ(table.row(1)[0], 0.0f);
    EXPECT_EQ(table.row(2)[0], 0.0f);
    // inner = outer: 0.001 in cosine wide, as glTF says, so 0.499 is not yet fully lit.
    EXPECT_NEAR(double(table.row(3)[0]), spotAttenuation(std::cos(0.499), 0.5, 0.5), 1e-4);
    EXPECT_EQ(table.row(4)[0], 0.0f);
    EXPECT_TRUE(std::isfinite(table.row(5)[0]));  // a light at the very point: wi = 0
}

LOBE_ON_EVERY_BACKEND(Punctual);

TEST(PunctualTwins, FollowTheExtension) {
    EXPECT_DOUBLE_EQ(distanceAttenuation(4.0, std::nullopt), 0.25);
    EXPECT_DOUBLE_EQ(distanceAttenuation(4.0, 4.0), 0.25 * (1.0 - 1.0 / 16.0));
    EXPECT_EQ(distanceAttenuation(16.0, 4.0), 0.0);
    EXPECT_EQ(distanceAttenuation(17.0, 4.0), 0.0);
    EXPECT_EQ(distanceAttenuation(0.0, std::nullopt), 1e12);
    EXPECT_EQ(inverseRange2(std::nullopt), 0.0);
    EXPECT_TRUE(std::isfinite(static_cast<float>(inverseRange2(1e-30))));
    EXPECT_DOUBLE_EQ(spotAttenuation(1.0, 0.2, 0.4), 1.0);
    EXPECT_EQ(spotAttenuation(std::cos(0.41), 0.2, 0.4), 0.0);
    const double middle = 0.5 * (std::cos(0.2) + std::cos(0.4));
    EXPECT_NEAR(spotAttenuation(middle, 0.2, 0.4), 0.25, 1e-14);
    const SpotScaleOffset cone = spotScaleOffset(0.2, 0.4);
    EXPECT_NEAR(cone.offset - cone.scale * (1.0 - middle), 0.5, 1e-14);
}

}  // namespace
}  // namespace lobe
