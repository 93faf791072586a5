// Skies: Preetham's against the paper's formulas written out once more, bounds, the sun, and what scenes make
// of them.
#include "scene/sky.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/random.hpp"
#include "scene/made_environment.hpp"

namespace lobe {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

double luminance(const glm::dvec3& rgb) {
    return 0.2126729 * rgb.r + 0.7151522 * rgb.g + 0.0721750 * rgb.b;
}

Sky clear(double turbidity, double elevation, double azimuth = 0.0) {
    Sky sky = defaultSky(SkyModel::preetham);
    sky.turbidity = turbidity;
    sky.sunElevation = elevation;
    sky.sunAzimuth = azimuth;
    return sky;
}

/// Towards an elevation, at an azimuth from +Z towards +X.
glm::dvec3 towards(double elevation, double azimuth) {
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
            std::cos(elevation) * std::cos(azimuth)};
}

/// The paper's luminance, kcd/m^2, by angles: of the direction to the zenith, of it to the sun, and of the
/// sun to the zenith.
double paperLuminance(double turbidity, double zenithAngle, double sunAngle, double sunZenith) {
    const double a = 0.1787 * turbidity - 1.4630, b = -0.3554 * turbidity + 0.4275;
    const double c = -0.0227 * turbidity + 5.3251, d = 0.1206 * turbidity - 2.5771;
    const double e = -0.0670 * turbidity + 0.3703;
    const auto perez = [&](double theta, double gamma) {
        return (1.0 + a * std::exp(b / std::cos(theta))) *
               (1.0 + c * std::exp(d * gamma) + e * std::pow(std::cos(gamma), 2.0));
    };
    const double chi = (4.0 / 9.0 - turbidity / 120.0) * (kPi - 2.0 * sunZenith);
    const double zenith = (4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192;
    return zenith * perez(zenithAngle, sunAngle) / perez(0.0, sunZenith);
}

TEST(Sky, PreethamsLuminanceIsThePapers) {
    Pcg32 random(1);
    for (int i = 0; i < 2000; ++i) {
        const double turbidity = 1.7 + 8.3 * random.uniform(), elevation = kPi / 2.0 * random.uniform();
        const double azimuth = 2.0 * kPi * random.uniform();
        const SkyRadiance sky(clear(turbidity, elevation, azimuth));
        const double height = 0.01 + (kPi / 2.0 - 0.01) * random.uniform(),
                     side = 2.0 * kPi * random.uniform();
        const double gamma =
            std::acos(std::clamp(std::sin(height) * std::sin(elevation) +
                                     std::cos(height) * std::cos(elevation) * std::cos(side - azimuth),
                                 -1.0, 1.0));
        const double expected =
            1000.0 * paperLuminance(turbidity, kPi / 2.0 - height, gamma, kPi / 2.0 - elevation) / 179.0;
        // The coefficients of luminance and of linear sRGB are rounded to seven digits; acos loses half of
        // its digits near 1.
        EXPECT_NEAR(luminance(sky.at(towards(height, side))), expected, 2e-6 * expected)
            << turbidity << ' ' << elevation << ' ' << height << ' ' << side;
    }
}

TEST(Sky, TheZenithsColourIsThePapers) {
    const double t = 3.0, s = 60.0 * kDegree;
    const double x = t * t * (0.00166 * s * s * s - 0.00375 * s * s + 0.00209 * s) +
                     t * (-0.02903 * s * s * s + 0.06377 * s * s - 0.03202 * s + 0.00394) +
                     0.11693 * s * s * s - 0.21196 * s * s + 0.06052 * s + 0.25886;
    const double y = t * t * (0.00275 * s * s * s - 0.00610 * s * s + 0.00317 * s) +
                     t * (-0.04214 * s * s * s + 0.08970 * s * s - 0.04153 * s + 0.00516) +
                     0.15346 * s * s * s - 0.26756 * s * s + 0.06670 * s + 0.26688;
    const glm::dvec3 rgb = SkyRadiance(clear(t, 30.0 * kDegree)).at({0.0, 1.0, 0.0});
    const glm::dvec3 xyz(0.4124564 * rgb.r + 0.3575761 * rgb.g + 0.1804375 * rgb.b, luminance(rgb),
                         0.0193339 * rgb.r + 0.1191920 * rgb.g + 0.9503041 * rgb.b);
    const double sum = xyz.x + xyz.y + xyz.z;
    EXPECT_NEAR(xyz.x / sum, x, 1e-5);
    EXPECT_NEAR(xyz.y / sum, y, 1e-5);
    EXPECT_GT(rgb.b, rgb.r);
}

TEST(Sky, IsFiniteAndNeverNegative) {
    for (const double turbidity : {1.7, 2.0, 3.0, 6.0, 10.0})
        for (const double elevation : {0.0, 1e-12, 1.0 * kDegree, 20.0 * kDegree, kPi / 2.0}) {
            const SkyRadiance sky(clear(turbidity, elevation));
            for (int i = -90; i <= 90; ++i)
                for (int j = 0; j < 360; j += 5) {
                    const glm::dvec3 rgb = sky.at(towards(i * kDegree, j * kDegree));
                    for (int c = 0; c < 3; ++c) {
                        ASSERT_TRUE(std::isfinite(rgb[c])) << turbidity << ' ' << elevation << ' ' << i;
                        ASSERT_GE(rgb[c], 0.0);
                        ASSERT_LT(rgb[c], 1e5);
                    }
                }
            for (int c = 0; c < 3; ++c) {
                ASSERT_TRUE(std::isfinite(sky.sun()[c]));
                ASSERT_GE(sky.sun()[c], 0.0);
            }
            const glm::dvec3 exactly = sky.at({1.0, 0.0, 0.0}), zero = sky.at({1.0, -0.0, 0.0});
            EXPECT_TRUE(std::isfinite(exactly.r) && std::isfinite(zero.r));
        }
}

TEST(Sky, TheGroundIsLitBySkyAndSun) {
    Sky described = clear(3.0, 40.0 * kDegree);
    described.ground = {0.1, 0.2, 0.3};
    const SkyRadiance sky(described);
    // Another quadrature: by rings of elevation.
    glm::dvec3 sum(0.0);
    constexpr int kRings = 400;
    for (int i = 0; i < kRings; ++i) {
        const double elevation = kPi / 2.0 * (i + 0.5) / kRings;
        for (int j = 0; j < 2 * kRings; ++j)
            sum += sky.at(towards(elevation, kPi * (j + 0.5) / kRings)) * std::sin(elevation) *
                   std::cos(elevation) * (kPi / 2.0 / kRings) * (kPi / kRings);
    }
    sum += sky.sun() * std::sin(40.0 * kDegree);
    const glm::dvec3 below = sky.at({0.6, -0.8, 0.0});
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(below[c], described.ground[c] * sum[c] / kPi, 1e-3 * below[c]);
}

TEST(Sky, TheSunIsAsBrightAsMeasuredAndReddensTowardsTheHorizon) {
    // Direct normal illuminance of a clear day: some 100 klx overhead; the sun outside the atmosphere has
    // 128.
    const double overhead = 179.0 * luminance(sunIrradiance(2.0, kPi / 2.0));
    EXPECT_GT(overhead, 90e3);
    EXPECT_LT(overhead, 120e3);
    double last = HUGE_VAL, lastRed = 0.0;
    for (const double elevation : {90.0, 60.0, 30.0, 10.0, 3.0, 0.0}) {
        const glm::dvec3 sun = sunIrradiance(3.0, elevation * kDegree);
        EXPECT_LT(luminance(sun), last);
        EXPECT_GT(sun.r / sun.g, lastRed);
        last = luminance(sun);
        lastRed = sun.r / sun.g;
    }
    EXPECT_LT(luminance(sunIrradiance(8.0, 1.0)), luminance(sunIrradiance(2.0, 1.0)));
}

TEST(Sky, GamutKeepsLuminance) {
    Pcg32 random(5);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 rgb(2.0 * random.uniform() - 0.3, 2.0 * random.uniform() - 0.1,
                             2.0 * random.uniform() - 0.5);
        const glm::dvec3 inside = insideGamut(rgb);
        EXPECT_GE(std::min({inside.r, inside.g, inside.b}), 0.0);
        if (luminance(rgb) > 0.0) {
            EXPECT_NEAR(luminance(inside), luminance(rgb), 2e-7);  // its weights add up to 1 + 1e-7
        }
    }
    EXPECT_EQ(insideGamut({-1.0, -1.0, -1.0}), glm::dvec3(0.0));
}

TEST(Sky, GradientGoesByTheSineOfElevation) {
    Sky described = defaultSky(SkyModel::gradient);
    const SkyRadiance sky(described);
    EXPECT_EQ(sky.at({0, 1, 0}), described.zenith);
    EXPECT_EQ(sky.at({0, -1, 0}), described.ground);
    EXPECT_EQ(sky.at({1, 0, 0}), described.horizon);
    const glm::dvec3 half = sky.at({0.0, 0.5, std::sqrt(0.75)});
    EXPECT_NEAR(half.r, 0.5 * (described.horizon.r + described.zenith.r), 1e-12);
    EXPECT_EQ(sky.sun(), glm::dvec3(0.0));
}

Scene under(const Sky& sky) {
    Scene scene;
    scene.environment = Environment{};
    scene.environment->source.sky = sky;
    makeEnvironment(scene);
    return scene;
}

double facingIrradiance(const Light& sun) {
    if (sun.type == LightType::directional) return sun.intensity.g;
    const double distance2 = glm::dot(sun.position, sun.position);  // the scene is empty, about the origin
    return sun.intensity.g * kPi * sun.radius * sun.radius / (distance2 + sun.radius * sun.radius);
}

TEST(MadeEnvironment, TheSunIsALightOfTheSameIrradianceWhateverItsSize) {
    for (const double diameter : {0.0, kSunDiameter, 0.1}) {
        Sky sky = clear(3.0, 50.0 * kDegree, 30.0 * kDegree);
        sky.sunDiameter = diameter;
        const Scene scene = under(sky);
        ASSERT_EQ(scene.environment->sun, 0);
        const Light& sun = scene.lights.at(0);
        EXPECT_EQ(sun.type, diameter > 0.0 ? LightType::disk : LightType::directional);
        EXPECT_NEAR(facingIrradiance(sun), SkyRadiance(sky).sun().g, 1e-9 * SkyRadiance(sky).sun().g);
        EXPECT_LT(glm::length(sun.direction + towards(50.0 * kDegree, 30.0 * kDegree)), 1e-12);
        if (diameter > 0.0) {
            EXPECT_NEAR(2.0 * std::atan(sun.radius / glm::length(sun.position)), diameter, 1e-12);
            EXPECT_NEAR(glm::dot(sun.axis, sun.direction), 0.0, 1e-12);
        }
        EXPECT_GE(scene.environment->image, 0);
        EXPECT_GE(scene.environment->backgroundImage, 0);
        EXPECT_THAT(scene.environment->notes, testing::ElementsAre(testing::HasSubstr("turbidity 3")));
    }
}

TEST(MadeEnvironment, SunTurnsScalesAndGoesWithIt) {
    Scene scene = under(clear(3.0, 30.0 * kDegree, 0.0));
    scene.lights.insert(scene.lights.begin() + 1, Light{});
    const glm::dvec3 radiance = scene.lights[0].intensity;
    turnEnvironment(scene, 90.0 * kDegree);  // +Z to +X
    EXPECT_LT(glm::length(scene.lights[0].direction + towards(30.0 * kDegree, 90.0 * kDegree)), 1e-12);
    EXPECT_LT(glm::length(glm::normalize(scene.lights[0].position) + scene.lights[0].direction), 1e-12);
    EXPECT_LT(glm::length(scene.environment->worldFromMap * glm::dvec3(0, 0, 1) - glm::dvec3(1, 0, 0)),
              1e-12);
    scaleEnvironment(scene, 0.25);
    EXPECT_EQ(scene.lights[0].intensity, 0.25 * radiance);
    EXPECT_EQ(scene.environment->intensity, 0.25);
    removeEnvironment(scene);
    EXPECT_FALSE(scene.environment);
    ASSERT_EQ(scene.lights.size(), 1U);
    EXPECT_EQ(scene.lights[0].type, LightType::point);
}

TEST(MadeEnvironment, ConstantNeedsNoPicture) {
    Sky sky = defaultSky(SkyModel::constant);
    sky.zenith = {1, 2, 3};
    const Scene scene = under(sky);
    EXPECT_EQ(scene.environment->image, -1);
    EXPECT_EQ(scene.environment->radiance, glm::dvec3(1, 2, 3));
    EXPECT_TRUE(scene.images.empty());
    EXPECT_TRUE(scene.lights.empty());
}

}  // namespace
}  // namespace lobe
