#include "math/cubature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lobe {
namespace {

TEST(Cubature, PolynomialsOfDegreeSevenAreExact) {
    for (int i = 0; i <= 7; ++i)
        for (int j = 0; i + j <= 7; ++j) {
            CubatureOptions once;
            once.evaluations = 17;
            const CubatureResult result = integrateSquare(
                [&](double x, double y) { return glm::dvec3(std::pow(x, i) * std::pow(y, j)); }, once);
            EXPECT_NEAR(result.integral.x, 1.0 / ((i + 1) * (j + 1)), 1e-14) << i << " " << j;
            EXPECT_EQ(result.evaluations, 17);
        }
    CubatureOptions once;
    once.evaluations = 17;
    const double eighth =
        integrateSquare([](double x, double) { return glm::dvec3(std::pow(x, 8)); }, once).integral.x;
    EXPECT_GT(std::abs(eighth - 1.0 / 9.0), 1e-8);
}

TEST(Cubature, EachComponentConverges) {
    const CubatureResult result = integrateSquare([](double x, double y) {
        return glm::dvec3(std::exp(x * y), 1.0 / ((x - 0.3) * (x - 0.3) + 1e-4), std::abs(y - 0.4));
    });
    EXPECT_TRUE(result.converged);
    EXPECT_NEAR(result.integral.x, 1.3179021514544039, 1e-9);  // Ei(1) - gamma
    EXPECT_NEAR(result.integral.y, (std::atan(70.0) + std::atan(30.0)) / 0.01, 1e-6);
    EXPECT_NEAR(result.integral.z, (0.16 + 0.36) / 2, 1e-6);
}

TEST(Cubature, SaysWhenItGaveUp) {
    CubatureOptions few;
    few.evaluations = 200;
    few.relativeError = 1e-6;
    const auto jump = [](double x, double y) { return glm::dvec3(x * x + y * y < 0.5 ? 1.0 : 0.0); };
    const CubatureResult result = integrateSquare(jump, few);
    EXPECT_FALSE(result.converged);
    EXPECT_LE(result.evaluations, 200);
    EXPECT_NEAR(result.integral.x, std::numbers::pi / 8, result.error);
}

TEST(Cubature, ANarrowPeakIsFoundWithCellsAsWideAsItIs) {
    const auto peak = [](double x, double y) {
        const double r2 = (x - 0.71) * (x - 0.71) + (y - 0.42) * (y - 0.42);
        return glm::dvec3(std::exp(-r2 / 1e-3));
    };
    CubatureOptions fine;
    fine.cells = 16;
    const CubatureResult result = integrateSquare(peak, fine);
    EXPECT_TRUE(result.converged);
    EXPECT_NEAR(result.integral.x, 1e-3 * std::numbers::pi, 1e-11);
}

}  // namespace
}  // namespace lobe
