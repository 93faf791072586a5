/// Lights with a body: GLSL against the twins, from touching to far away, and the twins against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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

/// The factor of the light if it were face on, or 1e-30: what errors are measured by.
using Factor = double (*)(const glm::dvec3&, const glm::dvec3&, double, double);

struct Case {
    glm::dvec3 center, axis, facing;
    double a = 0.0, b = 0.0;  ///< rect: half width, half height; disk, sphere: radius; tube: half length, radius
};

struct Kind {
    const char* name;
    const char* call;
    double (*factor)(const Case&);
};

constexpr Kind kKinds[] = {
    {"rect", "area_rect_factor(center, axis * a, cross(facing, axis) * b, facing)",
     [](const Case& c) { return rectFactor(c.center, c.axis * c.a, glm::cross(c.facing, c.axis) * c.b, c.facing); }},
    {"disk", "area_disk_factor(center, facing, a)",
     [](const Case& c) { return diskFactor(c.center, c.facing, c.a); }},
    {"sphere", "area_sphere_factor(center, a)", [](const Case& c) { return sphereFactor(c.center, c.a); }},
    {"tube", "area_tube_factor(center, axis * a, b)",
     [](const Case& c) { return tubeFactor(c.center, c.axis * c.a, c.b); }}};

class Area : public test::OnContext {
protected:
    std::vector<double> evaluate(const Kind& kind, const std::vector<Case>& cases) const {
        const harness::Evaluator evaluator(
            library(), {kind.name,
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

/// The same light where it is brightest: the normal turned to its middle.
double faceOn(const Kind& kind, Case c) {
    glm::dvec3 to = c.center;
    if (std::string(kind.name) == "tube") {
        const double along = -glm::dot(c.center, c.axis);
        to += c.axis * std::clamp(along, -c.a, c.a);
    }
    if (glm::length(to) == 0.0) return 1.0;
    const glm::dmat3 turned = glm::transpose(frameAbout(glm::normalize(to)));
    c.center = turned * c.center;
    c.axis = turned * c.axis;
    c.facing = turned * c.facing;
    return std::max(kind.factor(c), 1e-30);
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
        const glm::dvec3 inside =
            c.axis * (c.a * random.uniform(-1.0, 1.0)) + glm::cross(c.facing, c.axis) * (c.b * random.uniform(-1.0, 1.0));
        const std::string name = kind.name;
        if (name == "rect") c.center = -(inside + size * distance * off);
        if (name == "disk") c.center = -(0.7 * inside + size * distance * off);
        if (name == "sphere") c.center = -off * (size * (1.0 + distance));
        if (name == "tube") c.center = -(c.axis * (c.a * random.uniform(-1.3, 1.3)) + off * (c.b * (1.0 + distance)));
        if ((name == "rect" || name == "disk") && glm::dot(c.center, c.facing) > 0.0) c.facing = -c.facing;
        c.center = rounded(c.center);
        // To float precision the axes are no longer quite orthogonal and unit; no harm to either side's formula.
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
                                 {0.1, 2.0, {2e-4, 2e-4, 2e-4, 1e-2}},
                                 {2.0, 10.0, {2e-4, 2e-4, 2e-4, 3e-3}},
                                 {10.0, 1e4, {2e-4, 2e-4, 2e-4, 1e-3}}};
    for (size_t k = 0; k < 4; ++k) {
        const Kind& kind = kKinds[k];
        for (const Range& range : kRanges) {
            const auto cases = someCases(kind, test::tableScale(1500), range.nearest, range.farthest);
            const auto got = evaluate(kind, cases);
            Worst worst;
            for (size_t i = 0; i < cases.size(); ++i) {
                ASSERT_TRUE(std::isfinite(got[i]) && got[i] >= 0.0 && got[i] <= 1.0) << kind.name << ' ' << i;
                const double error = std::abs(got[i] - kind.factor(cases[i])) / faceOn(kind, cases[i]);
                worst.square += error * error;
                ++worst.count;
                if (error > worst.error) worst.error = error, worst.at = i;
            }
            const Case& c = cases[worst.at];
            std::printf("%s, %g to %g sizes: worst %.2e, rms %.2e of face on\n", kind.name, range.nearest,
                        range.farthest, worst.error, std::sqrt(worst.square / static_cast<double>(worst.count)));
            EXPECT_LT(worst.error, range.most[k])
                << kind.name << " centre " << c.center.x << ' ' << c.center.y << ' ' << c.center.z << ", axis "
                << c.axis.x << ' ' << c.axis.y << ' ' << c.axis.z << ", facing " << c.facing.x << ' ' << c.facing.y
                << ' ' << c.facing.z << ", a " << c.a << ", b " << c.b << ": " << got[worst.at] << ", twin "
                << kind.factor(c);
        }
    }
}

LOBE_ON_EVERY_BACKEND(Area);

}  // namespace
}  // namespace lobe
