/// Pictures of surfaces under lights with a body, drawn with OpenGL, against the reference.
#include <gtest/gtest.h>

#include "body_pictures.hpp"

namespace lobe::reference {
namespace {

class BodyPicture : public testing::TestWithParam<std::tuple<LightType, const char*>> {
protected:
    Scene scene() const {
        Scene made = ballOnGround(std::get<1>(GetParam()));
        made.lights.push_back(body(std::get<0>(GetParam())));
        return made;
    }
    std::string name() const {
        return std::string(nameOf(std::get<0>(GetParam()))) + " " + std::get<1>(GetParam());
    }
};

TEST_P(BodyPicture, UnshadowedAgreesWithTheReference) {
    const Scene made = scene();
    const auto truths = truth(made, false, 1e-3);
    Quality quality = exact();
    const Image analytic = drawn(made, quality);
    const Error closed = compareWith(analytic, truths);
    print((name() + " as planned").c_str(), closed);
    EXPECT_FALSE(closed.bad);
    EXPECT_GT(closed.compared, kWidth * kHeight / 2);
    quality.areaLights = AreaLights::sampled;
    double before = 0.0;
    for (int points : {16, 256}) {
        quality.lightSamples = points;
        const Error sampled = compareWith(drawn(made, quality), truths);
        print((name() + " " + std::to_string(points) + " points").c_str(), sampled);
        EXPECT_FALSE(sampled.bad);
        if (points == 256) {
            EXPECT_LT(sampled.mean, 2e-4);
            // 1/16^2 for smooth integrands; the horizon and the edges of balls are not.
            EXPECT_LT(sampled.rms, 0.1 * before);
            EXPECT_LT(std::abs(sampled.missing), 1e-4);
        }
        before = sampled.rms;
    }
    if (std::string(std::get<1>(GetParam())) == "lambert") {
        EXPECT_LT(closed.mean, 2e-5);
        EXPECT_LT(closed.largest, 1e-3);
    }
}

TEST_P(BodyPicture, ShadowedAgreesWithTheReference) {
    const Scene made = scene();
    const auto truths = truth(made, true, 5e-3);
    Quality quality = exact();
    quality.shadows = Shadows::soft;
    // What fits are off by is tested by itself (tests/fit); here it would hide what shadows are.
    if (std::string(std::get<1>(GetParam())) != "lambert") quality.areaLights = AreaLights::sampled;
    double before = 0.0;
    for (int points : {4, 64}) {
        quality.lightSamples = points;
        const Error error = compareWith(drawn(made, quality), truths);
        print((name() + " shadowed " + std::to_string(points)).c_str(), error);
        EXPECT_FALSE(error.bad);
        if (points == 64) {
            EXPECT_LT(error.mean, 4e-3);
            // 16^(-3/4) = 1/8 where an edge crosses the light; the reference errs by 5e-3 itself.
            EXPECT_LT(error.rms, 0.35 * before);
            EXPECT_LT(std::abs(error.missing), 5e-4);
        }
        before = error.rms;
    }
}

INSTANTIATE_TEST_SUITE_P(TypesAndModels, BodyPicture,
                         testing::Combine(testing::Values(LightType::rect, LightType::disk, LightType::sphere,
                                                          LightType::tube),
                                          testing::Values("lambert", "ggx", "phong")));

/// A mirror shows the nearest of all bodies, sharply.
TEST(BodyPictures, AMirrorShowsTheBodies) {
    Scene made = ballOnGround("lambert");
    const int mirror = test::addMaterial(made, "mirror");
    made.primitives[1].material = mirror;
    for (LightType type : {LightType::rect, LightType::disk, LightType::sphere, LightType::tube}) {
        Light light = body(type);
        light.position = glm::dvec3(-0.9 + 0.6 * (static_cast<int>(type) - 3), 1.0, 1.0);
        light.direction = glm::normalize(glm::dvec3(0.1, 0.3, 0.0) - light.position);
        light.axis = glm::normalize(glm::cross(light.direction, glm::dvec3(0.2, 0.9, 0.3)));
        made.lights.push_back(light);
    }
    for (bool shadows : {false, true}) {
        const auto truths = truth(made, shadows, 5e-3);
        Quality quality = exact();
        if (shadows) quality.shadows = Shadows::soft;
        quality.lightSamples = 64;
        const Error error = compareWith(drawn(made, quality), truths);
        print(shadows ? "mirror, shadowed" : "mirror", error);
        EXPECT_FALSE(error.bad);
        EXPECT_LT(error.mean, 3e-3);
        const Image parts = drawn(made, quality, {Aov::radiance, Aov::materialId, Aov::contributions});
        double largest = 0.0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const float* pixel = parts.pixel(x, y);
                const PixelTruth& expected = truths[static_cast<size_t>(y * kWidth + x)];
                if (static_cast<int>(pixel[channelOf(parts, "material.id")]) != 3 || expected.material != 3)
                    continue;
                for (LightType type :
                     {LightType::rect, LightType::disk, LightType::sphere, LightType::tube}) {
                    const double got =
                        static_cast<double>(pixel[channelOf(parts, std::string(nameOf(type)) + ".R")]);
                    const double wanted = expected.radiance[static_cast<size_t>(sourceOf(type))].x;
                    // A body's edge may fall on the other side of the pixel's centre.
                    if (got > 0.0 && wanted > 0.0) largest = std::max(largest, std::abs(got / wanted - 1.0));
                }
            }
        EXPECT_LT(largest, 1e-3);
    }
}

/// Lights as no scene should have them, each over every model.
std::vector<Light> extremes(LightType type) {
    std::vector<Light> lights;
    const auto add = [&](const glm::dvec3& position, double size, double intensity) {
        Light light = body(type);
        light.range.reset();
        light.position = position;
        light.width = light.height = light.length = 2.0 * size;
        light.radius = size;
        light.intensity = glm::dvec3(intensity);
        lights.push_back(light);
    };
    const bool flat = type == LightType::rect || type == LightType::disk;
    add({-1.9, 0.95, 0.6}, 0.3, 1.0);                           // cuts the first ball
    add({-0.95, 0.95, test::kModelRadius + 1e-7}, 1e-3, 1e-3);  // touches the second
    add({0.0, 0.95, 0.0}, 0.1, 0.1);                            // inside the third
    add({0.95, 0.0, 0.9}, 1e-6, flat ? 1e12 : 1.0);             // tiny
    add({0.0, 0.0, 2e4}, 1e4, flat ? 0.1 : 1e7);                // huge
    add({3e5, 9e5, 3e5}, 1e4, flat ? 100.0 : 1e11);             // far away
    lights.back().direction = -glm::normalize(lights.back().position);
    lights.back().axis = glm::normalize(glm::cross(lights.back().direction, glm::dvec3(0, 1, 0.1)));
    add({0.0, -1.2, 0.3}, 0.5, 0.3);
    lights.back().direction = {0.0, 0.0, 1.0};  // edge-on to much of what it is near
    lights.back().axis = {1.0, 0.0, 0.0};
    return lights;
}

class BodyExtremes : public testing::TestWithParam<LightType> {};

TEST_P(BodyExtremes, NothingIsNegativeOrNotFinite) {
    Scene made = test::modelsAndLights();
    made.ambientRadiance.reset();
    made.lights = extremes(GetParam());
    for (const Shadows shadows : {Shadows::none, Shadows::soft}) {
        Quality quality = exact();
        quality.shadows = shadows;
        quality.lightSamples = 4;
        const Image image = test::render(made, test::frontCamera(), test::smallPicture(quality));
        double sum = 0.0;
        for (size_t i = 0; i < image.values.size(); ++i) {
            ASSERT_TRUE(std::isfinite(image.values[i]) && image.values[i] >= 0.0f) << i;
            sum += static_cast<double>(image.values[i]);
        }
        EXPECT_GT(sum, 0.0);
    }
}

/// Forward shading is the same sum of the same points.
TEST_P(BodyExtremes, ForwardShadesAsDeferredDoes) {
    Scene made = ballOnGround("lambert");
    made.primitives[1].material = test::addMaterial(made, "ggx");
    test::addInstance(made, test::addSphere(made, test::addMaterial(made, "mirror"), 24),
                      glm::scale(glm::translate(glm::dmat4(1.0), {0.8, 0.3, 0.2}), glm::dvec3(0.3)));
    made.lights = {body(GetParam()), body(GetParam())};
    made.lights[1].position = {0.8, 0.9, 1.2};
    made.lights[1].direction = glm::normalize(glm::dvec3(-0.3, -0.5, -1.0));
    made.lights[1].axis = glm::normalize(glm::cross(made.lights[1].direction, glm::dvec3(1.0, 0.1, 0.0)));
    for (const Shadows shadows : {Shadows::none, Shadows::hard, Shadows::soft}) {
        Quality quality = exact();
        quality.normalBits = 32;
        quality.lightSamples = 4;
        quality.shadows = shadows;
        RenderOptions options = test::smallPicture(quality);
        const Image deferred = test::render(made, camera(), options);
        options.quality.shading = Shading::forward;
        const Image forward = test::render(made, camera(), options);
        // Positions differ in their last digits: a ray may pass an edge on its other side, and lobes of 1e-3
        // rad change.
        size_t apart = 0;
        for (size_t i = 0; i < deferred.values.size(); ++i)
            apart += std::abs(deferred.values[i] - forward.values[i]) > 1e-3f * deferred.values[i] + 1e-5f
                         ? 1u
                         : 0u;
        std::printf("%s: %zu of %zu values apart\n", nameOf(GetParam()), apart, deferred.values.size());
        EXPECT_LT(apart, deferred.values.size() / 50);
    }
}

INSTANTIATE_TEST_SUITE_P(Types, BodyExtremes,
                         testing::Values(LightType::rect, LightType::disk, LightType::sphere,
                                         LightType::tube));

/// Huge, tiny and far away, against the truth.
TEST(BodyPictures, ExtremeSizesAndDistancesAgreeWithTheReference) {
    for (LightType type : {LightType::rect, LightType::disk, LightType::sphere, LightType::tube}) {
        const bool flat = type == LightType::rect || type == LightType::disk;
        struct Extreme {
            const char* name;
            glm::dvec3 position;
            double size, intensity;
        };
        for (const Extreme& extreme : {Extreme{"huge", {0, 2e4, 1e3}, 1e4, flat ? 1.0 : 3e8},
                                       Extreme{"tiny", {-0.5, 1.0, 0.5}, 1e-6, flat ? 1e12 : 1.0},
                                       Extreme{"far", {4e5, 8e5, 4e5}, 1e4, flat ? 1e4 : 1e12}}) {
            Scene made = ballOnGround("lambert");
            Light light = body(type);
            light.range.reset();
            light.position = extreme.position;
            light.width = light.height = light.length = 2.0 * extreme.size;
            light.radius = extreme.size * (type == LightType::tube ? 0.3 : 1.0);
            light.intensity = glm::dvec3(extreme.intensity);
            light.direction = -glm::normalize(extreme.position);
            light.axis = glm::normalize(glm::cross(light.direction, glm::dvec3(0.2, 0.1, 1.0)));
            made.lights.push_back(light);
            const auto truths = truth(made, false, 1e-3);
            Quality quality = exact();
            const Error closed = compareWith(drawn(made, quality), truths);
            quality.areaLights = AreaLights::sampled;
            quality.lightSamples = 256;
            const Error sampled = compareWith(drawn(made, quality), truths);
            print((std::string(nameOf(type)) + " " + extreme.name).c_str(), closed);
            print("    sampled", sampled);
            EXPECT_LT(closed.mean, 2e-4);
            EXPECT_LT(sampled.mean, 1e-3);
            EXPECT_FALSE(closed.bad || sampled.bad);
        }
    }
}

}  // namespace
}  // namespace lobe::reference
