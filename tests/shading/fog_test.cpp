/// Fog: GLSL against the twins, the twins against integrals, from no fog to a wall and from the eye to
/// infinity.
#include "shading/fog.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "harness/evaluator.hpp"
#include "math/quadrature.hpp"
#include "math/random.hpp"
#include "math/ulp.hpp"
#include "on_contexts.hpp"

namespace lobe {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class FogGlsl : public test::OnContext {
protected:
    harness::Evaluator evaluator(const std::string& name, const std::vector<harness::Variable>& inputs,
                                 const std::string& body) const {
        return {library(), {name, {"light/fog.glsl"}, inputs, body, 1, {}}};
    }
    harness::Evaluator mean() const {
        return evaluator("fog_phi", {{"float", "x"}}, "    result[0].xy = vec2(fog_phi(x), fog_opacity(x));");
    }
    harness::Evaluator even() const {
        return evaluator(
            "fog_depth", {{"float", "extinction"}, {"float", "way"}},
            "    vec3 depth = fog_depth(vec3(extinction), way);\n"
            "    result[0] = vec4(depth.x, fog_transmittance(depth).x, fog_opacity(depth).x, 0.0);");
    }
    harness::Evaluator high() const {
        return evaluator(
            "fog_depth_by_height", {{"float", "log_density"}, {"float", "slope"}, {"float", "way"}},
            "    vec3 depth = fog_depth_by_height(vec3(log_density), slope, way);\n"
            "    result[0] = vec4(depth.x, fog_transmittance(depth).x, fog_opacity(depth).x, 0.0);");
    }
};

TEST_P(FogGlsl, MeanAndOpacityKeepTheirDigits) {
    Pcg32 random(5);
    std::vector<float> inputs{0.0f,  0.49999997f, 0.5f,  1e-38f,
                              86.9f, 87.1f,       1e30f, std::numeric_limits<float>::infinity()};
    for (int i = 0; i < test::tableScale(20000); ++i)
        inputs.push_back(
            static_cast<float>(i % 3 == 0 ? random.uniform(0.0, 2.0) : random.logUniform(1e-30, 1e10)));
    const harness::ResultTable table = mean().evaluate(inputs);
    double worstMean = 0.0, worstOpacity = 0.0;
    for (size_t i = 0; i < inputs.size(); ++i) {
        const auto x = static_cast<double>(inputs[i]);
        const double phi = std::isinf(x) ? 0.0 : fogPhi(x);
        ASSERT_TRUE(std::isfinite(table.row(i)[0]) && std::isfinite(table.row(i)[1])) << x;
        if (phi > 1e-37)
            worstMean = std::max(worstMean, std::abs(static_cast<double>(table.row(i)[0]) - phi) / phi);
        if (x > 1e-37)
            worstOpacity = std::max(
                worstOpacity, std::abs(static_cast<double>(table.row(i)[1]) - fogOpacity(x)) / fogOpacity(x));
    }
    // Beyond 0.5: the error of e^-x, 2.5e-7 of at most 0.61, over 0.39, and three roundings. Below: the
    // series.
    std::printf("fog_phi: %.2g, fog_opacity: %.2g\n", worstMean, worstOpacity);
    EXPECT_LT(worstMean, 2.5e-7 * 0.61 / 0.39 + 4 * kFloatRounding);
    EXPECT_LT(worstOpacity, 2.5e-7 * 0.61 / 0.39 + 4 * kFloatRounding);
}

TEST_P(FogGlsl, EvenFogFromNoneToAWall) {
    std::vector<float> inputs;
    const std::vector<double> extinctions{0.0, 1e-6, 1e-3, 0.05, 1.0, 30.0, 1e3, 1e6, 1e30};
    const std::vector<double> ways{0.0, 1e-6, 1e-3, 0.1, 1.0, 10.0, 1e3, 1e6, 1e18, kInfinity};
    for (const double extinction : extinctions)
        for (const double way : ways)
            inputs.insert(inputs.end(), {static_cast<float>(extinction), static_cast<float>(way)});
    const harness::ResultTable table = even().evaluate(inputs);
    for (size_t i = 0; i < table.rows(); ++i) {
        const auto extinction = static_cast<double>(inputs[2 * i]),
                   way = static_cast<double>(inputs[2 * i + 1]);
        const double depth = fogOpticalDepth({glm::dvec3(extinction)}, 3.0, 0.7, way).x;
        const double transmittance = static_cast<double>(table.row(i)[1]),
                     opacity = static_cast<double>(table.row(i)[2]);
        // The depth's own rounding moves T by depth e^-depth 2^-24, at most 0.37 of it.
        EXPECT_NEAR(transmittance, std::exp(-depth), 2.5e-7 + kFloatRounding) << extinction << ", " << way;
        EXPECT_NEAR(opacity, fogOpacity(depth), 8e-7 * fogOpacity(depth)) << extinction << ", " << way;
    }
}

/// The exponent's terms are rounded to 2^-24 of themselves, which is the density's relative error.
TEST_P(FogGlsl, FogByHeightAgreesOverAllScales) {
    Pcg32 random(6);
    std::vector<float> inputs;
    for (int i = 0; i < test::tableScale(40000); ++i) {
        const double falloff = random.logUniform(1e-9, 1e3);
        const double rise = i % 7 == 0 ? 0.0 : random.uniform(-1.0, 1.0);
        const double way = i % 11 == 0 ? kInfinity : random.logUniform(1e-6, 1e9);
        inputs.insert(inputs.end(), {static_cast<float>(random.uniform(-60.0, 60.0)),
                                     static_cast<float>(falloff * rise), static_cast<float>(way)});
    }
    const harness::ResultTable table = high().evaluate(inputs);
    double worst = 0.0;
    size_t compared = 0;
    for (size_t i = 0; i < table.rows(); ++i) {
        const auto logDensity = static_cast<double>(inputs[3 * i]),
                   slope = static_cast<double>(inputs[3 * i + 1]),
                   way = static_cast<double>(inputs[3 * i + 2]);
        const double transmittance = static_cast<double>(table.row(i)[1]),
                     opacity = static_cast<double>(table.row(i)[2]);
        ASSERT_TRUE(transmittance >= 0.0 && transmittance <= 1.0) << i;
        ASSERT_TRUE(opacity >= 0.0 && opacity <= 1.0) << i;
        const FogMedium fog{glm::dvec3(std::exp(logDensity)), std::abs(slope), 0.0};
        const double depth = fogOpticalDepth(fog, 0.0, slope < 0.0 ? -1.0 : 1.0, way).x;
        const double steepness = std::isinf(way) ? 0.0 : std::abs(slope) * way;
        const double exponent = logDensity + (slope < 0.0 ? steepness : 0.0);
        const double unit = kFloatRounding * (16.0 + 2.0 * (std::abs(logDensity) + steepness));
        if (exponent > 87.0 || !(depth < 1e30)) {
            EXPECT_EQ(transmittance, std::exp(-depth)) << i;
            continue;
        }
        const double got = static_cast<double>(table.row(i)[0]);
        worst = std::max(worst, std::abs(got - depth) / depth / unit);
        ASSERT_LE(std::abs(got - depth), unit * depth) << logDensity << ", " << slope << ", " << way;
        ASSERT_NEAR(transmittance, std::exp(-depth), 0.37 * unit + 2.5e-7);
        ASSERT_NEAR(opacity, fogOpacity(depth), (unit + 8e-7) * fogOpacity(depth));
        ++compared;
    }
    std::printf("fog by height: worst %.2f of the allowance, %zu of %zu compared\n", worst, compared,
                table.rows());
    EXPECT_GT(compared, table.rows() / 2);
}

/// Along one ray: never more light further away, and no step where the formula changes.
TEST_P(FogGlsl, MonotoneAndContinuousAlongARay) {
    for (const float slope : {-3.0f, -1e-3f, -1e-30f, 0.0f, 1e-30f, 1e-3f, 3.0f, 1e6f}) {
        std::vector<float> inputs;
        constexpr int kSteps = 2000;
        for (int i = 0; i <= kSteps; ++i)
            inputs.insert(inputs.end(),
                          {std::log(0.7f), slope, static_cast<float>(std::exp2(0.02 * i - 20.0))});
        const harness::ResultTable table = high().evaluate(inputs);
        for (size_t i = 1; i < table.rows(); ++i) {
            const auto before = static_cast<double>(table.row(i - 1)[1]),
                       after = static_cast<double>(table.row(i)[1]);
            const auto growth =
                static_cast<double>(table.row(i)[0]) - static_cast<double>(table.row(i - 1)[0]);
            ASSERT_LE(after, before + 4.0 * kFloatRounding) << slope << " at " << inputs[3 * i + 2];
            // T changes by no more than the depth.
            if (std::isfinite(growth)) {
                ASSERT_LE(before - after, std::abs(growth) + 6e-7) << slope << " at " << inputs[3 * i + 2];
            } else {
                ASSERT_EQ(after, 0.0) << slope << " at " << inputs[3 * i + 2];
            }
        }
    }
}

TEST_P(FogGlsl, EndsOfEverything) {
    const float infinity = std::numeric_limits<float>::infinity(), most = std::numeric_limits<float>::max();
    std::vector<float> inputs;
    for (const float logDensity : {-1e30f, -88.0f, 0.0f, 13.8f, 88.0f, 1e30f})
        for (const float slope : {-most, -1.0f, -1e-44f, 0.0f, 1e-44f, 1e-38f, 1.0f, most})
            for (const float way : {0.0f, 1e-44f, 1.0f, most, infinity})
                inputs.insert(inputs.end(), {logDensity, slope, way});
    const harness::ResultTable table = high().evaluate(inputs);
    for (size_t i = 0; i < table.rows(); ++i) {
        const float transmittance = table.row(i)[1], opacity = table.row(i)[2];
        const std::string where = std::to_string(inputs[3 * i]) + ", " + std::to_string(inputs[3 * i + 1]) +
                                  ", " + std::to_string(inputs[3 * i + 2]);
        ASSERT_TRUE(transmittance >= 0.0f && transmittance <= 1.0f) << where;
        ASSERT_TRUE(opacity >= 0.0f && opacity <= 1.0f) << where;
        ASSERT_NEAR(transmittance + opacity, 1.0f, 1e-6f) << where;
        if (inputs[3 * i + 2] == 0.0f) {
            ASSERT_EQ(transmittance, 1.0f) << where;
        }
    }
}

LOBE_ON_EVERY_BACKEND(FogGlsl);

TEST(FogTwin, DepthIsTheIntegralOfTheDensity) {
    Pcg32 random(7);
    const QuadratureRule rule = gaussLegendre(32);
    for (int i = 0; i < 200; ++i) {
        FogMedium fog;
        fog.extinction = {random.logUniform(1e-3, 10.0), 0.0, 1.0};
        fog.heightFalloff = i % 4 == 0 ? 0.0 : random.logUniform(1e-4, 2.0);
        fog.height = random.uniform(-3.0, 3.0);
        const double start = random.uniform(-5.0, 5.0), rise = random.uniform(-1.0, 1.0),
                     length = random.logUniform(1e-3, 10.0);
        std::vector<double> breaks;
        for (int b = 0; b <= 16; ++b)
            breaks.push_back(length * b / 16.0);
        const double integral = integratePanels(
            [&](double s) {
                return fog.extinction.x * std::exp(-fog.heightFalloff * (start + rise * s - fog.height));
            },
            breaks, rule);
        const glm::dvec3 depth = fogOpticalDepth(fog, start, rise, length);
        EXPECT_NEAR(depth.x, integral, 1e-12 * integral);
        EXPECT_EQ(depth.y, 0.0);
    }
}

TEST(FogTwin, EndsOfEverything) {
    EXPECT_EQ(fogPhi(0.0), 1.0);
    EXPECT_DOUBLE_EQ(fogPhi(1e-9), 1.0 - 0.5e-9);
    EXPECT_EQ(fogOpacity(kInfinity), 1.0);
    for (const double extinction : {0.0, 1e-300, 0.05, 1e6})
        for (const double falloff : {0.0, 1e-12, 1.0, 1e9})
            for (const double start : {-1e9, 0.0, 1e9})
                for (const double rise : {-1.0, -1e-12, 0.0, 1e-12, 1.0})
                    for (const double length : {0.0, 1e-9, 1.0, 1e18, kInfinity}) {
                        const glm::dvec3 t =
                            fogTransmittance({glm::dvec3(extinction), falloff, 0.0}, start, rise, length);
                        ASSERT_TRUE(t.x >= 0.0 && t.x <= 1.0) << extinction << ", " << falloff << ", "
                                                              << start << ", " << rise << ", " << length;
                    }
}

}  // namespace
}  // namespace lobe
