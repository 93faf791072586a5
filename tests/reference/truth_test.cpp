// Whole pictures: what they hold, that they end where they should, and that they can be gone on with.
#include "reference/truth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/explanation.hpp"
#include "support/scenes.hpp"

namespace lobe::reference {
namespace {

constexpr double kPi = std::numbers::pi;
const std::atomic<bool> kGoOn{false};

/// A white Lambert floor at z = 0 seen from above, a small plate over its middle, and a disk light over that.
std::shared_ptr<Scene> plateScene() {
    auto scene = std::make_shared<Scene>();
    const int white = test::addMaterial(*scene, "lambert");
    test::setParameter(scene->materials[0], "diffuse", glm::dvec3(1.0));
    test::addInstance(*scene, test::addQuad(*scene, white, 2.0F));
    glm::dmat4 above(1.0);
    above[3] = glm::dvec4(0.0, 0.0, 0.5, 1.0);
    test::addInstance(*scene, test::addQuad(*scene, white, 0.3F), above);
    scene->materials[0].doubleSided = true;
    Light light;
    light.type = LightType::disk;
    light.position = {0, 0, 2};
    light.direction = {0, 0, -1};
    light.radius = 0.4;
    light.intensity = {1.0, 2.0, 4.0};
    scene->lights = {light};
    return scene;
}

Camera slanted() {
    return lookAt({0.0, -4.0, 3.0}, {0.0, 0.0, 0.0}, 0.8);
}

TruthRequest request(double error, int width = 48, int height = 32) {
    TruthRequest wanted;
    wanted.width = width;
    wanted.height = height;
    wanted.relativeError = error;
    return wanted;
}

TruthResult compute(const std::shared_ptr<const Scene>& scene, const TruthRequest& wanted,
                    const Image* earlier = nullptr, const Camera& camera = slanted()) {
    return computeTruth(
        scene, camera, wanted, earlier, kGoOn, [](const TruthProgress&) {}, [](const Image&) {});
}

double at(const Image& image, int x, int y, const std::string& channel) {
    const auto found = std::find(image.channels.begin(), image.channels.end(), channel);
    EXPECT_NE(found, image.channels.end()) << channel;
    return double{image.pixel(x, y)[found - image.channels.begin()]};
}

TEST(Truth, ReachesTheErrorWantedAndSaysWhichIsLeft) {
    const auto scene = plateScene();
    const TruthResult rough = compute(scene, request(0.05)), fine = compute(scene, request(0.005));
    EXPECT_EQ(rough.unfinished, 0U);
    EXPECT_EQ(fine.unfinished, 0U);
    EXPECT_LE(rough.relativeError, 0.05);
    EXPECT_LE(fine.relativeError, 0.005);
    EXPECT_GT(fine.relativeError, 0.0);
    // The rough one is off by what it says: squares of Student's t with 7 degrees of freedom have the mean
    // 7/5.
    double ratio = 0.0;
    int count = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 48; ++x) {
            const double stated = at(rough.image, x, y, "error.G");
            if (stated <= 1e-4 * at(rough.image, x, y, "G")) continue;
            const double made = at(rough.image, x, y, "G") - at(fine.image, x, y, "G");
            ratio += std::min(made * made / (stated * stated), 50.0);
            ++count;
        }
    ASSERT_GT(count, 100);
    EXPECT_GT(ratio / count, 0.5);
    EXPECT_LT(ratio / count, 3.0);
}

TEST(Truth, DoesNotDependOnTheNumberOfThreads) {
    const auto scene = plateScene();
    TruthRequest one = request(0.02);
    one.threads = 1;
    TruthRequest three = one;
    three.threads = 3;
    EXPECT_EQ(compute(scene, one).image.values, compute(scene, three).image.values);
}

TEST(Truth, GoesOnFromAnEarlierOne) {
    const auto scene = plateScene();
    const TruthResult rough = compute(scene, request(0.05));
    const TruthResult same = compute(scene, request(0.05), &rough.image);
    EXPECT_EQ(same.image.values, rough.image.values);  // was good enough
    const TruthResult better = compute(scene, request(0.01), &rough.image);
    EXPECT_LE(better.relativeError, 0.01);
    EXPECT_EQ(better.unfinished, 0U);
    Image foreign(3, 3, {"R"});
    EXPECT_EQ(compute(scene, request(0.05), &foreign).image.values, rough.image.values);
}

TEST(Truth, StopsWhenItIsToldTo) {
    const std::atomic<bool> stop{true};
    const TruthResult nothing = computeTruth(
        plateScene(), slanted(), request(0.01), nullptr, stop, [](const TruthProgress&) {},
        [](const Image&) {});
    EXPECT_EQ(nothing.image.width, 48);
    TruthRequest hurry = request(1e-6);
    hurry.seconds = 0.3;
    const TruthResult some = compute(plateScene(), hurry);
    EXPECT_GT(some.unfinished, 0U);
}

TEST(Truth, LayersSumToRadiance) {
    auto scene = plateScene();
    scene->lights.push_back(test::directional({0.2, 0.1, -1}, {1, 1, 1}));
    scene->ambientRadiance = glm::dvec3(0.1);
    scene->fog = Fog{{0.05, 0.1, 0.2}, {0.5, 0.6, 0.7}, 0.3, 0.0};
    const Image image = compute(scene, request(0.02)).image;
    for (int y = 0; y < image.height; y += 5)
        for (int x = 0; x < image.width; x += 5)
            EXPECT_NEAR(at(image, x, y, "R"),
                        at(image, x, y, "ambient.R") + at(image, x, y, "directional.R") +
                            at(image, x, y, "disk.R") + at(image, x, y, "fog.R"),
                        1e-6);
    EXPECT_EQ(std::find(image.channels.begin(), image.channels.end(), "spot.R"), image.channels.end());
}

TEST(Truth, WithoutShadowsTheDiskIsItsClosedForm) {
    const auto scene = plateScene();
    TruthRequest wanted = request(0.0002);
    wanted.options.shadows = false;
    const Image image = compute(scene, wanted).image;
    int compared = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            if (at(image, x, y, "A") == 0.0) continue;
            const View view = makeView(slanted(), image.width, image.height);
            const Ray ray = pixelRay(view, x + 0.5, image.height - y - 0.5);
            const glm::dvec3 p = ray.origin + ray.direction * at(image, x, y, "depth.Z");
            const double h2 = (2.0 - p.z) * (2.0 - p.z), a2 = p.x * p.x + p.y * p.y, r2 = 0.16;
            const double root = std::sqrt((h2 + a2 + r2) * (h2 + a2 + r2) - 4.0 * r2 * a2);
            const double factor = 0.5 * (1.0 + (r2 - h2 - a2) / root);  // of the irradiance, over pi
            EXPECT_NEAR(at(image, x, y, "G"), 2.0 * factor, 2e-5 * factor) << x << " " << y;
            ++compared;
        }
    EXPECT_GT(compared, 500);
}

TEST(Truth, BoxIsTheMeanOfThePixel) {
    // An edge through the picture's middle column, at three tenths of the pixel.
    auto scene = std::make_shared<Scene>();
    const int white = test::addMaterial(*scene, "lambert");
    test::setParameter(scene->materials[0], "diffuse", glm::dvec3(1.0));
    scene->lights = {test::directional({0, 0, -1}, glm::dvec3(kPi))};
    Camera camera = lookAt({0, 0, 1}, {0, 0, 0}, 0.8);
    camera.orthographic = true;
    camera.xMag = camera.yMag = 1.0;
    camera.zNear = 0.1;
    camera.zFar = 10.0;
    glm::dmat4 moved(1.0);
    moved[3] = glm::dvec4(-2.0 + 2.0 / 5.0 * 0.3 - 0.2, 0.0, 0.0, 1.0);
    test::addInstance(*scene, test::addQuad(*scene, white, 2.0F), moved);
    TruthRequest wanted = request(0.002, 5, 5);
    wanted.options.filter = PixelFilter::box;
    const TruthResult result = compute(scene, wanted, nullptr, camera);
    EXPECT_NEAR(at(result.image, 1, 2, "R"), 1.0, 1e-6);
    EXPECT_NEAR(at(result.image, 2, 2, "R"), 0.3, 6.0 * at(result.image, 2, 2, "error.R") + 1e-6);
    EXPECT_LT(at(result.image, 2, 2, "error.R"), 0.002);
    EXPECT_NEAR(at(result.image, 2, 2, "A"), 0.3, 0.02);
    EXPECT_EQ(at(result.image, 3, 2, "R"), 0.0);
}

TEST(Fog, IsBeerAndLambertsLaw) {
    const Fog even{{0.5, 1.0, 0.0}, glm::dvec3(1.0), 0.0, 0.0};
    EXPECT_DOUBLE_EQ(fogTransmittance(even.medium(), 3.0, 0.4, 2.0).x, std::exp(-1.0));
    EXPECT_EQ(fogTransmittance(even.medium(), 3.0, 0.4, 2.0).z, 1.0);
    EXPECT_EQ(fogTransmittance(even.medium(), 0.0, 0.0, std::numeric_limits<double>::infinity()).y, 0.0);
    const Fog high{glm::dvec3(0.5), glm::dvec3(1.0), 2.0, 1.0};
    for (const double rise : {-1.0, -0.3, -1e-9, 0.0, 1e-12, 1e-4, 0.7, 1.0}) {
        // Simpson's rule over the way.
        const double start = 1.4, length = 3.0;
        const int n = 2000;
        double depth = 0.0;
        for (int i = 0; i <= n; ++i)
            depth += (i == 0 || i == n ? 1.0
                      : i % 2 == 1     ? 4.0
                                       : 2.0) *
                     std::exp(-2.0 * (start + rise * length * i / n - 1.0));
        depth *= 0.5 * length / n / 3.0;
        EXPECT_NEAR(fogTransmittance(high.medium(), start, rise, length).x, std::exp(-depth), 1e-10) << rise;
    }
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(fogTransmittance(high.medium(), 1.0, 1.0, infinity).x, std::exp(-0.25), 1e-15);
    EXPECT_EQ(fogTransmittance(high.medium(), 1.0, -0.1, infinity).x, 0.0);
    const Fog thick{glm::dvec3(1e6), glm::dvec3(1.0), 1e3, -1e9};
    for (const double rise : {-1.0, 0.0, 1.0})
        EXPECT_TRUE(std::isfinite(fogTransmittance(thick.medium(), 1e6, rise, 1e9).x));
}

TEST(Explanation, SharesSumToTheTruth) {
    auto scene = plateScene();
    scene->lights.push_back(test::point({0.5, -1.0, 1.5}, {2, 2, 2}));
    scene->ambientRadiance = glm::dvec3(0.05);
    const PixelIntegrator integrator(scene, slanted(), 48, 32, {});
    Effort effort;
    effort.relativeError = 0.002;
    const Explanation explained = explain(integrator, *scene, 20, 20, effort, true);
    ASSERT_EQ(explained.surfaces.size(), 1U);
    const SurfaceShare& surface = explained.surfaces[0];
    ASSERT_EQ(surface.lights.size(), 2U);
    glm::dvec3 sum = surface.ambient + surface.point.emission;
    glm::dvec3 variance = explained.truth.variance;
    for (const LightShare& light : surface.lights) {
        sum += light.radiance;
        variance += light.error * light.error;
    }
    EXPECT_NEAR(sum.y, explained.truth.total().y, 6.0 * std::sqrt(variance.y) + 1e-9);
    const LightShare& point = surface.lights[1];
    EXPECT_NEAR(point.radiance.x, point.irradiance.x * point.brdf.x * point.wi.z * point.visible, 1e-12);
}

}  // namespace
}  // namespace lobe::reference
