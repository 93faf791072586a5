#include "reference/direct_light.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "harness/albedo.hpp"
#include "math/sphere.hpp"

namespace lobe::reference {
namespace {

constexpr double kPi = std::numbers::pi;
const Visibility kAllVisible = [](const glm::dvec3&, double) { return 1.0; };

Light bodyOf(LightType type, const glm::dvec3& position, const glm::dvec3& direction) {
    Light light;
    light.type = type;
    light.position = position;
    light.direction = glm::normalize(direction);
    light.axis = frameAbout(light.direction)[0];
    light.width = 1.2;
    light.height = 0.8;
    light.radius = 0.3;
    light.length = 1.0;
    light.intensity = {3.0, 2.0, 1.0};
    return light;
}

/// A point at the origin, facing +Z, seen from 40 degrees.
struct Bench {
    Scene scene;
    const Brdf& brdf;
    ParameterValues values;
    ShadingPoint point;
    Pcg32 random{11};

    explicit Bench(const std::string& model, double polar = 0.7)
        : brdf(requireBrdf(model)), values(brdf.defaults()) {
        if (const int table = brdf.tableParameter(); table >= 0) {
            const TableRows rows = brdf.table->examples().front().second;
            values.insert(values.end(), rows.begin(), rows.end());
        }
        point.toEye = fromPolar(polar, 0.4);
        point.brdf = &brdf;
        point.values = values;
    }

    /// Sum of all integrals after `rounds` refinements.
    Estimate integrate(const EnvironmentMap* map, Method method, int rounds,
                       const Visibility& visible = kAllVisible) {
        const DirectLight lights(scene, map, method);
        std::array<glm::dvec3, kSources> exact{};
        Estimate sum;
        for (const auto& integral : lights.at(point, visible, random, exact)) {
            for (int i = 0; i < rounds; ++i)
                integral->refine();
            sum.mean += integral->estimate().mean;
            sum.variance += integral->estimate().variance;
        }
        for (const glm::dvec3& one : exact)
            sum.mean += one;
        return sum;
    }
};

void expectEqual(const Estimate& a, const Estimate& b, const std::string& what) {
    for (int c = 0; c < 3; ++c) {
        // Five and a half standard errors of 14 degrees of freedom: one in twenty thousand.
        const double allowed = 5.5 * std::sqrt(a.variance[c] + b.variance[c]) + 1e-6 * std::abs(a.mean[c]);
        EXPECT_NEAR(a.mean[c], b.mean[c], allowed) << what << " " << c;
        EXPECT_LT(allowed, 0.25 * a.mean[c] + 1e-9) << what << ": the check says nothing";
    }
}

TEST(DirectLight, PointLightOnLambertIsTheTextbookFormula) {
    Bench bench("lambert");
    Light light;
    light.position = {3, 0, 4};
    light.intensity = {50, 25, 5};
    bench.scene.lights = {light};
    const glm::dvec3 diffuse(bench.values[0], bench.values[1], bench.values[2]);
    const glm::dvec3 exact = diffuse / kPi * light.intensity * 0.8 / 25.0;
    const Estimate result = bench.integrate(nullptr, Method::automatic, 0);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(result.mean[c], exact[c], 1e-14);
    EXPECT_EQ(result.variance, glm::dvec3(0.0));
}

TEST(DirectLight, DiskOverLambertIsTheTextbookFormula) {
    Bench bench("lambert");
    bench.scene.lights = {bodyOf(LightType::disk, {0, 0, 2}, {0, 0, -1})};
    const glm::dvec3 diffuse(bench.values[0], bench.values[1], bench.values[2]);
    const glm::dvec3 exact = diffuse * glm::dvec3(3, 2, 1) * 0.09 / (0.09 + 4.0);
    const Estimate result = bench.integrate(nullptr, Method::automatic, 0);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(result.mean[c], exact[c], 1e-6 * exact[c]);
}

TEST(DirectLight, QuadratureAndSamplingAgreeForEveryModelAndBody) {
    for (const Brdf& brdf : allBrdfs()) {
        if (!brdf.traits.scattersLight) continue;
        for (const LightType type : {LightType::rect, LightType::disk, LightType::sphere, LightType::tube}) {
            Bench bench(brdf.name);
            bench.scene.lights = {bodyOf(type, {-0.8, -0.2, 1.5}, {0.3, 0.1, -1})};
            expectEqual(bench.integrate(nullptr, Method::automatic, 2),
                        bench.integrate(nullptr, Method::sampled, 5),
                        brdf.name + " " + std::to_string(static_cast<int>(type)));
        }
    }
}

TEST(DirectLight, AWhiteFurnaceShowsTheAlbedo) {
    Environment white;
    const EnvironmentMap map(white, nullptr);
    for (const Brdf& brdf : allBrdfs()) {
        if (!brdf.traits.scattersLight) continue;
        Bench bench(brdf.name, 0.9);
        bench.point.toEye = fromPolar(0.9, 0.0);  // as harness::albedo() has it
        const Estimate result = bench.integrate(&map, Method::automatic, 4);
        glm::dvec3 albedo;
        for (int c = 0; c < 3; ++c)
            albedo[c] = harness::albedo(brdf, bench.values, bench.point.toEye.z, c).value;
        expectEqual({albedo, glm::dvec3(0.0)}, result, brdf.name);
    }
}

TEST(DirectLight, HalfAShadowIsHalfTheLightAndFullOnesAreExact) {
    for (const char* model : {"lambert", "ggx"}) {
        Bench bench(model);
        Light light = bodyOf(LightType::disk, {0, 0, 2}, {0, 0, -1});
        bench.point.toEye = {0, 0, 1};
        bench.scene.lights = {light};
        const Estimate full = bench.integrate(nullptr, Method::automatic, 0);
        // A screen that covers x > 0 halves a disk overhead.
        const Visibility half = [](const glm::dvec3& d, double) { return d.x > 0.0 ? 0.0 : 1.0; };
        expectEqual({full.mean * 0.5, glm::dvec3(0.0)}, bench.integrate(nullptr, Method::automatic, 3, half),
                    model);
        const Visibility none = [](const glm::dvec3&, double) { return 0.0; };
        const Estimate dark = bench.integrate(nullptr, Method::automatic, 0, none);
        EXPECT_EQ(dark.mean, glm::dvec3(0.0)) << model;
        EXPECT_LT(full.variance.x, 1e-12 * full.mean.x * full.mean.x) << model;
    }
}

TEST(DirectLight, TheStatedErrorIsTheErrorMade) {
    Bench bench("lambert");
    bench.point.toEye = {0, 0, 1};
    bench.scene.lights = {bodyOf(LightType::disk, {0, 0, 2}, {0, 0, -1})};
    const double exact = 0.5 * bench.integrate(nullptr, Method::automatic, 0).mean.x;
    const Visibility half = [](const glm::dvec3& d, double) { return d.x + 0.3 * d.y > 0.0 ? 0.0 : 1.0; };
    double ratio = 0.0;
    const int runs = 400;
    for (int i = 0; i < runs; ++i) {
        const Estimate result = bench.integrate(nullptr, Method::automatic, 1, half);
        const double error = result.mean.x - exact;
        ratio += error * error / result.variance.x / runs;
    }
    // The mean of squares of Student's t with 7 degrees of freedom is 7/5; its standard error here, from t's
    // fourth moment (infinite tails aside), is about 0.15.
    EXPECT_NEAR(ratio, 1.4, 0.6);
}

TEST(DirectLight, AMirrorShowsBodiesAndTheEnvironment) {
    Bench bench("mirror", 0.5);
    Environment grey;
    grey.radiance = {0.25, 0.5, 0.75};
    const EnvironmentMap map(grey, nullptr);
    const glm::dvec3 mirrored(-bench.point.toEye.x, -bench.point.toEye.y, bench.point.toEye.z);
    const glm::dvec3 reflectance = bench.brdf.mirror(bench.point.toEye.z, bench.values);
    const glm::dvec3 sky = bench.integrate(&map, Method::automatic, 0).mean;
    EXPECT_NEAR(sky.y, reflectance.y * 0.5, 1e-12);
    bench.scene.lights = {bodyOf(LightType::sphere, 5.0 * mirrored, {0, 0, -1})};
    const glm::dvec3 ball = bench.integrate(&map, Method::automatic, 0).mean;
    EXPECT_NEAR(ball.y, reflectance.y * radianceOf(bench.scene.lights[0]).y, 1e-9);
}

TEST(DirectLight, ExtremesStayFinite) {
    for (const Brdf& brdf : allBrdfs()) {
        for (const double polar : {0.0, 1.5707}) {
            Bench bench(brdf.name, polar);
            Light sun = bodyOf(LightType::sphere, {1e6, 0, 1e6}, {0, 0, -1});
            sun.radius = 5000.0;
            sun.intensity = glm::dvec3(1e9 * kPi * 25e6);
            Light touching = bodyOf(LightType::sphere, {0, 0, 0.3}, {0, 0, -1});
            Light tiny = bodyOf(LightType::disk, {0, 0, 1}, {0, 0, -1});
            tiny.radius = 1e-6;
            Light around = bodyOf(LightType::sphere, {0, 0, 0}, {0, 0, -1});
            around.radius = 1e4;
            Light edge = bodyOf(LightType::rect, {1, 0, 0}, {0, 0, -1});
            bench.scene.lights = {sun, touching, tiny, around, edge};
            const Estimate result = bench.integrate(nullptr, Method::automatic, 0);
            for (int c = 0; c < 3; ++c) {
                EXPECT_TRUE(std::isfinite(result.mean[c])) << brdf.name;
                EXPECT_GE(result.mean[c], 0.0) << brdf.name;
            }
        }
    }
}

}  // namespace
}  // namespace lobe::reference
