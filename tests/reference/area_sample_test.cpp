/// Points on lights with a body: GLSL against the reference's view of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/resources.hpp"
#include "gl/context.hpp"
#include "harness/evaluator.hpp"
#include "math/cubature.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"
#include "reference/body_view.hpp"

namespace lobe::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSide = 48;  ///< points along each side of the square

gl::Context& context() {
    static const std::unique_ptr<gl::Context> one = gl::Context::create({.backend = gl::Backend::egl});
    return *one;
}

struct Kind {
    LightType type;
    const char* sample;
};

constexpr Kind kKinds[] = {
    {LightType::rect, "area_rect_sample(area_rect_view(center, facing, axis, a, b), u)"},
    {LightType::disk, "area_disk_sample(area_disk_view(center, facing, b), u)"},
    {LightType::sphere, "area_sphere_sample(area_sphere_view(center, b), u)"},
    {LightType::tube, "area_tube_sample(area_tube_view(center, axis * a, b), u)"}};

Light lightOf(LightType type, Pcg32& random, double distance) {
    Light light;
    light.type = type;
    light.direction = uniformSphere({random.uniform(), random.uniform()});
    light.axis = frameAbout(light.direction) * fromPolar(kPi / 2, random.uniform(0.0, 2.0 * kPi));
    const double size = random.logUniform(1e-2, 1e2);
    light.width = 2.0 * size;
    light.radius = size * random.logUniform(0.05, 1.0);
    light.height = 2.0 * light.radius;
    light.length = 2.0 * size;
    const glm::dvec3 off = uniformSphere({random.uniform(), random.uniform()});
    const double reach = type == LightType::rect || type == LightType::tube ? size : light.radius;
    const bool flat = type == LightType::rect || type == LightType::disk;
    light.position = -off * ((flat ? 0.0 : light.radius) + reach * distance);
    if (type == LightType::tube || type == LightType::rect)
        light.position -= light.axis * (size * random.uniform(-1.0, 1.0));
    if (flat && glm::dot(light.position, light.direction) > 0.0) light.direction = -light.direction;
    light.position = glm::dvec3(glm::vec3(light.position));
    return light;
}

/// Solid angle, and the integral of the direction over it.
glm::dvec4 integrals(const BodyView& view) {
    CubatureOptions options;
    options.relativeError = 1e-7;
    options.cells = 4;
    options.evaluations = 200000;
    glm::dvec4 sum(0.0);
    for (int patch = 0; patch < view.patches(); ++patch) {
        sum += glm::dvec4(
            integrateSquare([&](double u, double v) { return glm::dvec3(view.at(patch, u, v).solidAngle); },
                            options)
                .integral.x,
            0.0, 0.0, 0.0);
        const glm::dvec3 d = integrateSquare(
                                 [&](double u, double v) {
                                     const BodySample s = view.at(patch, u, v);
                                     return s.direction * s.solidAngle;
                                 },
                                 options)
                                 .integral;
        sum += glm::dvec4(0.0, d);
    }
    return sum;
}

class AreaSample : public testing::TestWithParam<Kind> {};

/// A grid's mean of the solid angles is the light's, and each point is on it. What the grid itself errs by is
/// known from a grid of half its points a side.
TEST_P(AreaSample, AddsUpToTheLight) {
    const Kind kind = GetParam();
    context().makeCurrent();
    const harness::Evaluator evaluator(
        gl::ShaderLibrary(shaderDirectory()),
        {"sample",
         {"light/area_sample.glsl"},
         {{"vec3", "center"},
          {"vec3", "axis"},
          {"vec3", "facing"},
          {"float", "a"},
          {"float", "b"},
          {"vec2", "u"}},
         std::string("    AreaSample s = ") + kind.sample +
             ";\n    result[0] = vec4(s.direction, s.distance);\n    result[1].x = s.solid_angle;",
         2,
         {}});
    Pcg32 random(5);
    double worstSum = 0.0, worstDistance = 0.0, worstMiss = 0.0, spread = 0.0;
    constexpr int kCases = 120;
    for (int i = 0; i < kCases; ++i) {
        const Light light = lightOf(kind.type, random, random.logUniform(0.02, 1e4));
        const BodyView view(light, glm::dvec3(0.0));
        std::vector<float> inputs;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                for (const glm::dvec3& v : {light.position, light.axis, light.direction})
                    for (int c = 0; c < 3; ++c)
                        inputs.push_back(static_cast<float>(v[c]));
                inputs.insert(
                    inputs.end(),
                    {static_cast<float>(light.width / 2), static_cast<float>(light.radius),
                     (static_cast<float>(x) + 0.5f) / kSide, (static_cast<float>(y) + 0.5f) / kSide});
            }
        const harness::ResultTable table = evaluator.evaluate(inputs);
        glm::dvec4 mean(0.0), coarse(0.0);
        double squares = 0.0;
        for (size_t r = 0; r < table.rows(); ++r) {
            const auto row = table.row(r);
            const glm::dvec3 d(row[0], row[1], row[2]);
            const double solidAngle = static_cast<double>(row[4]), distance = static_cast<double>(row[3]);
            ASSERT_TRUE(std::isfinite(solidAngle) && solidAngle >= 0.0 && std::isfinite(distance) &&
                        distance >= 0.0);
            ASSERT_NEAR(glm::length(d), 1.0, 2e-6);
            mean += glm::dvec4(1.0, d) * solidAngle;
            squares += solidAngle * solidAngle;
            // On the light: towards it by a little, so that the edge's rounding does not count.
            const glm::dvec3 target = distance * d;
            double miss = 0.0;
            switch (kind.type) {
                case LightType::rect:
                case LightType::disk: {
                    const glm::dvec3 o = target - light.position;
                    miss = std::abs(glm::dot(o, light.direction));
                    const glm::dvec3 side = glm::cross(light.direction, light.axis);
                    miss = std::max(miss, kind.type == LightType::disk
                                              ? glm::length(o) - light.radius
                                              : std::max(std::abs(glm::dot(o, light.axis)) - light.width / 2,
                                                         std::abs(glm::dot(o, side)) - light.height / 2));
                    break;
                }
                case LightType::sphere:
                    miss = std::abs(glm::length(target - light.position) - light.radius);
                    break;
                default: {
                    const glm::dvec3 o = target - light.position;
                    const double along =
                        std::clamp(glm::dot(o, light.axis), -light.length / 2, light.length / 2);
                    miss = std::abs(glm::length(o - along * light.axis) - light.radius);
                }
            }
            // From inside a tube nothing is in the way.
            if (kind.type == LightType::tube && distance == 0.0) continue;
            worstMiss = std::max(worstMiss, miss / (glm::length(light.position) + light.radius));
            if (const auto exact = view.distanceAlong(glm::normalize(d)); exact && *exact < distance * 10.0)
                worstDistance =
                    std::max(worstDistance, std::abs(distance - *exact) / glm::length(light.position));
        }
        const double n = static_cast<double>(table.rows());
        mean /= n;
        spread = std::max(spread, std::sqrt(std::max(0.0, squares / n - mean.x * mean.x)) / mean.x);
        const glm::dvec4 exact = integrals(view);
        const double error = glm::length(mean - exact) / exact.x;
        if (error > worstSum) {
            worstSum = error;
            std::printf("  case %d: error %.2e, solid angle %g of %g, distance %g, size %g %g\n", i, error,
                        mean.x, exact.x, glm::length(light.position), light.width, light.radius);
        }
    }
    std::printf("sums %.2e, off the light %.2e and distance %.2e of the distance, spread of weights %.2f\n",
                worstSum, worstMiss, worstDistance, spread);
    EXPECT_LT(worstSum, 2e-3);
    EXPECT_LT(worstMiss, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Types, AreaSample, testing::ValuesIn(kKinds));

}  // namespace
}  // namespace lobe::reference
