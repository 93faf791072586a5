/// Lights with a body: GLSL against the twins, from touching to far away, and the twins against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "base/thread_team.hpp"
#include "harness/evaluator.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"
#include "on_contexts.hpp"
#include "shading/area.hpp"

namespace lobe {
namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec3 direction(Pcg32& random) {
    return uniformSphere({random.uniform(), random.uniform()});
}

/// As the shader gets it.
glm::dvec3 rounded(const glm::dvec3& v) {
    return glm::dvec3(glm::vec3(v));
}

struct Case {
    glm::dvec3 center, axis, facing;
    double a = 0.0,
           b = 0.0;  ///< rect: half width, half height; disk, sphere: radius; tube: half length, radius
};

struct Kind {
    const char* name;
    const char* call;
    double (*factor)(const Case&);
};

constexpr Kind kKinds[] = {
    {"rect", "area_rect_factor(center, axis * a, cross(facing, axis) * b, facing)",
     [](const Case& c) {
         return rectFactor(c.center, c.axis * c.a, glm::cross(c.facing, c.axis) * c.b, c.facing);
     }},
    {"disk", "area_disk_factor(center, facing, a)",
     [](const Case& c) { return diskFactor(c.center, c.facing, c.a); }},
    {"sphere", "area_sphere_factor(center, a)", [](const Case& c) { return sphereFactor(c.center, c.a); }},
    {"tube", "area_tube_factor(center, axis * a, b)",
     [](const Case& c) { return tubeFactor(c.center, c.axis * c.a, c.b); }}};

class Area : public test::OnContext {
protected:
    std::vector<double> evaluate(const Kind& kind, const std::vector<Case>& cases) const {
        const harness::Evaluator evaluator(
            library(),
            {kind.name,
             {"light/area.glsl"},
             {{"vec3", "center"}, {"vec3", "axis"}, {"vec3", "facing"}, {"float", "a"}, {"float", "b"}},
             std::string("    result[0].x = ") + kind.call + ";",
             1,
             {}});
        std::vector<float> inputs;
        for (const Case& c : cases) {
            for (const glm::dvec3& v : {c.center, c.axis, c.facing})
                for (int i = 0; i < 3; ++i)
                    inputs.push_back(static_cast<float>(v[i]));
            inputs.push_back(static_cast<float>(c.a));
            inputs.push_back(static_cast<float>(c.b));
        }
        const harness::ResultTable table = evaluator.evaluate(inputs);
        std::vector<double> values;
        for (size_t i = 0; i < table.rows(); ++i)
            values.push_back(static_cast<double>(table.row(i)[0]));
        return values;
    }
};

/// The same light with the normal turned to its middle, where it is about as bright as it can be.
Case faceOn(const Kind& kind, Case c) {
    glm::dvec3 to = c.center;
    if (std::string(kind.name) == "tube") to += c.axis * std::clamp(-glm::dot(c.center, c.axis), -c.a, c.a);
    if (glm::length(to) == 0.0) return c;
    const glm::dmat3 turned = glm::transpose(frameAbout(glm::normalize(to)));
    c.center = turned * c.center;
    c.axis = turned * c.axis;
    c.facing = turned * c.facing;
    return c;
}

/// From `nearest` to 1e4 sizes away, in any orientation.
std::vector<Case> someCases(const Kind& kind, int count, double nearest, double farthest) {
    Pcg32 random(21);
    std::vector<Case> cases;
    while (static_cast<int>(cases.size()) < count) {
        Case c;
        c.facing = direction(random);
        c.axis = frameAbout(c.facing) * fromPolar(kPi / 2, random.uniform(0.0, 2.0 * kPi));
        const double size = random.logUniform(1e-3, 1e3);
        c.a = static_cast<double>(static_cast<float>(size));
        c.b = static_cast<double>(static_cast<float>(size * random.logUniform(0.03, 1.0)));
        const double distance = random.logUniform(nearest, farthest);
        const glm::dvec3 off = direction(random);
        // From the surface on.
        const glm::dvec3 inside = c.axis * (c.a * random.uniform(-1.0, 1.0)) +
                                  glm::cross(c.facing, c.axis) * (c.b * random.uniform(-1.0, 1.0));
        const std::string name = kind.name;
        if (name == "rect") c.center = -(inside + size * distance * off);
        if (name == "disk") c.center = -(0.7 * inside + size * distance * off);
        if (name == "sphere") c.center = -off * (size * (1.0 + distance));
        if (name == "tube")
            c.center = -(c.axis * (c.a * random.uniform(-1.3, 1.3)) + off * (c.b * (1.0 + distance)));
        if ((name == "rect" || name == "disk") && glm::dot(c.center, c.facing) > 0.0) c.facing = -c.facing;
        // Axes that are no longer quite unit and orthogonal: the twin gets the same.
        c.center = rounded(c.center);
        c.axis = rounded(c.axis);
        c.facing = rounded(c.facing);
        cases.push_back(c);
    }
    return cases;
}

struct Worst {
    double error = 0.0, square = 0.0;
    size_t at = 0, count = 0;
};

TEST_P(Area, FactorsAgreeWithQuadrature) {
    struct Range {
        double nearest, farthest;
        double most[4];  ///< share of the face-on factor: rect, disk, sphere, tube
    };
    constexpr Range kRanges[] = {{1e-4, 0.1, {2e-4, 2e-4, 2e-4, 3e-2}},
                                 {0.1, 2.0, {2e-4, 2e-4, 2e-4, 2e-2}},
                                 {2.0, 10.0, {2e-4, 2e-4, 2e-4, 1e-2}},
                                 {10.0, 1e4, {2e-4, 2e-4, 2e-4, 1e-3}}};
    ThreadTeam team;
    for (size_t k = 0; k < 4; ++k) {
        const Kind& kind = kKinds[k];
        for (const Range& range : kRanges) {
            const auto cases = someCases(kind, test::tableScale(150), range.nearest, range.farthest);
            // One program for both.
            std::vector<Case> both = cases;
            for (const Case& c : cases)
                both.push_back(faceOn(kind, c));
            const auto got = evaluate(kind, both);
            const std::span most = std::span(got).subspan(cases.size());
            std::vector<double> exact(cases.size());
            team.each(cases.size(), [&](size_t i) { exact[i] = kind.factor(cases[i]); });
            Worst worst;
            for (size_t i = 0; i < cases.size(); ++i) {
                ASSERT_TRUE(std::isfinite(got[i]) && got[i] >= 0.0 && got[i] <= 1.0) << kind.name << ' ' << i;
                double error = std::abs(got[i] - exact[i]);
                // What edges that nearly cancel leave over.
                if (k == 0) error = std::max(error - 1e-8, 0.0);
                error /= std::max(most[i], 1e-30);
                // Seen nearly from its edge, a flat light changes with the rounding of its plane.
                const double above = std::abs(glm::dot(cases[i].center, cases[i].facing));
                if (k < 2) error /= 1.0 + 0x1p-22 / range.most[k] * glm::length(cases[i].center) / above;
                worst.square += error * error;
                ++worst.count;
                if (error > worst.error) worst.error = error, worst.at = i;
            }
            const Case& c = cases[worst.at];
            std::printf("%s, %g to %g sizes: worst %.2e, rms %.2e of face on\n", kind.name, range.nearest,
                        range.farthest, worst.error,
                        std::sqrt(worst.square / static_cast<double>(worst.count)));
            EXPECT_LT(worst.error, range.most[k])
                << kind.name << " centre " << c.center.x << ' ' << c.center.y << ' ' << c.center.z
                << ", axis " << c.axis.x << ' ' << c.axis.y << ' ' << c.axis.z << ", facing " << c.facing.x
                << ' ' << c.facing.y << ' ' << c.facing.z << ", a " << c.a << ", b " << c.b << ": "
                << got[worst.at] << ", twin " << kind.factor(c);
        }
    }
}

/// Touching, inside, behind, edge-on, tiny, huge and far away: finite, between 0 and 1, and what each must
/// be.
TEST_P(Area, Extremes) {
    const glm::dvec3 down(0, 0, -1), x(1, 0, 0), z(0, 0, 1);
    struct Expectation {
        size_t kind;
        Case c;
        double value, tolerance;
    };
    const std::vector<Expectation> all{
        {0, {{0, 0, 1e-6}, x, down, 1.0, 1.0}, 1.0, 1e-5},  // a hair above the receiver
        {0, {{1, 0, 1e-6}, x, down, 1.0, 1.0}, 0.5, 1e-3},  // at its edge
        {0, {{0, 0, 0}, x, down, 1.0, 1.0}, 0.0, 0.0},      // in its plane: edge-on
        {0, {{0, 0, 1}, x, z, 1.0, 1.0}, 0.0, 0.0},         // from behind
        {0, {{0, 0, -1}, x, z, 1.0, 1.0}, 0.0, 0.0},        // below the horizon
        {0, {{2, 0, 0}, z, {-1, 0, 0}, 1.0, 1.0}, rectFactor({2, 0, 0}, z, {0, 1, 0}, {-1, 0, 0}), 1e-6},
        {0, {{0, 0, 1}, x, down, 1e-6, 1e-6}, 4e-12 / 3.14159265, 1e-16},
        {0, {{0, 0, 1e6}, x, down, 1e4, 1e4}, 4e-4 / 3.14159265, 4e-8},
        {0, {{0, 0, 10}, x, down, 1e4, 1e4}, 1.0, 1e-5},
        {1, {{0, 0, 1e-6}, x, down, 1.0, 0.0}, 1.0, 1e-5},
        {1, {{0, 0, 0}, x, down, 1.0, 0.0}, 0.0, 0.0},
        {1, {{0, 0, 1}, x, z, 1.0, 0.0}, 0.0, 0.0},
        {1, {{0, 0, 2}, x, down, 1.0, 0.0}, 0.2, 1e-6},  // r^2 / (r^2 + h^2)
        {1, {{2, 0, 0}, z, {-1, 0, 0}, 1.0, 0.0}, diskFactor({2, 0, 0}, {-1, 0, 0}, 1.0), 1e-6},
        {1, {{0, 0, 1}, x, down, 1e-6, 0.0}, 1e-12, 1e-17},
        {1, {{0, 0, 1e6}, x, down, 1e4, 0.0}, 1e-4, 1e-8},
        {1, {{1, 0, 1e-6}, x, down, 1.0, 0.0}, 0.5, 1e-3},
        {2, {{0, 0, 2}, x, down, 1.0, 0.0}, 0.25, 1e-6},
        {2, {{0, 0, -2}, x, down, 1.0, 0.0}, 0.0, 0.0},
        {2, {{0, 0, 0.5}, x, down, 1.0, 0.0}, 1.0, 0.0},  // inside
        {2, {{0, 0, 0}, x, down, 1.0, 0.0}, 1.0, 0.0},
        {2, {{0, 0, 1}, x, down, 1.0, 0.0}, 1.0, 1e-6},  // touching
        {2, {{0, 0, 1.000001}, x, down, 1.0, 0.0}, 1.0, 1e-4},
        {2, {{3, 0, 0}, x, down, 1.0, 0.0}, sphereFactor({3, 0, 0}, 1.0), 1e-6},
        {2, {{0, 0, 1}, x, down, 1e-6, 0.0}, 1e-12, 1e-17},
        {2, {{0, 0, 1e6}, x, down, 1e4, 0.0}, 1e-4, 1e-9},
        {3, {{0, 0, 0.5}, x, down, 1.0, 1.0}, 1.0, 0.0},
        {3, {{0, 0, 1.000001}, x, down, 1.0, 1.0}, 1.0, 2e-2},
        {3, {{0, 0, -2}, x, down, 1.0, 1.0}, 0.0, 0.0},
        {3, {{3, 0, 0}, x, down, 1.0, 1.0}, tubeFactor({3, 0, 0}, x, 1.0), 1e-4},  // along its axis
        {3, {{0, 0, 2}, x, down, 0.0, 1.0}, 0.25, 1e-4},                           // no length: a sphere
        {3, {{0, 0, 2}, x, down, 1.0, 1e-6}, tubeFactor({0, 0, 2}, x, 1e-6), 1e-10},
        {3, {{0, 0, 1e6}, x, down, 1e4, 1e2}, tubeFactor({0, 0, 1e6}, x * 1e4, 1e2), 1e-10}};
    for (size_t k = 0; k < 4; ++k) {
        std::vector<Case> cases;
        std::vector<Expectation> wanted;
        for (const Expectation& e : all)
            if (e.kind == k) cases.push_back(e.c), wanted.push_back(e);
        const auto got = evaluate(kKinds[k], cases);
        for (size_t i = 0; i < got.size(); ++i)
            EXPECT_NEAR(got[i], wanted[i].value, wanted[i].tolerance) << kKinds[k].name << ' ' << i;
    }
}

LOBE_ON_EVERY_BACKEND(Area);

TEST(AreaTwins, AgreeWithClosedForms) {
    // A disk face on; a sphere above the horizon; a rect over a corner (Siegel and Howell, C-13 and C-11).
    EXPECT_NEAR(diskFactor({0, 0, 2}, {0, 0, -1}, 1.5), 2.25 / 6.25, 1e-9);
    EXPECT_NEAR(sphereFactor({1, 0, 3}, 0.7), 0.49 / 10.0 * 3.0 / std::sqrt(10.0), 1e-9);
    const double a = 0.6, b = 0.9, c = 1.1;
    const double x = a / c, y = b / c, sx = std::sqrt(1 + x * x), sy = std::sqrt(1 + y * y);
    const double corner = (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy)) / (2 * kPi);
    EXPECT_NEAR(rectFactor({a / 2, b / 2, c}, {a / 2, 0, 0}, {0, b / 2, 0}, {0, 0, -1}), corner, 1e-9);
    // A tube without length is a sphere; two halves of a rect are the rect, wherever the horizon cuts them.
    EXPECT_NEAR(tubeFactor({1, 0.5, 2}, {1e-9, 0, 0}, 0.4), sphereFactor({1, 0.5, 2}, 0.4), 1e-7);
    const glm::dvec3 u = glm::normalize(glm::dvec3(0.2, 0.1, 1.0)),
                     facing = glm::normalize(glm::cross(u, {0, 1, 0}));
    const glm::dvec3 v = glm::cross(facing, u), center = -1.5 * facing;
    EXPECT_NEAR(
        rectFactor(center, u, v, facing),
        rectFactor(center + 0.5 * u, 0.5 * u, v, facing) + rectFactor(center - 0.5 * u, 0.5 * u, v, facing),
        1e-8);
    EXPECT_EQ(sphereFactor({0, 0, 0.5}, 1.0), 1.0);
    EXPECT_EQ(rectFactor({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 0.0);
}

}  // namespace
}  // namespace lobe
