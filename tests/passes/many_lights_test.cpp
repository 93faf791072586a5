// Lights by the thousand: lists by cluster lose nothing, and any number works.
#include <numbers>
#include <random>

#include "passes/cluster_grid.hpp"
#include "passes/rendering.hpp"
#include "shading/punctual.hpp"

namespace lobe {
namespace {

using namespace test;

Scene floorWithLights(int count, std::optional<double> range, bool spots = false) {
    Scene scene;
    addInstance(scene, addQuad(scene, addMaterial(scene, "lambert"), 20.0f),
                glm::rotate(glm::dmat4(1.0), -std::numbers::pi / 2, glm::dvec3(1, 0, 0)));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-18.0, 18.0), colour(0.2, 1.0), height(0.2, 2.0);
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 position(place(random), height(random), place(random));
        const glm::dvec3 intensity(colour(random), colour(random), colour(random));
        Light light = spots ? spot(position, position - glm::dvec3(0.2, 1, 0.1), intensity, 0.3, 0.5)
                            : point(position, intensity);
        light.range = range;
        scene.lights.push_back(light);
    }
    return scene;
}

Camera overview() {
    Camera camera = lookAt({0, 8, 22}, {0, 0, 0}, 0.9);
    camera.zNear = 0.1;
    return camera;
}

class ManyLights : public testing::TestWithParam<int> {};

TEST_P(ManyLights, EveryPixelIsTheSumOfAllLights) {
    const int count = GetParam();
    const Scene scene = floorWithLights(count, 3.0);
    const Image image = render(
        scene, overview(), smallPicture({.samples = 1, .gbufferBits = 32}, {Aov::radiance, Aov::position}));
    const size_t px = channelIndex(image, "position.X");
    int lit = 0;
    for (int y = 0; y < image.height; y += 3)
        for (int x = 0; x < image.width; x += 3) {
            const float* pixel = image.pixel(x, y);
            if (pixel[3] == 0.0f) continue;
            const glm::dvec3 position(pixel[px], pixel[px + 1], pixel[px + 2]);
            glm::dvec3 sum(0.0);
            for (const Light& light : scene.lights) {
                const glm::dvec3 toLight = light.position - position;
                const double cosine = std::max(0.0, glm::normalize(toLight).y);
                sum += light.intensity * (distanceAttenuation(glm::dot(toLight, toLight), light.range) *
                                          cosine * scene.materials[0].values[0] / std::numbers::pi);
            }
            lit += sum.x > 0.0;
            // Position from depth is off by 6e-8 of 30 m, 2e-6 m, which a light 0.2 m above the floor sees as
            // 1e-5 of its distance; its square and the cosine multiply that by 3, and the window by up to 4.
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(static_cast<double>(pixel[c]), sum[c], 1.2e-4 * sum[c] + 1e-7) << x << ", " << y;
        }
    EXPECT_GT(lit, count >= 100 ? 300 : 1);
}
INSTANTIATE_TEST_SUITE_P(Counts, ManyLights, testing::Values(1, 16, 100, 1000, 10000));

TEST(Clusters, SpotsInClustersGiveThePictureOfOneLoop) {
    const Scene scene = floorWithLights(200, 3.0, true);
    const Image lists = render(scene, overview(), smallPicture({.samples = 1, .gbufferBits = 32}));
    const Image loop =
        render(scene, overview(), smallPicture({.samples = 1, .gbufferBits = 32, .clusterFrom = 0}));
    // The same terms in the same order, but for zeros: light that a list leaves out adds exactly nothing.
    for (size_t i = 0; i < lists.values.size(); ++i)
        ASSERT_NEAR(lists.values[i], loop.values[i], 1e-6f * loop.values[i]);
}

TEST(Clusters, LightsWithAndWithoutRangeMix) {
    Scene scene = floorWithLights(50, 3.0);
    const Scene others = floorWithLights(5, {});
    scene.lights.insert(scene.lights.begin() + 20, others.lights.begin(), others.lights.end());
    const Image lists = render(scene, overview(), smallPicture({.samples = 1, .gbufferBits = 32}));
    const Image loop =
        render(scene, overview(), smallPicture({.samples = 1, .gbufferBits = 32, .clusterFrom = 0}));
    const double budget = 55 * 6e-8 * 2;  // the order of 55 positive terms differs
    for (size_t i = 0; i < lists.values.size(); ++i)
        ASSERT_NEAR(lists.values[i], loop.values[i], budget * static_cast<double>(loop.values[i]));
}

/// Spheres of models that have a bound over a floor, with lights of very different intensities.
Scene boundedScene(unsigned seed) {
    Scene scene = floorWithLights(0, {});
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const char* model :
         {"oren_nayar", "phong", "blinn_phong", "ggx", "beckmann_smith", "metallic_roughness"}) {
        const int material = addMaterial(scene, model);
        scene.materials.back().values = requireBrdf(model).fromMetallicRoughness(
            {{unit(random), unit(random), unit(random)}, unit(random), 0.5 + 0.5 * unit(random)});
        addInstance(scene, addSphere(scene, material, 24),
                    glm::translate(glm::dmat4(1.0),
                                   glm::dvec3(12.0 * unit(random) - 6.0, 1.0, 12.0 * unit(random) - 6.0)));
    }
    for (int i = 0; i < 60; ++i) {
        const glm::dvec3 position(30.0 * unit(random) - 15.0, 0.3 + 3.0 * unit(random),
                                  30.0 * unit(random) - 15.0);
        const glm::dvec3 intensity =
            std::pow(10.0, 2.0 * unit(random) - 4.0) * glm::dvec3(unit(random), unit(random), unit(random));
        scene.lights.push_back(i % 3
                                   ? point(position, intensity)
                                   : spot(position, position - glm::dvec3(0.3, 1, 0.2), intensity, 0.4, 0.8));
        if (i % 4 == 0) scene.lights.back().range = 1.0 + 9.0 * unit(random);
    }
    return scene;
}

TEST(LightThreshold, WhatIsLeftOutNeverExceedsIt) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const Scene scene = boundedScene(seed);
        const Quality all{.samples = 1, .gbufferBits = 32, .shadows = Shadows::none};
        const Image full = render(scene, overview(), smallPicture(all));
        double largestOfAll = 0.0;
        for (const int threshold : {1, 10, 100}) {
            Quality some = all;
            some.lightThreshold = threshold;
            const Image less = render(scene, overview(), smallPicture(some));
            double largest = 0.0;
            for (size_t i = 0; i < full.values.size(); ++i) {
                const double error =
                    static_cast<double>(full.values[i]) - static_cast<double>(less.values[i]);
                // 60 terms in another order.
                ASSERT_GE(error, -60 * 6e-8 * static_cast<double>(full.values[i]));
                largest = std::max(largest, error);
            }
            ASSERT_LE(largest, threshold / 1000.0 + 1e-6) << "seed " << seed;
            largestOfAll = std::max(largestOfAll, largest);
        }
        EXPECT_GT(largestOfAll, 0.0) << "nothing was left out";
    }
}

TEST(Clusters, NoPointWithinRangeIsMissed) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const bool orthographic : {false, true}) {
        Camera camera = lookAt({0, 0, 0}, {0.3, -0.2, -1}, 0.9);
        camera.orthographic = orthographic;
        camera.xMag = camera.yMag = 5.0;
        camera.zFar = 100.0;
        const View view = makeView(camera, 333, 250);
        const ClusterGrid grid(view, 0.5, 60.0);
        std::vector<LightVolume> lights;
        for (int i = 0; i < 300; ++i) {
            LightVolume light{(glm::dvec3(unit(random), unit(random), unit(random)) - 0.5) * 60.0,
                              0.2 + 6.0 * unit(random)};
            if (i % 2) {
                light.axis = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)) - 0.5);
                light.coneAngle = 0.05 + unit(random) * 1.4;
            }
            lights.push_back(light);
        }
        const ClusterLists lists = grid.assign(lights, 0);
        const glm::vec3 factors = grid.sliceFactors();
        int inside = 0;
        for (int n = 0; n < 40000; ++n) {
            const double x = unit(random) * 333, y = unit(random) * 250;
            const double z = 0.5 * std::pow(120.0, unit(random));
            const glm::dvec3 p = view.rayOrigin + x * view.rayOriginDx + y * view.rayOriginDy +
                                 z * (view.rayDirection + x * view.rayDirectionDx + y * view.rayDirectionDy);
            const float slice =
                std::clamp(std::log2(static_cast<float>(z)) * factors.x + factors.y, 0.0f, factors.z - 1.0f);
            const size_t cluster = (static_cast<size_t>(slice) * static_cast<size_t>(grid.rows()) +
                                    static_cast<size_t>(y) / 64) *
                                       static_cast<size_t>(grid.columns()) +
                                   static_cast<size_t>(x) / 64;
            for (uint32_t l = 0; l < lights.size(); ++l) {
                const glm::dvec3 v = p - lights[l].center;
                if (glm::length(v) >= lights[l].radius) continue;
                if (lights[l].coneAngle > 0.0 &&
                    glm::dot(glm::normalize(v), lights[l].axis) < std::cos(lights[l].coneAngle))
                    continue;
                ++inside;
                const auto first = lists.indices.begin() + lists.ranges[2 * cluster];
                ASSERT_TRUE(std::find(first, first + lists.ranges[2 * cluster + 1], l) !=
                            first + lists.ranges[2 * cluster + 1])
                    << "light " << l << " at " << x << ", " << y << ", " << z
                    << (orthographic ? " orthographic" : "");
            }
        }
        EXPECT_GT(inside, 1000);
    }
}

}  // namespace
}  // namespace lobe
