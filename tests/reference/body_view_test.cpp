#include "reference/body_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "math/cubature.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"

namespace lobe::reference {
namespace {

constexpr double kPi = std::numbers::pi;

Light lightOf(LightType type, const glm::dvec3& position, const glm::dvec3& direction = {0, 0, -1}) {
    Light light;
    light.type = type;
    light.position = position;
    light.direction = glm::normalize(direction);
    light.axis = frameAbout(light.direction)[0];
    light.width = 1.5;
    light.height = 0.7;
    light.radius = 0.6;
    light.length = 1.8;
    return light;
}

/// The integral of max(cos, 0) about `normal` over the light as the origin sees it, by its maps.
CubatureResult irradiance(const Light& light, const glm::dvec3& normal, double relativeError = 1e-8,
                          int cells = 4) {
    const BodyView view(light, glm::dvec3(0.0));
    CubatureResult sum;
    sum.converged = true;
    for (int patch = 0; patch < view.patches(); ++patch) {
        CubatureOptions options;
        options.relativeError = relativeError;
        options.cells = cells;
        const CubatureResult one = integrateSquare(
            [&](double u, double v) {
                const BodySample sample = view.at(patch, u, v);
                return glm::dvec3(std::max(0.0, glm::dot(sample.direction, normal)) * sample.solidAngle);
            },
            options);
        sum.integral += one.integral;
        sum.converged &= one.converged;
        sum.evaluations += one.evaluations;
    }
    return sum;
}

/// Lambert's formula, of a polygon above the horizon.
double polygonIrradiance(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal) {
    double sum = 0.0;
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(corners[i]),
                         b = glm::normalize(corners[(i + 1) % corners.size()]);
        const glm::dvec3 edge = glm::cross(a, b);
        const double sine = glm::length(edge);
        if (sine > 0.0) sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(edge / sine, normal);
    }
    return std::abs(sum) / 2;
}

std::vector<glm::dvec3> cornersOf(const Light& light) {
    const glm::dvec3 x = light.axis * light.width * 0.5;
    const glm::dvec3 y = glm::cross(light.direction, light.axis) * light.height * 0.5;
    return {light.position - x - y, light.position + x - y, light.position + x + y, light.position - x + y};
}

TEST(BodyView, RectLightsAsLambertSays) {
    Pcg32 random(1);
    int compared = 0;
    for (int i = 0; i < 200; ++i) {
        const double distance = random.logUniform(0.05, 500.0);
        const glm::dvec3 towards = uniformHemisphere({random.uniform(), random.uniform()});
        Light light = lightOf(LightType::rect, towards * distance,
                              -towards + 0.9 * uniformSphere({random.uniform(), random.uniform()}));
        const glm::dvec3 normal(0, 0, 1);
        bool above = true;
        for (const glm::dvec3& corner : cornersOf(light))
            above &= corner.z > 0.0;
        if (!above || BodyView(light, glm::dvec3(0.0)).patches() == 0) continue;
        ++compared;
        const CubatureResult result = irradiance(light, normal);
        EXPECT_TRUE(result.converged);
        // Lambert's sum itself cancels: about 1e-16 over the solid angle.
        const double exact = polygonIrradiance(cornersOf(light), normal);
        EXPECT_NEAR(result.integral.x, exact, 1e-7 * exact + 1e-14) << i << " at " << distance;
    }
    EXPECT_GT(compared, 50);
}

/// A sphere partly below the horizon or not (Snyder 1996): c = cosine of its centre, s2 = sine squared of its
/// angular radius.
double sphereIrradiance(double c, double s2) {
    if (c * c > s2) return kPi * s2 * std::max(c, 0.0);
    const double st = std::sqrt(1.0 - c * c), x = std::sqrt(1.0 / s2 - 1.0), y = -x * c / st;
    const double q = st * std::sqrt(1.0 - y * y);
    return s2 * (c * std::acos(y) - x * q) + std::atan(q / x);
}

TEST(BodyView, SphereLightsAsItsFormulaSays) {
    for (const double distance : {0.61, 0.7, 1.0, 3.0, 100.0, 1e6})
        for (const double polar : {0.0, 0.5, 1.2, 1.5, 1.6, 2.0}) {
            const glm::dvec3 towards = fromPolar(polar, 0.3);
            const CubatureResult result =
                irradiance(lightOf(LightType::sphere, towards * distance), {0, 0, 1}, 1e-8, 16);
            const double exact = sphereIrradiance(towards.z, 0.36 / (distance * distance));
            EXPECT_NEAR(result.integral.x, exact, 1e-6 * exact) << distance << " " << polar;
        }
}

TEST(BodyView, DiskLightsAsItsFormulaSays) {
    for (const double height : {1e-3, 0.1, 1.0, 30.0})
        for (const double offset : {0.0, 0.3, 0.599, 0.601, 2.0, 50.0}) {
            const Light light = lightOf(LightType::disk, {offset, 0.0, height});
            const double r = light.radius, h2 = height * height, a2 = offset * offset, r2 = r * r;
            // pi times the form factor from an element to a parallel disk. Its difference cancels where the
            // disk is small and far: taken as a quotient.
            const double root = std::sqrt((h2 + a2 + r2) * (h2 + a2 + r2) - 4.0 * r2 * a2);
            const double exact = h2 + a2 > r2 ? kPi * 0.5 * 4.0 * r2 * h2 / (root * (root + h2 + a2 - r2))
                                              : kPi * 0.5 * (1.0 + (r2 - h2 - a2) / root);
            const CubatureResult result = irradiance(light, {0, 0, 1}, 1e-8);
            EXPECT_TRUE(result.converged) << height << " " << offset;
            EXPECT_NEAR(result.integral.x, exact, 1e-6 * exact) << height << " " << offset;
        }
}

TEST(BodyView, ThinTubeLightsAsALineDoes) {
    Light light = lightOf(LightType::tube, {0.4, 0.2, 2.0});
    light.axis = {1, 0, 0};
    light.radius = 1e-4;
    // The integral over the line of cos(surface) sin(line) / d^2, times the width that is seen.
    const int n = 20000;
    double line = 0.0;
    for (int i = 0; i < n; ++i) {
        const glm::dvec3 p(0.4 + ((i + 0.5) / n - 0.5) * light.length, 0.2, 2.0);
        const double d2 = glm::dot(p, p), d = std::sqrt(d2);
        line += p.z / d * std::sqrt(1.0 - p.x * p.x / d2) / d2;
    }
    line *= light.length / n * 2.0 * light.radius;
    const double caps = 2.0 * kPi * light.radius * light.radius;  // at most
    EXPECT_NEAR(irradiance(light, {0, 0, 1}).integral.x, line, 1e-6 * line + caps);
}

TEST(BodyView, ShortTubeLightsAsASphereDoes) {
    Light tube = lightOf(LightType::tube, {0.4, 0.2, 1.3});
    tube.length = 1e-9;
    Light sphere = tube;
    sphere.type = LightType::sphere;
    const double exact = irradiance(sphere, {0, 0, 1}).integral.x;
    EXPECT_NEAR(irradiance(tube, {0, 0, 1}, 1e-6).integral.x, exact, 1e-5 * exact);
}

/// Draws, densities, maps and hits of one light tell the same story.
void expectConsistent(const Light& light, const std::string& what) {
    const BodyView view(light, glm::dvec3(0.0));
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.2, -0.1, 1.0));
    const double exact = irradiance(light, normal, 1e-6).integral.x;
    Pcg32 random(7);
    const int n = 20000;
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < n; ++i) {
        const BodySample s = view.draw(random.uniform(), random.uniform(), random.uniform());
        const double value = std::max(0.0, glm::dot(s.direction, normal)) * s.solidAngle;
        sum += value;
        squares += value * value;
        if (s.solidAngle == 0.0) continue;
        EXPECT_NEAR(glm::length(s.direction), 1.0, 1e-12);
        EXPECT_LE(std::acos(std::clamp(glm::dot(s.direction, glm::normalize(light.position)), -1.0, 1.0)),
                  view.angularRadius() + 1e-7)
            << what;
        const auto hit = view.distanceAlong(s.direction);
        if (!hit) continue;  // rounded past an edge: counted below
        EXPECT_NEAR(*hit, s.distance, 1e-5 * s.distance) << what;
        // Where the surface turns away, both are as good as its cosine.
        if (s.solidAngle > 1e-3 * exact) {
            EXPECT_NEAR(view.density(s.direction) * s.solidAngle, 1.0, 1e-3) << what;
        }
    }
    const double mean = sum / n, error = std::sqrt((squares / n - mean * mean) / n);
    EXPECT_NEAR(mean, exact, 5.0 * error + 1e-6 * exact) << what;
    // As many of uniform directions hit the light as its maps say.
    double hits = 0.0;
    const int m = 200000;
    for (int i = 0; i < m; ++i)
        hits += view.distanceAlong(uniformSphere({random.uniform(), random.uniform()})) ? 1.0 : 0.0;
    double solidAngle = 0.0;
    for (int patch = 0; patch < view.patches(); ++patch)
        solidAngle +=
            integrateSquare([&](double u, double v) { return glm::dvec3(view.at(patch, u, v).solidAngle); },
                            {.relativeError = 1e-6, .cells = 4})
                .integral.x;
    const double expected = m * solidAngle / (4.0 * kPi);
    EXPECT_NEAR(hits, expected, 5.0 * std::sqrt(expected) + 1.0) << what;
}

TEST(BodyView, DrawsHaveTheDensityThatIsSaid) {
    for (const LightType type : {LightType::rect, LightType::disk, LightType::sphere, LightType::tube}) {
        const std::string name = std::to_string(static_cast<int>(type));
        expectConsistent(lightOf(type, {0.3, 0.2, 1.4}, {0.1, 0.3, -1}), name + " near");
        expectConsistent(lightOf(type, {0.3, 0.2, 0.9}, {0, 0, -1}), name + " very near");
        expectConsistent(lightOf(type, {4, 2, 3}, {-1, 0.2, -0.3}), name + " away");
    }
}

TEST(BodyView, FromWithinLightComesFromEverywhere) {
    for (const LightType type : {LightType::sphere, LightType::tube}) {
        const Light light = lightOf(type, {0.1, 0.1, 0.2});
        const BodyView view(light, glm::dvec3(0.0));
        ASSERT_EQ(view.patches(), 1);
        EXPECT_NEAR(irradiance(light, {0, 0, 1}, 1e-6).integral.x, kPi, 1e-5);
        EXPECT_NEAR(view.density({0, 0, 1}), 1.0 / (4.0 * kPi), 1e-12);
        EXPECT_TRUE(view.distanceAlong({1, 0, 0}).has_value());
    }
}

TEST(BodyView, OneSidedLightsHaveABack) {
    for (const LightType type : {LightType::rect, LightType::disk}) {
        EXPECT_EQ(BodyView(lightOf(type, {0, 0, 1}, {0, 0, 1}), glm::dvec3(0.0)).patches(), 0);
        EXPECT_EQ(BodyView(lightOf(type, {1, 0, 0}, {0, 0, 1}), glm::dvec3(0.0)).patches(), 0);  // edge-on
    }
}

}  // namespace
}  // namespace lobe::reference
