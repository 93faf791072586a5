/// What docs/models/ashikhmin_shirley.md says of the model's energy, as numbers.
#include <gtest/gtest.h>

#include "albedo.hpp"

namespace lobe {
namespace {

/// Albedo for equal exponents and a grey surface.
test::Albedo albedoOf(double diffuse, double specular, double n, double cosine) {
    return test::albedo(requireBrdf("ashikhmin_shirley"),
                        {diffuse, diffuse, diffuse, specular, specular, specular, n, n, 0.0}, cosine);
}

TEST(AshikhminShirley, KnownAlbedo) {
    // The base without a coat: 28 / (23 pi) is 1 over the integral of its other factors.
    EXPECT_NEAR(albedoOf(1.0, 0.0, 1e6, 1.0).value, 31.0 / 32.0, 1e-9);
    // A perfect coat of exponent 1, at normal incidence: 1 / 4.
    EXPECT_NEAR(albedoOf(0.0, 1.0, 1.0, 1.0).value, 0.25, 1e-9);
    EXPECT_NEAR(albedoOf(0.0, 1.0, 1e4, 1.0).value, 1.0, 1e-3);
}

/// The base takes what the coat leaves, on average: sums stay below 1 although both may be white.
TEST(AshikhminShirley, NeverGainsEnergy) {
    double largest = 0.0;
    for (double n : {0.0, 0.3, 1.0, 3.0, 10.0, 100.0, 3000.0})
        for (double specular : {0.0, 0.05, 0.5, 1.0})
            for (double cosine : {1.0, 0.7, 0.3, 0.1, 0.02}) {
                const test::Albedo a = albedoOf(1.0, specular, n, cosine);
                EXPECT_LE(a.value, 1.0 + a.error) << n << " " << specular << " " << cosine;
                largest = std::max(largest, a.value);
            }
    EXPECT_GT(largest, 0.99);
}

}  // namespace
}  // namespace lobe
