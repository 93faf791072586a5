// Pictures of skies against the radiance that they are made of.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "environment/sun_in_picture.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"
#include "pictures.hpp"
#include "scene/sky.hpp"

namespace lobe {
namespace {

constexpr double kPi = std::numbers::pi;

SkyRadiance clearSky(double elevation) {
    Sky sky = defaultSky(SkyModel::preetham);
    sky.sunElevation = elevation;
    sky.sunAzimuth = 1.0;
    return SkyRadiance(sky);
}

glm::dvec3 onGround(const EnvironmentMap& map) {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < map.height() / 2; ++y) {
        const double weight = environment::solidAngleOf(map, y) * std::cos(kPi * (y + 0.5) / map.height());
        for (int x = 0; x < map.width(); ++x)
            sum += weight * map.at(x, y);
    }
    return sum;
}

TEST(SkyPicture, HoldsTheSkysRadiance) {
    const SkyRadiance sky = clearSky(0.6);
    const Bitmap picture = skyPicture(sky, 256);
    const EnvironmentMap map = test::mapOf(picture);
    Pcg32 random(2);
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec3 d = uniformSphere({random.uniform(), random.uniform()});
        if (std::abs(d.y) < 0.02) continue;  // the horizon is a texel's width
        const glm::dvec3 expected = sky.at(d);
        // Half a texel from the middle of the aureole, whose slope is 2.2 a radian; elsewhere far less.
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(map.radiance(d)[c], expected[c], 0.01 * expected[c]);
    }
    const glm::dvec3 light = onGround(map), all = sky.onGround() - sky.sun() * std::sin(0.6);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(light[c], all[c], 2e-3 * all[c]);
}

TEST(SkyPicture, TheDiscInItHasTheSunsIrradiance) {
    constexpr double kDiameter = 0.02;
    for (const double elevation : {0.6, kPi / 2.0}) {
        const SkyRadiance sky = clearSky(elevation);
        const Bitmap with = skyPicture(sky, 512, kDiameter), without = skyPicture(sky, 512);
        const glm::dvec3 sun =
            (onGround(test::mapOf(with)) - onGround(test::mapOf(without))) / std::sin(elevation);
        // Texels near it are sums of 16 x 16 points: their edge is off by 1 in 100. Interpolation over the
        // pole gives the first row 1/24 of a texel's square more, of the disc's area of 1.33.
        const double tolerance = elevation < 1.0 ? 0.01 : 0.01 + 1.0 / 24.0 / 1.33;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sun[c], sky.sun()[c], tolerance * sky.sun()[c]);
    }
}

}  // namespace
}  // namespace lobe
