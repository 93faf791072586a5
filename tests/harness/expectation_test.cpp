#include "harness/unit/expectation.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lobe::harness {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

bool holds(const std::string& text, float got, float against = 0.0f) {
    const GlslType type;
    DirectiveReader reader("expect", text, {"t.glsl", 3});
    const Expectation expectation = Expectation::parse(reader, type, ".");
    const Words value{wordOf(got)};
    const Words other =
        expectation.kind == Expectation::Kind::equalsValue ? expectation.value : Words{wordOf(against)};
    return !expectation.firstFault(type, value, other);
}

TEST(Expectation, FiniteAndBounded) {
    EXPECT_TRUE(holds("finite", std::numeric_limits<float>::max()));
    for (const float value : {kNan, -kNan, kInfinity, -kInfinity})
        EXPECT_FALSE(holds("finite", value));
    EXPECT_TRUE(holds("bounded(0, 1)", 0.0f));
    EXPECT_TRUE(holds("bounded(0, 1)", 1.0f));
    EXPECT_TRUE(holds("bounded(0, inf)", kInfinity));
    EXPECT_FALSE(holds("bounded(0, 1)", 0x1.000002p0f));
    EXPECT_FALSE(holds("bounded(0, 1)", -0x1p-149f));
    EXPECT_FALSE(holds("bounded(-inf, inf)", kNan));
}

TEST(Expectation, EqualsWithinAnyTolerance) {
    EXPECT_TRUE(holds("equals 1", 1.0f));
    EXPECT_TRUE(holds("equals 0", -0.0f));
    EXPECT_TRUE(holds("equals nan", kNan));
    EXPECT_TRUE(holds("equals inf", kInfinity));
    EXPECT_FALSE(holds("equals 1", 0x1.000002p0f));
    EXPECT_FALSE(holds("equals 1", kNan));
    EXPECT_TRUE(holds("equals 1 within 1 ulp", 0x1.000002p0f));
    EXPECT_FALSE(holds("equals 1 within 1 ulp", 0x1.000004p0f));
    EXPECT_TRUE(holds("equals 100 within rel 0.01", 101.0f));
    EXPECT_FALSE(holds("equals 100 within rel 0.01", 101.1f));
    EXPECT_TRUE(holds("equals 0 within 3 ulp or rel 0.01 or abs 1e-6", 1e-6f));
    EXPECT_FALSE(holds("equals 0 within rel 0.5", 1e-30f)) << "relative to the expected value, which is 0";
    EXPECT_FALSE(holds("equals 1e30 within abs inf", kInfinity));
    EXPECT_FALSE(holds("equals 1 within abs inf", kNan));
}

TEST(Expectation, Monotone) {
    EXPECT_TRUE(holds("monotone increasing in x", 1.0f, 1.0f));
    EXPECT_FALSE(holds("monotone strictly increasing in x", 1.0f, 1.0f));
    EXPECT_TRUE(holds("monotone strictly increasing in x", 1.0f, 0x1.000002p0f));
    EXPECT_FALSE(holds("monotone increasing in x", 0x1.000002p0f, 1.0f));
    EXPECT_TRUE(holds("monotone increasing in x within 1 ulp", 0x1.000002p0f, 1.0f));
    EXPECT_TRUE(holds("monotone decreasing in x", 2.0f, -3.0f));
    EXPECT_FALSE(holds("monotone decreasing in x", -kInfinity, 0.0f));
    EXPECT_TRUE(holds("monotone increasing in x", kInfinity, kInfinity));
    EXPECT_FALSE(holds("monotone increasing in x", kNan, kNan));
    EXPECT_FALSE(holds("monotone decreasing in x within abs inf", 1.0f, kNan));
}

TEST(Expectation, NamesTheFirstComponentThatIsWrong) {
    DirectiveReader reader("expect", "equals (1, 2, 3)", {"t.glsl", 3});
    const GlslType type{GlslType::Base::integer, 3};
    const Expectation expectation = Expectation::parse(reader, type, ".");
    EXPECT_EQ(expectation.firstFault(type, Words{1, 2, 4}, expectation.value), 2);
    EXPECT_EQ(expectation.firstFault(type, Words{1, 2, 3}, expectation.value), std::nullopt);
}

}  // namespace
}  // namespace lobe::harness
