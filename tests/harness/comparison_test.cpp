/// The comparison with a twin must be able to fail, and a twin that has no value must not pass for agreement.
#include "harness/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lobe::harness {
namespace {

using testing::HasSubstr;

BrdfRow lambertRow() {
    return {"test", {0.0f, 0.6f, 0.8f}, {0.0f, 0.0f, 1.0f}, {0.5f, 0.5f, 0.5f}};
}

glm::vec3 exactly(const Brdf& brdf, const BrdfRow& row) {
    return glm::vec3(brdf.fCos(directionsOf(row), valuesOf(brdf, row)));
}

TEST(Comparison, TakesTheTwinsOwnValueAndNothingElse) {
    const Brdf& lambert = requireBrdf("lambert");
    const BrdfRow row = lambertRow();
    const glm::vec3 right = exactly(lambert, row);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_TRUE(Comparison(lambert, Axes::local).check(row, directionsOf(row), right));
    for (const float wrong :
         {right.g * 1.00003f, right.g * 0.99997f, 0.0f, -right.g, nan, infinity, -infinity}) {
        Comparison comparison(lambert, Axes::local);
        EXPECT_FALSE(comparison.check(row, directionsOf(row), {right.r, wrong, right.b})) << wrong;
        EXPECT_THAT(comparison.message(), HasSubstr("channel 1")) << wrong;
    }
}

TEST(Comparison, FailsWhereTheTwinHasNoValue) {
    Brdf broken = requireBrdf("lambert");
    broken.fCos = [](const Directions&, std::span<const double>) { return glm::dvec3(std::nan("")); };
    const BrdfRow row = lambertRow();
    Comparison comparison(broken, Axes::local);
    EXPECT_FALSE(comparison.check(row, directionsOf(row), exactly(requireBrdf("lambert"), row)));
    EXPECT_THAT(comparison.message(), HasSubstr("the twin, which gave NaN"));
}

}  // namespace
}  // namespace lobe::harness
