/// Airlight: the twin against the integral as it is written, and GLSL's nodes against the twin.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <sstream>

#include "harness/evaluator.hpp"
#include "math/quadrature.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"
#include "math/ulp.hpp"
#include "on_contexts.hpp"
#include "shading/fog.hpp"
#include "shading/punctual.hpp"

namespace lobe {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kCut = 17.0;  // as the renderer's, in mean free paths

struct Sample {
    FogMedium fog;
    FogLight light;
    glm::dvec3 direction{0.0, 0.0, 1.0};
    double length = kInfinity;
};

/// Rays that pass lights at all distances, all rounded to floats.
Sample randomSample(Pcg32& random, bool spot) {
    const auto rounded = [](double value) { return static_cast<double>(static_cast<float>(value)); };
    const auto direction = [&] {
        return glm::normalize(glm::dvec3(glm::vec3(uniformSphere({random.uniform(), random.uniform()}))));
    };
    Sample sample;
    sample.fog.extinction = glm::dvec3(rounded(random.logUniform(1e-3, 3.0)));
    sample.fog.scattering = glm::dvec3(1.0, 0.5, 0.0) * sample.fog.extinction;
    sample.fog.anisotropy = rounded(random.uniform(-0.9, 0.9));
    sample.direction = direction();
    const glm::dvec3 aside = glm::normalize(glm::cross(sample.direction, direction()));
    const double along = random.uniform(-5.0, 10.0), off = random.logUniform(1e-2, 5.0);
    sample.light.position = glm::dvec3(glm::vec3(along * sample.direction + off * aside));
    sample.light.intensity = glm::dvec3(1.0);
    if (random.uniform() < 0.3) sample.light.range = random.uniform(1.0, 10.0);
    sample.length = random.uniform() < 0.2 ? kInfinity : rounded(random.logUniform(0.1, 50.0));
    if (spot) {
        sample.light.outerConeAngle = random.logUniform(0.05, glm::half_pi<double>());
        sample.light.innerConeAngle = *sample.light.outerConeAngle * random.uniform();
        // Towards some place on the ray, so that the cone shows.
        const glm::dvec3 target = random.uniform(-5.0, 15.0) * sample.direction;
        sample.light.axis = glm::normalize(
            glm::dvec3(glm::vec3(glm::normalize(target - sample.light.position) + 0.3 * direction())));
    }
    return sample;
}

/// The integral over s, by fine panels that are graded towards the place next to the light.
double direct(const Sample& sample) {
    const double p = glm::dot(sample.light.position, sample.direction);
    const double length = std::min(sample.length, 60.0 / sample.fog.extinction.x + 60.0 + std::abs(p));
    std::vector<double> breaks{0.0, length};
    for (const double step : gradedBreaks(1e-4, 2.0 * length, 400))
        for (const double s : {p - step, p + step})
            if (s > 0.0 && s < length) breaks.push_back(s);
    for (int i = 1; i < 2000; ++i)
        breaks.push_back(length * i / 2000.0);
    std::sort(breaks.begin(), breaks.end());
    return integratePanels(
        [&](double s) {
            const glm::dvec3 fromLight = s * sample.direction - sample.light.position;
            const double r = glm::length(fromLight);
            double value =
                distanceAttenuation(r * r, sample.light.range) *
                henyeyGreenstein(glm::dot(fromLight / r, -sample.direction), sample.fog.anisotropy) *
                std::exp(-sample.fog.extinction.x * (s + r));
            if (sample.light.outerConeAngle)
                value *= spotAttenuation(glm::dot(fromLight / r, sample.light.axis),
                                         sample.light.innerConeAngle, *sample.light.outerConeAngle);
            return sample.fog.scattering.x * value;
        },
        breaks, gaussLegendre(8));
}

TEST(AirlightTwin, IsTheIntegralOverTheRay) {
    Pcg32 random(31);
    int lit = 0;
    for (int i = 0; i < 120; ++i) {
        const Sample sample = randomSample(random, i % 2 == 1);
        const double exact = direct(sample);
        const glm::dvec3 twin =
            airlight(sample.fog, sample.light, glm::dvec3(0.0), sample.direction, sample.length);
        // The panels of `direct` do not end where a cone or a range does.
        const double allowed = sample.light.range || sample.light.outerConeAngle ? 1e-5 : 1e-8;
        EXPECT_NEAR(twin.x, exact, allowed * exact + 1e-30) << i;
        EXPECT_EQ(twin.z, 0.0);
        EXPECT_NEAR(twin.y, 0.5 * twin.x, 1e-12 * twin.x);
        lit += exact > 1e-6;
    }
    EXPECT_GT(lit, 60);
}

TEST(AirlightTwin, PhaseFunctionIntegratesToOne) {
    const QuadratureRule rule = gaussLegendre(32);
    for (const double g : {-0.999, -0.6, 0.0, 0.3, 0.95}) {
        std::vector<double> breaks{0.0};
        for (const double step : gradedBreaks(1e-8, 2.0, 60))
            breaks.push_back(step);
        // Over 1 - |cos| from the peak.
        const double sum = integratePanels(
            [&](double x) { return henyeyGreenstein(g < 0.0 ? x - 1.0 : 1.0 - x, g); }, breaks, rule);
        EXPECT_NEAR(sum * glm::two_pi<double>(), 1.0, 1e-9) << g;
    }
}

TEST(AirlightTwin, ThroughTheLightItIsFinite) {
    FogMedium fog{glm::dvec3(0.1), 0.0, 0.0, glm::dvec3(0.1), 0.5};
    FogLight light;
    light.position = {0, 0, 5};
    const glm::dvec3 through = airlight(fog, light, {}, {0, 0, 1}, kInfinity);
    EXPECT_TRUE(std::isfinite(through.x));
    EXPECT_GT(through.x, 0.0);
    light.position = {0, 0, 0};
    EXPECT_TRUE(std::isfinite(airlight(fog, light, {}, {0, 0, 1}, kInfinity).x));
    EXPECT_EQ(airlight(fog, light, {}, {0, 0, 1}, 0.0).x, 0.0);
}

class AirlightGlsl : public test::OnContext {
protected:
    harness::Evaluator evaluator(int nodes) const {
        const QuadratureRule rule = gaussLegendre(nodes);
        std::ostringstream table;
        table.precision(9);
        table << "const vec2 NODES[" << nodes << "] = vec2[](";
        for (size_t i = 0; i < rule.nodes.size(); ++i)
            table << (i == 0 ? "" : ", ") << "vec2(" << std::fixed << 0.5 * (1.0 + rule.nodes[i]) << ", "
                  << 0.5 * rule.weights[i] << ")";
        table << ");\n";
        const std::string functions =
            table.str() +
            "vec3 lit(vec3 light, vec3 direction, float way, float extinction, float g, float inv_range2, "
            "vec3 axis,\n"
            "         float scale, float offset)\n"
            "{\n"
            "    AirlightArc arc = airlight_arc(light, direction, way, 17.0 / extinction, inv_range2);\n"
            "    AirlightWedge wedge;\n"
            "    if (scale > 0.0) wedge = airlight_wedge(arc, direction, axis, offset / scale);\n"
            "    vec3 sum = vec3(0.0);\n"
            "    int i = 0;\n"
            "    do {\n"
            "        AirlightPoint point = airlight_point(arc, NODES[i].x, g);\n"
            "        float cone = scale > 0.0 ? airlight_cone(wedge, point.angle, scale, offset) : 1.0;\n"
            "        sum += NODES[i].y * point.phase * cone * punctual_window(point.r * point.r, "
            "inv_range2)\n"
            "               * airlight_dimming(vec3(extinction), point.way);\n"
            "    } while (++i < " +
            std::to_string(nodes) +
            ");\n"
            "    return sum * ((arc.to - arc.from) / arc.h);\n"
            "}\n";
        return {library(),
                {"airlight",
                 {"light/airlight.glsl"},
                 {{"vec3", "light"},
                  {"vec3", "direction"},
                  {"float", "way"},
                  {"float", "extinction"},
                  {"float", "g"},
                  {"float", "inv_range2"},
                  {"vec3", "axis"},
                  {"float", "scale"},
                  {"float", "offset"}},
                 "    result[0].xyz = extinction * lit(light, direction, way, extinction, g, inv_range2, "
                 "axis, scale, "
                 "offset);",
                 1,
                 functions}};
    }
};

void addRow(std::vector<float>& inputs, const Sample& sample) {
    const auto put = [&inputs](double value) { inputs.push_back(static_cast<float>(value)); };
    const auto put3 = [&put](const glm::dvec3& value) {
        for (int c = 0; c < 3; ++c)
            put(value[c]);
    };
    put3(sample.light.position);
    put3(sample.direction);
    put(sample.length);
    put(sample.fog.extinction.x);
    put(sample.fog.anisotropy);
    put(inverseRange2(sample.light.range));
    put3(sample.light.axis);
    const SpotScaleOffset cone = sample.light.outerConeAngle ? spotScaleOffset(sample.light.innerConeAngle,
                                                                               *sample.light.outerConeAngle)
                                                             : SpotScaleOffset{0.0, 0.0};
    put(cone.scale);
    put(cone.offset);
}

struct Errors {
    double mean = 0.0, largest = 0.0;
};

/// Relative to the exact value, or to a hundredth of the mean of all where that is more.
Errors errorsOf(const harness::Evaluator& evaluator, const std::vector<Sample>& samples,
                const std::vector<double>& exact) {
    std::vector<float> inputs;
    double mean = 0.0;
    for (size_t i = 0; i < samples.size(); ++i) {
        addRow(inputs, samples[i]);
        mean += exact[i] / static_cast<double>(samples.size());
    }
    const harness::ResultTable table = evaluator.evaluate(inputs);
    Errors errors;
    for (size_t i = 0; i < samples.size(); ++i) {
        const auto got = static_cast<double>(table.row(i)[0]);
        EXPECT_TRUE(std::isfinite(got) && got >= 0.0) << i;
        const double error = std::abs(got - exact[i]) / (exact[i] + 0.01 * mean);
        errors.mean += error / static_cast<double>(samples.size());
        errors.largest = std::max(errors.largest, error);
    }
    return errors;
}

TEST_P(AirlightGlsl, NodesConvergeToTheTwin) {
    for (const bool spot : {false, true}) {
        Pcg32 random(32);
        std::vector<Sample> samples;
        std::vector<double> exact;
        for (int i = 0; i < test::tableScale(4000); ++i) {
            samples.push_back(randomSample(random, spot));
            const Sample& s = samples.back();
            exact.push_back(airlight(s.fog, s.light, glm::dvec3(0.0), s.direction, s.length).x);
        }
        double before = kInfinity;
        for (const int nodes : {2, 4, 8, 16, 64}) {
            const Errors errors = errorsOf(evaluator(nodes), samples, exact);
            std::printf("airlight of %s lights, %2d nodes: mean %.1e, largest %.1e\n",
                        spot ? "spot" : "point", nodes, errors.mean, errors.largest);
            EXPECT_LT(errors.mean, before);
            before = errors.mean;
        }
        // What is left is rounding: of the ray's distance from the light, 2^-24 of the light's distance, here
        // up to 1100 times that; and, of spots, the kink where the inner cone begins.
        EXPECT_LT(before, spot ? 2e-4 : 1e-5);
    }
}

TEST_P(AirlightGlsl, EndsOfEverything) {
    std::vector<float> inputs;
    for (const glm::dvec3& position :
         {glm::dvec3(0, 0, 0), glm::dvec3(0, 0, 5), glm::dvec3(0, 0, -5), glm::dvec3(1e-30, 0, 0),
          glm::dvec3(1e-9, 0, 1), glm::dvec3(1e15, 0, 1e15), glm::dvec3(0, 1e6, 3)})
        for (const double extinction : {1e-30, 1e-6, 1.0, 1e6, 1e30})
            for (const double length : {0.0, 1e-9, 1.0, 1e15, kInfinity})
                for (const double g : {-0.999, 0.0, 0.999})
                    for (const double outer : {0.0, 1e-3, 0.5, glm::half_pi<double>(), -1.0}) {
                        Sample sample;
                        sample.light.position = position;
                        sample.fog.extinction = glm::dvec3(extinction);
                        sample.fog.anisotropy = g;
                        sample.length = length;
                        if (outer >= 0.0) sample.light.outerConeAngle = outer;
                        sample.light.axis = {0, 0, -1};
                        sample.light.range = position.y > 0.0 ? std::optional<double>(10.0) : std::nullopt;
                        addRow(inputs, sample);
                    }
    const harness::ResultTable table = evaluator(8).evaluate(inputs);
    for (size_t i = 0; i < table.rows(); ++i)
        ASSERT_TRUE(std::isfinite(table.row(i)[0]) && table.row(i)[0] >= 0.0f)
            << i << ": " << table.row(i)[0];
}

LOBE_ON_EVERY_BACKEND(AirlightGlsl);

}  // namespace
}  // namespace lobe
