// The sun in a picture: found wherever it is, left where it is none, and taken out without losing light.
#include "environment/sun_in_picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "math/random.hpp"
#include "math/sphere.hpp"
#include "pictures.hpp"

namespace lobe::environment {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
constexpr int kHeight = 256;

/// A dim sky with a sun whose edge is a little redder than its middle.
Bitmap sunny(const glm::dvec3& toSun, double radius, double strength) {
    return test::directionPicture(2 * kHeight, kHeight, [&](const glm::dvec3& d) {
        const glm::dvec3 sky = glm::dvec3(0.3, 0.5, 0.9) * (0.6 + 0.4 * d.y);
        const double t = std::acos(std::min(glm::dot(d, toSun), 1.0)) / radius;
        return glm::vec3(t < 1.0 ? sky + strength * glm::dvec3(1.0, 0.9 - 0.2 * t, 0.7 - 0.3 * t) : sky);
    });
}

struct Both {
    Bitmap before;
    EnvironmentMap map;
    Spot spot;
    Bitmap after;
    EnvironmentMap rest;

    explicit Both(Bitmap picture)
        : before(std::move(picture)),
          map(test::mapOf(before)),
          spot(brightestSpot(map)),
          after(withoutSpot(map, spot)),
          rest(test::mapOf(after)) {}
};

/// What the picture has lost, at points all over the cap that holds the sun.
class Lost {
public:
    explicit Lost(const Both& both) {
        const double reach = both.spot.radius + 3.0 * kPi / kHeight;
        const glm::dmat3 frame = frameAbout(both.spot.direction);
        constexpr int kRings = 150, kAround = 300;
        for (int i = 0; i < kRings; ++i) {
            const double polar = reach * (i + 0.5) / kRings;
            const double part = std::sin(polar) * (reach / kRings * 2.0 * kPi / kAround);
            for (int j = 0; j < kAround; ++j) {
                const glm::dvec3 d = frame * fromPolar(polar, 2.0 * kPi * (j + 0.5) / kAround);
                const glm::dvec3 light = (both.map.radiance(d) - both.rest.radiance(d)) * part;
                if (light != glm::dvec3(0.0)) points_.push_back({d, light});
            }
        }
    }
    glm::dvec3 irradiance(const glm::dvec3& normal) const {
        glm::dvec3 sum(0.0);
        for (const auto& [d, light] : points_)
            sum += light * std::max(glm::dot(d, normal), 0.0);
        return sum;
    }

private:
    std::vector<std::pair<glm::dvec3, glm::dvec3>> points_;
};

TEST(SunInPicture, TakenOutWithoutLosingLight) {
    Pcg32 random(3);
    std::vector<glm::dvec3> suns{{0, 1, 0},
                                 {0, 0, -1},
                                 glm::normalize(glm::dvec3(1e-3, 1, 2e-3)),
                                 glm::normalize(glm::dvec3(0.0, 0.3, -1.0))};  // poles, and on the seam
    for (int i = 0; i < 6; ++i)
        suns.push_back(uniformSphere({random.uniform(), random.uniform()}));
    for (const glm::dvec3& toSun : suns) {
        const Both both(sunny(toSun, 1.5 * kDegree, 3000.0));
        ASSERT_EQ(whyNoSun(both.spot), "") << toSun.x << ' ' << toSun.y << ' ' << toSun.z;
        EXPECT_LT(std::acos(std::min(glm::dot(both.spot.direction, toSun), 1.0)), 0.2 * kDegree);
        EXPECT_GT(both.spot.share, 0.5);
        const glm::dvec3& e = both.spot.irradiance;
        const Lost lostLight(both);
        // Facing: what differs is where the middle of each channel's light is, second order in the radius.
        const glm::dvec3 facing = lostLight.irradiance(both.spot.direction);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(facing[c], e[c], 2e-3 * e[c]);
        for (int i = 0; i < 50; ++i) {
            const glm::dvec3 n = uniformSphere({random.uniform(), random.uniform()});
            const glm::dvec3 lost = lostLight.irradiance(n);
            const double cosine = std::max(glm::dot(n, both.spot.direction), 0.0);
            for (int c = 0; c < 3; ++c)  // max(0, n.w) changes by no more than w does
                EXPECT_NEAR(lost[c], e[c] * cosine, e[c] * (both.spot.radius + 2e-3));
        }
    }
}

TEST(SunInPicture, NothingElseChanges) {
    const glm::dvec3 toSun = glm::normalize(glm::dvec3(0.3, 0.6, 0.5));
    const Both both(sunny(toSun, 1.0 * kDegree, 3000.0));
    size_t changed = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < 2 * kHeight; ++x) {
            const glm::dvec3 before = both.map.at(x, y), after = both.rest.at(x, y);
            changed += before != after ? 1 : 0;
            EXPECT_LE(after.r, before.r);
        }
    EXPECT_EQ(changed, both.spot.texels.size());
    EXPECT_TRUE(brightestSpot(both.rest).texels.empty());
}

TEST(SunInPicture, LampsAndLevelSkiesStay) {
    const auto reason = [](const Bitmap& picture) { return whyNoSun(brightestSpot(test::mapOf(picture))); };
    const Bitmap level = test::floatPicture(64, 32, [](int, int) { return glm::vec3(1.0F); });
    EXPECT_THAT(reason(level), testing::HasSubstr("no spot"));
    const Bitmap black = test::floatPicture(64, 32, [](int, int) { return glm::vec3(0.0F); });
    EXPECT_THAT(reason(black), testing::HasSubstr("no spot"));
    EXPECT_THAT(reason(test::directionPicture(512, 256, test::skyWithLamps)),
                testing::HasSubstr("no spot"));  // as wide as the ring around them
    const glm::dvec3 toLamp = glm::normalize(glm::dvec3(1, 1, 1));
    EXPECT_THAT(reason(sunny(toLamp, 3.6 * kDegree, 3000.0)), testing::HasSubstr("degrees wide"));
    EXPECT_THAT(reason(sunny(toLamp, 2.5 * kDegree, 20.0)), testing::HasSubstr("times as bright"));
    EXPECT_THAT(reason(sunny(toLamp, 1.0 * kDegree, 100.0)), testing::HasSubstr("% of its light"));
    EXPECT_EQ(whyNoSun(brightestSpot(EnvironmentMap(Environment{}, nullptr))), "no spot of it stands out");
    EXPECT_THAT(reason(test::floatPicture(1, 1, [](int, int) { return glm::vec3(1e6F); })),
                testing::HasSubstr("no spot"));
}

TEST(SunInPicture, OneBrightTexelIsTaken) {
    const Bitmap lone =
        test::floatPicture(128, 64, [](int x, int y) { return glm::vec3(x == 40 && y == 20 ? 1e6F : 0.0F); });
    const Both both{Bitmap(lone)};
    EXPECT_EQ(whyNoSun(both.spot), "");
    EXPECT_EQ(both.spot.texels.size(), 1U);
    EXPECT_NEAR(both.spot.share, 1.0, 1e-12);
    EXPECT_EQ(both.rest.relative(both.spot.direction), glm::dvec3(0.0));
}

TEST(SunInPicture, SolidAnglesAddUpToTheSphere) {
    for (const int height : {1, 2, 5, 64}) {
        const Bitmap level = test::floatPicture(2 * height, height, [](int, int) { return glm::vec3(1.0F); });
        const EnvironmentMap map = test::mapOf(level);
        double sum = 0.0;
        for (int y = 0; y < height; ++y)
            sum += solidAngleOf(map, y) * map.width();
        EXPECT_NEAR(sum, 4.0 * kPi, 1e-9) << height;
    }
}

}  // namespace
}  // namespace lobe::environment
