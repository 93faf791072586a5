/// Lobes over polygons: the sum about the boundary against brute quadrature over directions, and the GLSL
/// against it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/gtc/constants.hpp>

#include "fit/transformed_lobe.hpp"
#include "harness/evaluator.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"
#include "shading/on_contexts.hpp"

namespace lobe::fit {
namespace {

struct Case {
    TransformedLobe lobe;
    glm::dvec3 wo, center, u, v;

    std::vector<glm::dvec3> polygon() const {
        return {center + u + v, center - u + v, center - u - v, center + u - v};
    }
};

glm::dvec3 asFloats(const glm::dvec3& v) {
    return glm::dvec3(glm::vec3(v));
}

double asFloat(double x) {
    return double(static_cast<float>(x));
}

/// Lobes as fits have them, from round to grazing, and rects about them: some below the horizon in part.
Case randomCase(Pcg32& random, bool cosine) {
    Case c;
    const double width = random.logUniform(3e-3, 1.0);
    c.lobe.k = asFloat(cosine ? 1.0 : random.logUniform(1.0, 128.0));
    const double scale = std::sqrt(2.0 / (c.lobe.k + 3.0)) / width;
    c.lobe.a = asFloat(scale * random.logUniform(0.5, 2.0));
    c.lobe.c = asFloat(scale * random.logUniform(0.5, 4.0));
    c.lobe.b = asFloat(random.uniform(-1.0, 1.0));
    c.lobe.d = asFloat(0.8 * random.uniform(-1.0, 1.0) * c.lobe.a);
    c.wo = asFloats(
        glm::normalize(cosineHemisphere({random.uniform(), random.uniform()}) + glm::dvec3(0.0, 0.0, 0.02)));
    const glm::dvec3 mirrored(-c.wo.x, -c.wo.y, c.wo.z);
    const glm::dvec3 towards = glm::normalize(
        mirrored + random.uniform(0.0, 3.0) * width * uniformSphere({random.uniform(), random.uniform()}));
    const double distance = random.logUniform(1e-3, 1e3);
    c.center = asFloats(towards * distance);
    const double size = distance * random.logUniform(0.02, 2.0);
    const glm::dmat3 frame = frameAbout(uniformSphere({random.uniform(), random.uniform()}));
    c.u = asFloats(frame[0] * size);
    c.v = asFloats(frame[1] * size * random.logUniform(0.1, 1.0));
    return c;
}

glm::dmat3 frameOf(const glm::dvec3& wo) {
    const double across = std::hypot(wo.x, wo.y);
    const glm::dvec2 plane = across > 1e-10 ? glm::dvec2(wo) / across : glm::dvec2(1.0, 0.0);
    return {glm::dvec3(wo.z * plane.x, wo.z * plane.y, across), glm::dvec3(-plane.y, plane.x, 0.0),
            glm::dvec3(-across * plane.x, -across * plane.y, wo.z)};
}

double exactOf(const Case& c) {
    const glm::dmat3 toView = glm::transpose(frameOf(c.wo));
    std::vector<glm::dvec3> polygon;
    for (const glm::dvec3& p : clipped(c.polygon(), {0.0, 0.0, 1.0}))
        polygon.push_back(toView * p);
    return std::abs(polygonIntegral(c.lobe, polygon));
}

/// The definition: the density at each direction to the rect, times its solid angle.
double bruteOf(const Case& c, int steps) {
    const glm::dmat3 toView = glm::transpose(frameOf(c.wo));
    const glm::dvec3 area = 4.0 * glm::cross(c.u, c.v) / double(steps * steps);
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double s = 2.0 * (i + 0.5) / steps - 1.0, t = 2.0 * (j + 0.5) / steps - 1.0;
            const glm::dvec3 p = c.center + s * c.u + t * c.v;
            if (p.z < 0.0) continue;
            const double d = glm::length(p);
            sum += c.lobe.density(toView * (p / d)) * std::abs(glm::dot(area, p)) / (d * d * d);
        }
    return sum;
}

/// Midpoints of cells: the error falls with their size at least linearly, so that what halving them changes
/// bounds it.
TEST(LobePolygon, TheSumAboutTheBoundaryIsTheIntegral) {
    Pcg32 random(1);
    double worst = 0.0;
    int lit = 0;
    for (int i = 0; i < 60; ++i) {
        Case c = randomCase(random, i % 4 == 0);
        const double exact = exactOf(c), brute = bruteOf(c, 500);
        const double allowed = 2.0 * std::abs(brute - bruteOf(c, 250)) + 1e-5;
        lit += exact > 0.01 && allowed < 0.01 ? 1 : 0;
        EXPECT_NEAR(exact, brute, allowed) << i << ": k " << c.lobe.k;
        worst = std::max(worst, std::abs(exact - brute));
    }
    EXPECT_GT(lit, 20);
    std::printf("against brute quadrature: %.1e\n", worst);
}

TEST(LobePolygon, TheWholeSphereHoldsOneLobe) {
    TransformedLobe lobe{3.0, 0.4, 5.0, 1.0, 7.5};
    // A hemisphere about the lobe, as a polygon far out.
    const std::vector<glm::dvec3> square{
        {1e6, 1e6, 1.0}, {-1e6, 1e6, 1.0}, {-1e6, -1e6, 1.0}, {1e6, -1e6, 1.0}};
    const std::vector<glm::dvec3> below{
        {1e6, 1e6, 1.0}, {1e6, -1e6, 1.0}, {1e6, -1e6, -1e7}, {1e6, 1e6, -1e7}};
    EXPECT_LE(polygonIntegral(lobe, square), 1.0 + 1e-12);
    EXPECT_GT(polygonIntegral(lobe, square), 0.8);
    lobe = {3.0, 0.0, 3.0, 0.0, 7.5};
    EXPECT_NEAR(polygonIntegral(lobe, square), 1.0, 1e-5);
}

class GlslLobe : public test::OnContext {
protected:
    harness::ResultTable evaluate(const std::vector<Case>& cases, bool cosines, int nodes) const {
        std::vector<float> inputs;
        for (const Case& c : cases) {
            for (double x : {c.lobe.a, c.lobe.b, c.lobe.c, c.lobe.d, c.lobe.k})
                inputs.push_back(static_cast<float>(x));
            for (const glm::dvec3& v : {c.wo, c.center, c.u, c.v})
                for (int i = 0; i < 3; ++i)
                    inputs.push_back(static_cast<float>(v[i]));
        }
        const std::string defines = std::string("#define LOBE_COUNT 2\n#define LOBE_NODES ") +
                                    std::to_string(nodes) + "\n" + (cosines ? "#define LOBE_COSINES\n" : "") +
                                    "#include \"light/transformed_lobe.glsl\"\n";
        harness::Snippet snippet{"lobe",
                                 {},
                                 {{"float", "a"},
                                  {"float", "b"},
                                  {"float", "c"},
                                  {"float", "d"},
                                  {"float", "k"},
                                  {"vec3", "wo"},
                                  {"vec3", "center"},
                                  {"vec3", "u"},
                                  {"vec3", "v"}},
                                 R"(
    LobeFit fit;
    float across = length(wo.xy);
    vec2 plane = across > 1e-10 ? wo.xy / across : vec2(1.0, 0.0);
    fit.base = 1.0;
    fit.x = vec3(wo.z * plane, across);
    fit.y = vec3(-plane.y, plane.x, 0.0);
    fit.z = vec3(-across * plane, wo.z);
    fit.lobes[0] = TransformedLobe(a, b, c, d, k, vec3(1.0, 0.0, 0.0));
    fit.lobes[1] = TransformedLobe(1.0, 0.0, 1.0, 0.0, 1.0, vec3(0.0, 1.0, 0.0));
    result[0].xyz = lobe_rect(fit, center, u, v);)",
                                 1,
                                 defines};
        return harness::Evaluator(library(), snippet).evaluate(inputs);
    }

    void compare(bool cosines, int nodes, double rmsBound, double worstBound) const {
        Pcg32 random(2);
        std::vector<Case> cases;
        for (int i = 0; i < test::tableScale(4000); ++i)
            cases.push_back(randomCase(random, cosines));
        const harness::ResultTable results = evaluate(cases, cosines, nodes);
        double squares = 0.0, worst = 0.0;
        for (size_t i = 0; i < cases.size(); ++i) {
            const double got = double(results.row(i)[0]);
            ASSERT_TRUE(std::isfinite(got)) << i;
            ASSERT_GE(got, 0.0);
            const double error = std::abs(got - exactOf(cases[i]));
            EXPECT_LE(error, worstBound) << i << ": " << got << "; expected " << exactOf(cases[i]);
            squares += error * error;
            worst = std::max(worst, error);
        }
        const double rms = std::sqrt(squares / double(cases.size()));
        std::printf("%s, %d nodes: rms %.1e, worst %.1e of the lobe\n", cosines ? "cosines" : "powers", nodes,
                    rms, worst);
        EXPECT_LE(rms, rmsBound);
    }
};

/// What Gauss's rules leave of the edges' integrals: at most 2e-2, 5e-3, 1e-3 for rects anywhere. Those here
/// are aimed at the lobes, so that nearly each has an edge within them: rms 3.6e-3, 6.5e-4 and 1.0e-4 were
/// measured.
TEST_P(GlslLobe, FourNodes) {
    compare(false, 4, 5e-3, 4e-2);
}
TEST_P(GlslLobe, EightNodes) {
    compare(false, 8, 1e-3, 1e-2);
}
TEST_P(GlslLobe, SixteenNodes) {
    compare(false, 16, 2e-4, 2e-3);
}
/// Closed form: roundings of five edges, a few of which cancel.
TEST_P(GlslLobe, Cosines) {
    compare(true, 8, 2e-5, 2e-4);
}

/// Small and distant lights: the density times the solid angle, whose own error is the square of the size in
/// widths of the lobe, and the roundings of its logarithm: (k + 3) / 2 ln(1 + tan^2) 5e-7 stays below 1e-4.
TEST_P(GlslLobe, SmallLights) {
    for (bool cosines : {false, true}) {
        Pcg32 random(3);
        std::vector<Case> cases;
        for (int i = 0; i < test::tableScale(2000); ++i) {
            Case c = randomCase(random, cosines);
            const double widths =
                std::max({c.lobe.a + std::abs(c.lobe.b), c.lobe.c, 1.0 + std::abs(c.lobe.d)}) *
                std::sqrt(c.lobe.k + 3.0);
            const double size = glm::length(c.center) * random.logUniform(1e-6, 1e-3) / widths;
            c.u = asFloats(glm::normalize(c.u) * size);
            c.v = asFloats(glm::normalize(c.v) * size);
            cases.push_back(c);
        }
        const harness::ResultTable results = evaluate(cases, cosines, 8);
        double worst = 0.0;
        int checked = 0;
        for (size_t i = 0; i < cases.size(); ++i) {
            const Case& c = cases[i];
            // All above the horizon, and not seen edge-on, where the solid angle cancels.
            const glm::dvec3 normal = glm::normalize(glm::cross(c.u, c.v));
            if (c.center.z < 2.0 * (std::abs(c.u.z) + std::abs(c.v.z))) continue;
            if (std::abs(glm::dot(normal, glm::normalize(c.center))) < 0.3) continue;
            const double exact = bruteOf(c, 4);
            if (exact < 1e-30) continue;
            const double share = std::abs(double(results.row(i)[0]) - exact) / exact;
            EXPECT_LE(share, 2e-3) << i << ": " << results.row(i)[0] << "; expected " << exact;
            worst = std::max(worst, share);
            ++checked;
        }
        EXPECT_GT(checked, static_cast<int>(cases.size()) / 8);
        std::printf("small lights: %.1e of their light\n", worst);
    }
}

/// Extremes stay finite, at least 0 and at most the lobe.
TEST_P(GlslLobe, Extremes) {
    Pcg32 random(4);
    std::vector<Case> cases;
    for (int i = 0; i < test::tableScale(4000); ++i) {
        Case c = randomCase(random, i % 2 == 0);
        const double scale = random.logUniform(1e-9, 1e9);
        c.u *= random.logUniform(1e-6, 1e4);
        c.center = (i % 5 == 0 ? glm::dvec3(0.0) : c.center) * scale;
        c.u *= scale;
        c.v *= scale;
        if (i % 7 == 0) c.center = -c.u;  // touches the surface with an edge
        if (i % 11 == 0) c.v = c.u;       // no area
        if (i % 13 == 0) c.wo = {0.0, 0.0, 1.0};
        if (i % 17 == 0) c.wo = asFloats({std::sqrt(1.0 - 1e-12), 0.0, 1e-6});
        cases.push_back(c);
    }
    for (bool cosines : {false, true}) {
        const harness::ResultTable results = evaluate(cases, cosines, 8);
        for (size_t i = 0; i < cases.size(); ++i)
            for (size_t channel : {0U, 1U}) {
                const double got = double(results.row(i)[channel]);
                EXPECT_TRUE(got >= 0.0 && got <= 1.0) << i << ": " << got;
            }
    }
}

LOBE_ON_EVERY_BACKEND(GlslLobe);

}  // namespace
}  // namespace lobe::fit
