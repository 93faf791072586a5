/// common/numeric.glsl: the functions that models need beside log, exp and pow, each within its bound.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "harness/evaluator.hpp"
#include "math/random.hpp"
#include "math/ulp.hpp"
#include "on_contexts.hpp"

namespace lobe {
namespace {

using harness::Evaluator;

class GlslNumeric : public test::OnContext {
protected:
    /// One result a row of `inputs` floats, from an expression of x and y.
    harness::ResultTable evaluate(const std::string& expression, const std::vector<float>& inputs) const {
        return Evaluator(library(), {"numeric",
                                     {"common/numeric.glsl"},
                                     {{"float", "x"}, {"float", "y"}},
                                     "    result[0].xy = vec2(" + expression + ");",
                                     1,
                                     {}})
            .evaluate(inputs);
    }

    /// Largest error over `bound`(x, y, exact).
    double worst(const std::string& expression, const std::vector<float>& inputs,
                 const std::function<double(double, double)>& exactOf,
                 const std::function<double(double, double, double)>& bound) const {
        const harness::ResultTable table = evaluate(expression, inputs);
        double worst = 0.0;
        for (size_t i = 0; i < table.rows(); ++i) {
            const auto x = double(inputs[2 * i]), y = double(inputs[2 * i + 1]);
            const double exact = exactOf(x, y);
            const double error = std::abs(double(table.row(i)[0]) - exact);
            const double share = error == 0.0 ? 0.0 : error / bound(x, y, exact);
            EXPECT_LE(share, 1.0) << expression << " at " << x << ", " << y << ": " << table.row(i)[0]
                                  << "; expected " << exact;
            worst = std::max(worst, share);
        }
        std::printf("%s: %.2f of its bound\n", expression.c_str(), worst);
        return worst;
    }
};

TEST_P(GlslNumeric, CosineAndSine) {
    Pcg32 random(41);
    std::vector<float> inputs{0.0f, 0.0f, 1.57079637f, 0.0f, -3.14159274f, 0.0f, 7.0f, 0.0f};
    for (int i = 0; i < test::tableScale(50000); ++i) {
        const double x = random.below(2) == 0
                             ? random.uniform(-1000.0, 1000.0)
                             : random.logUniform(1e-30, 7.0) * (random.below(2) == 0 ? 1 : -1);
        inputs.insert(inputs.end(), {static_cast<float>(x), 0.0f});
    }
    const auto absolute = [](double, double, double) { return 2e-7; };
    worst(
        "numeric_cos_sin(x).x", inputs, [](double x, double) { return std::cos(x); }, absolute);
    worst(
        "numeric_cos_sin(x).y", inputs, [](double x, double) { return std::sin(x); }, absolute);
}

/// Of the first quadrant, at and about the angles where its three series meet too.
TEST_P(GlslNumeric, Angle) {
    Pcg32 random(42);
    std::vector<float> inputs{1.0f, 0.0f, 0.0f, 1.0f, 1.0f, 1.0f, 0.0f, 0.0f};
    for (int i = 0; i < test::tableScale(50000); ++i) {
        const double seam = i % 2 == 0 ? 0.41421356237 : 2.41421356237;
        inputs.insert(inputs.end(), {static_cast<float>(random.logUniform(1e-10, 1.0)),
                                     static_cast<float>(random.logUniform(1e-10, 1.0))});
        inputs.insert(inputs.end(), {1.0f, static_cast<float>(seam * (1.0 + random.uniform(-1e-6, 1e-6)))});
    }
    worst(
        "numeric_angle(x, y)", inputs,
        [](double x, double y) { return x == 0.0 && y == 0.0 ? 0.0 : std::atan2(y, x); },
        [](double, double, double exact) { return 4e-7 * exact; });
}

/// The fit's 1.2e-7; its polynomial, whose terms cancel near 0, the quotient in it, exp() and the product: 11
/// roundings; x^2 and its difference: 2 of x^2.
TEST_P(GlslNumeric, ComplementaryErrorFunction) {
    Pcg32 random(43);
    std::vector<float> inputs{0.0f, 0.0f};
    for (int i = 0; i < test::tableScale(50000); ++i)
        inputs.insert(inputs.end(), {static_cast<float>(random.uniform(0.0, 9.0)), 0.0f,
                                     static_cast<float>(random.logUniform(1e-20, 1.0)), 0.0f});
    worst(
        "numeric_erfc(x)", inputs, [](double x, double) { return std::erfc(x); },
        [](double x, double, double exact) { return (7.5e-7 + 1.2e-7 * x * x) * exact; });
}

/// The logarithm's five roundings, or the rounding of 1 + x against a logarithm above 0.26, and the
/// quotient's.
TEST_P(GlslNumeric, LogarithmOverItsArgument) {
    Pcg32 random(44);
    std::vector<float> inputs{0.0f, 0.0f, 0.3f, 0.0f, 0x1.333334p-2f, 0.0f};
    for (int i = 0; i < test::tableScale(50000); ++i)
        inputs.insert(inputs.end(), {static_cast<float>(random.logUniform(1e-36, 1e36)), 0.0f,
                                     static_cast<float>(random.uniform(0.0, 1.0)), 0.0f});
    worst(
        "numeric_log1p_ratio(x)", inputs, [](double x, double) { return x == 0.0 ? 1.0 : std::log1p(x) / x; },
        [](double x, double, double exact) { return (x < 0.3 ? 6.0 : 10.0) * kFloatRounding * exact; });
}

/// Where e^x alone is below the least float, too.
TEST_P(GlslNumeric, ExponentialTimes) {
    Pcg32 random(45);
    std::vector<float> inputs{0.0f, 1.0f, -0.0f, 1e37f, -87.0f, 1.0f, -174.0f, 1e37f, -88.0f, 0.0f};
    for (int i = 0; i < test::tableScale(50000); ++i) {
        const double x = -random.uniform(0.0, 173.0);
        // Products that a float holds: above 1e-37.
        const double least = std::max(1e-37 * std::exp(-x), 1e-37);
        if (least < 1e37)
            inputs.insert(inputs.end(),
                          {static_cast<float>(x), static_cast<float>(random.logUniform(least, 1e37))});
    }
    worst(
        "numeric_exp_times(x, y)", inputs, [](double x, double y) { return std::exp(x) * y; },
        [](double, double, double exact) { return 5.0 * kFloatRounding * exact + 1e-37; });
    const harness::ResultTable far =
        evaluate("numeric_exp_times(x, y)", {-175.0f, 1e37f, -1e30f, 1e37f, -INFINITY, 1.0f});
    for (size_t i = 0; i < far.rows(); ++i)
        EXPECT_EQ(far.row(i)[0], 0.0f);
}

LOBE_ON_EVERY_BACKEND(GlslNumeric);

}  // namespace
}  // namespace lobe
