#include "math/quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace lobe {
namespace {

TEST(GaussLegendre, IntegratesPolynomialsUpToTwiceItsOrderExactly) {
    for (int n : {1, 2, 3, 5, 8, 16, 33, 64}) {
        const QuadratureRule rule = gaussLegendre(n);
        for (int degree : {0, 1, 2 * n - 2, 2 * n - 1}) {
            double sum = 0.0;
            for (size_t i = 0; i < rule.nodes.size(); ++i)
                sum += rule.weights[i] * std::pow(rule.nodes[i], degree);
            const double exact = degree % 2 == 1 ? 0.0 : 2.0 / (degree + 1);
            EXPECT_NEAR(sum, exact, 1e-14 * n) << "n = " << n << ", x^" << degree;
        }
    }
}

TEST(GaussLegendre, IsNotExactBeyondTwiceItsOrder) {
    const QuadratureRule rule = gaussLegendre(3);
    double sum = 0.0;
    for (size_t i = 0; i < rule.nodes.size(); ++i)
        sum += rule.weights[i] * std::pow(rule.nodes[i], 6);
    EXPECT_GT(std::abs(sum - 2.0 / 7.0), 1e-3);
}

TEST(GaussLegendre, NodesAscendAndAreSymmetric) {
    const QuadratureRule rule = gaussLegendre(21);
    for (size_t i = 0; i + 1 < rule.nodes.size(); ++i)
        EXPECT_LT(rule.nodes[i], rule.nodes[i + 1]);
    for (size_t i = 0; i < rule.nodes.size(); ++i) {
        EXPECT_NEAR(rule.nodes[i], -rule.nodes[20 - i], 1e-15);
        EXPECT_NEAR(rule.weights[i], rule.weights[20 - i], 1e-14);
    }
}

TEST(IntegratePanels, GradedPanelsResolveANarrowPeak) {
    const double width = 1e-5;
    const std::vector<double> breaks = gradedBreaks(1e-7, glm::pi<double>(), 60);
    const double sum =
        integratePanels([&](double x) { return width / (x * x + width * width); }, breaks, gaussLegendre(12));
    EXPECT_NEAR(sum, std::atan(glm::pi<double>() / width), 1e-12);
}

TEST(IntegrateHemisphere, AreaAndMomentsAboutAnyAxisAboveTheHorizon) {
    const double pi = glm::pi<double>();
    const QuadratureRule rule = gaussLegendre(24);
    const std::vector<double> breaks{0.0, 0.3, 1.0};
    for (const glm::dvec3& axis :
         {glm::dvec3(0, 0, 1), glm::normalize(glm::dvec3(1, -2, 0.5)), glm::dvec3(0.6, 0, 0.8)}) {
        EXPECT_NEAR(integrateHemisphere([](const glm::dvec3&) { return 1.0; }, axis, breaks, 8, rule),
                    2.0 * pi, 1e-10);
        EXPECT_NEAR(integrateHemisphere([](const glm::dvec3& w) { return w.z; }, axis, breaks, 8, rule), pi,
                    1e-10);
        EXPECT_NEAR(integrateHemisphere([](const glm::dvec3& w) { return w.x * w.x; }, axis, breaks, 8, rule),
                    2.0 / 3.0 * pi, 1e-10);
    }
}

}  // namespace
}  // namespace lobe
