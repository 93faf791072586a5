/// What docs/models/oren_nayar.md says of the model, as numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "albedo.hpp"
#include "math/sphere.hpp"

namespace lobe {
namespace {

const double kPi = glm::pi<double>();

enum Form : int { full, qualitative };

const Brdf& model() {
    return requireBrdf("oren_nayar");
}

ParameterValues valuesOf(double rho, double sigma, Form form) {
    return {rho, rho, rho, sigma, double(form)};
}

TEST(OrenNayar, SmoothIsLambert) {
    const Directions d(fromPolar(1.2, 0.3), fromPolar(0.9, 2.0));
    for (Form form : {full, qualitative})
        EXPECT_DOUBLE_EQ(model().fCos(d, valuesOf(0.7, 0.0, form)).r, 0.7 / kPi * d.wi.z);
}

TEST(OrenNayar, KnownGainsOfEnergy) {
    const test::Albedo fullForm = test::albedo(model(), valuesOf(1.0, 0.3, full), 0.01);
    EXPECT_NEAR(fullForm.value, 1.047, 2e-3 + fullForm.error);
    for (const auto& [form, most] : {std::pair(full, 1.051), std::pair(qualitative, 1.0155)}) {
        double largest = 0.0;
        for (double sigma : {0.05, 0.1, 0.2, 0.3, 0.5, 0.8, 1.5})
            for (double cosine : {1.0, 0.5, 0.2, 0.05, 0.01, 1e-3, 1e-4})
                largest = std::max(largest, test::albedo(model(), valuesOf(1.0, sigma, form), cosine).value);
        EXPECT_NEAR(largest, most, 1e-3);
    }
}

/// Both directions grazing on opposite sides of a rough surface: the fit is negative, and is cut off.
TEST(OrenNayar, NegativeValuesAreZero) {
    const Directions d(fromPolar(1.55, 0.0), fromPolar(1.55, kPi));
    const ParameterValues values = valuesOf(0.1, 1.5, full);
    EXPECT_EQ(model().fCos(d, values).r, 0.0);
    EXPECT_GT(model().termSizes(d, values).r, 0.0);
    EXPECT_GT(model().fCos(d, valuesOf(0.1, 1.5, qualitative)).r, 0.0);
}

TEST(OrenNayar, BothFormsAreContinuousWhereTheAzimuthIsARightAngle) {
    for (Form form : {full, qualitative}) {
        const auto at = [&](double phi) {
            return model().fCos({fromPolar(1.3, 0.0), fromPolar(1.1, phi)}, valuesOf(0.8, 0.7, form)).r;
        };
        EXPECT_NEAR(at(kPi / 2 - 1e-9), at(kPi / 2 + 1e-9), 1e-8 * at(kPi / 2));
    }
}

TEST(OrenNayar, BrightensTowardsTheLight) {
    const glm::dvec3 light = fromPolar(1.2, 0.0);
    const ParameterValues values = valuesOf(0.9, 0.6, full);
    EXPECT_GT(model().fCos({light, light}, values).r,
              2.0 * model().fCos({light, fromPolar(1.2, kPi)}, values).r);
}

}  // namespace
}  // namespace lobe
