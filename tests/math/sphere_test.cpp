#include "math/sphere.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "math/random.hpp"

namespace lobe {
namespace {

TEST(FrameAbout, IsOrthonormalAndRightHandedEverywhere) {
    std::vector<glm::dvec3> normals{{0, 0, 1},  {0, 0, -1},    {1, 0, 0},
                                    {0, -1, 0}, {1e-9, 0, -1}, {0, 1e-9, 1}};
    for (uint64_t i = 0; i < 500; ++i)
        normals.push_back(uniformSphere(halton2(i)));
    for (const glm::dvec3& n : normals) {
        const glm::dmat3 frame = frameAbout(n);
        const glm::dmat3 identity = glm::transpose(frame) * frame;
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                EXPECT_NEAR(identity[column][row], column == row ? 1.0 : 0.0, 1e-14);
        EXPECT_NEAR(glm::determinant(frame), 1.0, 1e-14);
        EXPECT_EQ(frame[2], n);
    }
}

TEST(FromPolar, StartsAtZAndTurnsFromXToY) {
    EXPECT_EQ(fromPolar(0.0, 1.0), glm::dvec3(0, 0, 1));
    const glm::dvec3 x = fromPolar(glm::half_pi<double>(), 0.0);
    const glm::dvec3 y = fromPolar(glm::half_pi<double>(), glm::half_pi<double>());
    EXPECT_NEAR(glm::distance(x, glm::dvec3(1, 0, 0)), 0.0, 1e-15);
    EXPECT_NEAR(glm::distance(y, glm::dvec3(0, 1, 0)), 0.0, 1e-15);
}

TEST(SphereMaps, HaveTheMomentsOfTheirDensities) {
    constexpr uint64_t kSamples = 20000;
    double sphereZ2 = 0.0, hemisphereZ = 0.0, cosineZ = 0.0, cosineX2 = 0.0;
    for (uint64_t i = 0; i < kSamples; ++i) {
        const glm::dvec2 u = halton2(i);
        const glm::dvec3 c = cosineHemisphere(u);
        sphereZ2 += std::pow(uniformSphere(u).z, 2) / kSamples;
        hemisphereZ += uniformHemisphere(u).z / kSamples;
        cosineZ += c.z / kSamples;
        cosineX2 += c.x * c.x / kSamples;
        EXPECT_NEAR(glm::length(c), 1.0, 1e-15);
        EXPECT_NEAR(glm::length(uniformSphere(u)), 1.0, 1e-15);
    }
    EXPECT_NEAR(sphereZ2, 1.0 / 3.0, 1e-3);
    EXPECT_NEAR(hemisphereZ, 0.5, 1e-3);
    EXPECT_NEAR(cosineZ, 2.0 / 3.0, 1e-3);
    EXPECT_NEAR(cosineX2, 0.25, 1e-3);
}

}  // namespace
}  // namespace lobe
