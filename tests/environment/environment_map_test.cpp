#include "environment/environment_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "math/random.hpp"
#include "math/sphere.hpp"
#include "pictures.hpp"

namespace lobe {
namespace {

constexpr double kPi = std::numbers::pi;

using test::floatPicture;

Environment pictured() {
    Environment environment;
    environment.image = 0;
    return environment;
}

/// The direction of a texel's centre, by the words of docs/scenes.md.
glm::dvec3 directionOf(double x, double y, int width, int height) {
    const double azimuth = 2.0 * kPi * (x + 0.5) / width, polar = kPi * (y + 0.5) / height;
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

TEST(EnvironmentMap, ConstantIsTheSameEverywhere) {
    Environment environment;
    environment.radiance = {1, 2, 3};
    environment.intensity = 2.0;
    const EnvironmentMap map(environment, nullptr);
    EXPECT_TRUE(map.constant());
    EXPECT_EQ(map.radiance({0, 1, 0}), glm::dvec3(2, 4, 6));
    EXPECT_DOUBLE_EQ(map.density({0, 0, 1}), 1.0 / (4.0 * kPi));
}

TEST(EnvironmentMap, DirectionsAreThoseOfTheFormat) {
    const int width = 16, height = 8;
    const Bitmap bitmap = floatPicture(width, height, [](int x, int y) { return glm::vec3(x, y, 1); });
    const EnvironmentMap map(pictured(), &bitmap);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 found = map.radiance(directionOf(x, y, width, height));
            EXPECT_NEAR(found.x, x, 1e-9);
            EXPECT_NEAR(found.y, y, 1e-9);
        }
    // The centre column lies along +Z, the left quarter column along +X, the first row is up.
    EXPECT_NEAR(map.radiance({0, 0, 1}).x, 7.5, 1e-9);
    EXPECT_NEAR(map.radiance({1, 0, 0}).x, 3.5, 1e-9);
    EXPECT_LT(map.radiance(glm::normalize(glm::dvec3(0.01, 1, 0))).y, 0.1);
}

TEST(EnvironmentMap, RotationTurnsIt) {
    const int width = 16, height = 8;
    const Bitmap bitmap = floatPicture(width, height, [](int x, int y) { return glm::vec3(x, y, 1); });
    Environment turned = pictured();
    turned.worldFromMap = glm::dmat3(0, 0, -1, 0, 1, 0, 1, 0, 0);  // +X of the map lies along -Z
    const EnvironmentMap map(pictured(), &bitmap), other(turned, &bitmap);
    Pcg32 random(3);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 d = uniformSphere({random.uniform(), random.uniform()});
        EXPECT_NEAR(map.radiance(d).x, other.radiance(turned.worldFromMap * d).x, 1e-9);
    }
}

TEST(EnvironmentMap, IsContinuousOverSeamAndPoles) {
    const int width = 32, height = 16;
    Pcg32 noise(5);
    const Bitmap bitmap =
        floatPicture(width, height, [&](int, int) { return glm::vec3(static_cast<float>(noise.uniform())); });
    const EnvironmentMap map(pictured(), &bitmap);
    const double step = 1e-7;  // times the steepest slope, a texel, of at most 1: width / (2 pi sin(polar))
    for (int i = 0; i < 64; ++i) {
        const double polar = 0.2 + 2.7 * i / 64.0;
        EXPECT_NEAR(map.radiance({std::sin(polar) * step, std::cos(polar), -std::sin(polar)}).x,
                    map.radiance({-std::sin(polar) * step, std::cos(polar), -std::sin(polar)}).x, 1e-5);
        const double azimuth = 2.0 * kPi * i / 64.0;
        for (const double up : {1.0, -1.0})
            EXPECT_NEAR(map.radiance({step * std::sin(azimuth), up, step * std::cos(azimuth)}).x,
                        map.radiance({-step * std::sin(azimuth), up, -step * std::cos(azimuth)}).x, 1e-5);
    }
}

TEST(EnvironmentMap, DrawsHaveTheirDensity) {
    const int width = 24, height = 12;
    const Bitmap bitmap = floatPicture(width, height, [](int x, int y) {
        return glm::vec3(x == 5 && y == 3 ? 1000.0F : 0.1F + 0.05F * static_cast<float>(y));
    });
    const EnvironmentMap map(pictured(), &bitmap);
    Pcg32 random(9);
    double uniformSum = 0.0, drawnSum = 0.0, drawnSquares = 0.0;
    const int n = 200000;
    for (int i = 0; i < n; ++i) {
        const glm::dvec3 u = uniformSphere({random.uniform(), random.uniform()});
        uniformSum += map.density(u) * 4.0 * kPi / n;
        const glm::dvec3 d = map.draw(random.uniform(), random.uniform());
        EXPECT_NEAR(glm::length(d), 1.0, 1e-12);
        ASSERT_GT(map.density(d), 0.0);
        const double value = map.radiance(d).x / map.density(d);
        drawnSum += value / n;
        drawnSquares += value * value / n;
    }
    // The sum over uniform draws has the standard error of the bright texels' share of the sphere.
    EXPECT_NEAR(uniformSum, 1.0, 0.1);
    // The whole light, texel by texel: bilinear weights of a texel over the sphere, by fine quadrature.
    double exact = 0.0;
    const int fine = 24;
    for (int y = 0; y < height * fine; ++y)
        for (int x = 0; x < width * fine; ++x) {
            const glm::dvec3 d = directionOf((x + 0.5) / fine - 0.5, (y + 0.5) / fine - 0.5, width, height);
            const double top = std::cos(kPi * y / (height * fine)),
                         bottom = std::cos(kPi * (y + 1) / (height * fine));
            exact += map.radiance(d).x * (top - bottom) * 2.0 * kPi / (width * fine);
        }
    const double error = std::sqrt((drawnSquares - drawnSum * drawnSum) / n);
    EXPECT_NEAR(drawnSum, exact, 5.0 * error + 1e-3 * exact);
    EXPECT_LT(error, 0.005 * exact);  // what drawing by brightness is for
}

TEST(EnvironmentMap, BadTexelsAreCountedAndBlack) {
    const float infinity = std::numeric_limits<float>::infinity(),
                nan = std::numeric_limits<float>::quiet_NaN();
    const Bitmap bitmap = floatPicture(4, 2, [&](int x, int y) {
        const float values[] = {1.0F, -1.0F, infinity, nan};
        return glm::vec3(y == 0 ? values[x] : 2.0F);
    });
    const EnvironmentMap map(pictured(), &bitmap);
    EXPECT_EQ(map.badTexels(), 3U);
    Pcg32 random(1);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 d = map.draw(random.uniform(), random.uniform());
        EXPECT_TRUE(std::isfinite(map.radiance(d).x));
        EXPECT_GE(map.radiance(d).x, 0.0);
        EXPECT_TRUE(std::isfinite(map.density(d)));
    }
}

TEST(EnvironmentMap, OneTexelAndBlack) {
    for (const float value : {0.0F, 3.0F}) {
        const Bitmap bitmap = floatPicture(1, 1, [&](int, int) { return glm::vec3(value); });
        const EnvironmentMap map(pictured(), &bitmap);
        EXPECT_DOUBLE_EQ(map.radiance({0, 1, 0}).x, double{value});
        EXPECT_NEAR(map.density(map.draw(0.3, 0.9)), 1.0 / (4.0 * kPi), 1e-12);
    }
}

}  // namespace
}  // namespace lobe
