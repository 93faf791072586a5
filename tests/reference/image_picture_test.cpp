/// Pictures of surfaces under rects that show an image, drawn with OpenGL, against the reference.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>

#include "body_pictures.hpp"
#include "reference/explanation.hpp"

namespace lobe::reference {
namespace {

using Color = std::function<glm::vec3(int, int)>;

int addPicture(Scene& scene, int width, int height, const Color& color) {
    Bitmap bitmap{width, height, 3, ComponentType::f32, {}};
    std::vector<float> values;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                values.push_back(color(x, y)[c]);
    bitmap.data.resize(values.size() * sizeof(float));
    std::memcpy(bitmap.data.data(), values.data(), bitmap.data.size());
    scene.images.push_back(std::move(bitmap));
    scene.imageNames.emplace_back("picture");
    return static_cast<int>(scene.images.size()) - 1;
}

/// Panes of strong colours, black ones among them.
glm::vec3 panes(int x, int y) {
    const int n = x / 3 + 3 * (y / 2);
    return {n % 2 == 0 ? 1.0F : 0.02F, n % 3 == 0 ? 1.0F : 0.05F, n % 5 < 2 ? 0.9F : 0.0F};
}

/// Red, green / blue, white.
glm::vec3 corners(int x, int y) {
    return {x == y ? 1.0F : 0.0F, x == 1 ? 1.0F : 0.0F, y == 1 ? 1.0F : 0.0F};
}

Scene litBy(const std::string& model, int width, int height, const Color& color) {
    Scene made = ballOnGround(model);
    made.lights.push_back(body(LightType::rect));
    made.lights[0].image = addPicture(made, width, height, color);
    return made;
}

class ImagePicture : public testing::TestWithParam<const char*> {};

TEST_P(ImagePicture, UnshadowedAgreesWithTheReference) {
    const std::string model = GetParam();
    const Scene made = litBy(model, 12, 8, panes);
    const auto truths = truth(made, false, 2e-3);
    Quality quality = exact();
    const Error closed = compareWith(drawn(made, quality), truths);
    print((model + " as planned").c_str(), closed);
    EXPECT_FALSE(closed.bad);
    EXPECT_GT(closed.compared, kWidth * kHeight / 2);
    EXPECT_LT(closed.mean, model == "ggx" ? 0.06 : 0.01);
    EXPECT_LT(std::abs(closed.missing), 0.01);
    quality.areaLights = AreaLights::sampled;
    double before = 0.0;
    for (int points : {16, 256, 4096}) {
        quality.lightSamples = points;
        const Error sampled = compareWith(drawn(made, quality), truths);
        print((model + " " + std::to_string(points) + " points").c_str(), sampled);
        EXPECT_FALSE(sampled.bad);
        if (points == 16) {
            EXPECT_LT(sampled.mean, 0.1);
        }
        if (points == 256) {
            EXPECT_LT(sampled.mean, 6e-3);
            EXPECT_LT(sampled.rms, 0.35 * before);
        }
        if (points == 4096) {
            EXPECT_LT(sampled.mean, 1e-3);
        }
        before = sampled.rms;
    }
}

TEST_P(ImagePicture, ShadowedAgreesWithTheReference) {
    const std::string model = GetParam();
    const Scene made = litBy(model, 12, 8, panes);
    const auto truths = truth(made, true, 1e-2);
    Quality quality = exact();
    quality.shadows = Shadows::soft;
    for (int points : {16, 256}) {
        quality.lightSamples = points;
        const Error error = compareWith(drawn(made, quality), truths);
        print((model + " shadowed " + std::to_string(points)).c_str(), error);
        EXPECT_FALSE(error.bad);
        if (points == 256) {
            EXPECT_LT(error.mean, model == "ggx" ? 0.06 : 0.015);
            EXPECT_LT(std::abs(error.missing), 0.01);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Models, ImagePicture, testing::Values("lambert", "ggx", "phong"));

/// Lobes alone, without Lambert's part, from broad to narrow. What the fit itself is off by is seen without a
/// picture.
TEST(ImagePictures, LobesShowThePictureAsWellAsTheyShowTheLight) {
    struct Case {
        const char* model;
        const char* width;
        double value, allowed;
    };
    for (const Case& one : {Case{"phong", "shininess", 5, 0.05}, Case{"phong", "shininess", 50, 0.05},
                            Case{"phong", "shininess", 500, 0.08}, Case{"ward", "alpha", 0.3, 0.05},
                            Case{"ward", "alpha", 0.1, 0.08}, Case{"cook_torrance", "m", 0.2, 0.08}}) {
        Scene shown = litBy(one.model, 12, 8, panes);
        for (Material& material : shown.materials) {
            test::setParameter(material, "diffuse", glm::dvec3(0.0));
            test::setParameter(material, "specular", glm::dvec3(1.0));
            test::setParameter(material, one.width, glm::dvec3(one.value));
        }
        Scene plain = shown;
        plain.lights[0].image = -1;
        const Error with = compareWith(drawn(shown, exact()), truth(shown, false, 5e-3));
        const Error without = compareWith(drawn(plain, exact()), truth(plain, false, 5e-3));
        const std::string name = std::string(one.model) + " " + std::to_string(one.value);
        print((name + " with the picture").c_str(), with);
        print("    without", without);
        EXPECT_FALSE(with.bad);
        EXPECT_LT(with.mean, without.mean + one.allowed) << name;
    }
}

/// A black picture with one bright texel, in 16 jittered frames with nothing in the way: the share of its
/// light that arrives is all of it, though few points of any one frame meet the texel.
TEST(ImagePictures, SoftShadowsOfNothingTakeNothing) {
    Scene made =
        litBy("lambert", 64, 64, [](int x, int y) { return glm::vec3(x == 40 && y == 23 ? 1e3F : 0.0F); });
    for (Instance& instance : made.instances)
        instance.castsShadow = false;
    test::addInstance(made, test::addQuad(made, 0, 1.0F),
                      glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, -1e3, 0.0)));
    Quality quality = exact();
    quality.samples = 16;
    const Image open = drawn(made, quality);
    quality.shadows = Shadows::soft;
    const Image shadowed = drawn(made, quality);
    double lost = 0.0, all = 0.0;
    for (size_t i = 0; i < open.values.size(); ++i) {
        lost += std::abs(static_cast<double>(open.values[i]) - static_cast<double>(shadowed.values[i]));
        all += static_cast<double>(open.values[i]);
    }
    std::printf("lost: %.3f %%\n", 100.0 * lost / all);
    const auto mean = static_cast<float>(all / static_cast<double>(open.values.size()));
    for (size_t i = 0; i < open.values.size(); ++i)
        if (open.values[i] > 0.01F * mean) {
            ASSERT_NEAR(shadowed.values[i], open.values[i], open.values[i] / 16.0F) << i;
        }
    EXPECT_LT(lost, 1e-3 * all);
}

/// One colour all over is a light of that colour, to the last digits, by every method.
TEST(ImagePictures, OneColorIsALightOfThatColor) {
    for (const char* model : {"lambert", "ggx", "phong"}) {
        const Scene shown = litBy(model, 5, 3, [](int, int) { return glm::vec3(0.5, 0.25, 2.0); });
        Scene plain = shown;
        plain.lights[0].image = -1;
        plain.lights[0].intensity *= glm::dvec3(0.5, 0.25, 2.0);
        for (const AreaLights method : {Quality{}.areaLights, AreaLights::sampled})
            for (const Shadows shadows : {Shadows::none, Shadows::soft}) {
                Quality quality = exact();
                quality.areaLights = method;
                quality.shadows = shadows;
                const Image a = drawn(shown, quality), b = drawn(plain, quality);
                double largest = 0.0;
                for (size_t i = 0; i < a.values.size(); ++i)
                    largest = std::max(largest, std::abs(static_cast<double>(a.values[i] - b.values[i])) /
                                                    (1e-4 + static_cast<double>(b.values[i])));
                EXPECT_LT(largest, 1e-5) << model;
            }
    }
}

/// Which corner is where, without the reference: a rect close over the floor colours each quarter of it.
TEST(ImagePictures, CornersAreWhereTheFormatSays) {
    Scene made;
    test::addInstance(made, test::addQuad(made, test::addMaterial(made, "lambert"), 1.0F));
    Light light;
    light.type = LightType::rect;
    light.direction = {0, 0, -1};
    light.axis = {1, 0, 0};
    light.position = {0, 0, 0.15};
    light.width = light.height = 2.0;
    light.intensity = glm::dvec3(1.0);
    light.image = addPicture(made, 2, 2, corners);
    made.lights = {light};
    // From under the floor's front one looks down on it: the light is above the floor and shines down, its
    // picture is mirrored as seen through it. Its first texel is at +X, +Y.
    for (const AreaLights method : {Quality{}.areaLights, AreaLights::sampled}) {
        Quality quality = exact();
        quality.areaLights = method;
        const Image image = test::render(made, test::frontCamera(), test::smallPicture(quality));
        const auto at = [&](double x, double y) {
            const float* pixel = image.pixel(static_cast<int>(48 + 15 * x), static_cast<int>(32 - 15 * y));
            return glm::vec3(pixel[0], pixel[1], pixel[2]);
        };
        const glm::vec3 first = at(1, 1), second = at(-1, 1), third = at(1, -1), fourth = at(-1, -1);
        EXPECT_GT(first.r, 4 * first.g);  // red
        EXPECT_GT(first.r, 4 * first.b);
        EXPECT_GT(second.g, 4 * second.r);  // green
        EXPECT_GT(second.g, 4 * second.b);
        EXPECT_GT(third.b, 4 * third.r);  // blue
        EXPECT_GT(third.b, 4 * third.g);
        EXPECT_GT(std::min({fourth.r, fourth.g, fourth.b}), 0.8F * std::max({fourth.r, fourth.g, fourth.b}));
    }
}

/// Pictures of several sizes are in one texture; a mirror shows each as it is.
TEST(ImagePictures, AMirrorShowsThem) {
    Scene made = ballOnGround("lambert");
    made.primitives[1].material = test::addMaterial(made, "mirror");
    const std::pair<int, int> sizes[] = {{12, 8}, {5, 31}, {1, 1}};
    for (int i = 0; i < 4; ++i) {
        Light light = body(LightType::rect);
        light.position = glm::dvec3(-0.9 + 0.6 * i, 1.0, 1.0);
        light.direction = glm::normalize(glm::dvec3(0.1, 0.3, 0.0) - light.position);
        light.axis = glm::normalize(glm::cross(light.direction, glm::dvec3(0.2, 0.9, 0.3)));
        if (i < 3) light.image = addPicture(made, sizes[i].first, sizes[i].second, panes);
        made.lights.push_back(light);
    }
    const auto truths = truth(made, false, 5e-3);
    Quality quality = exact();
    const Image image = drawn(made, quality);
    const size_t id = channelOf(image, "material.id");
    double largest = 0.0;
    int seen = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float* pixel = image.pixel(x, y);
            const PixelTruth& expected = truths[static_cast<size_t>(y * kWidth + x)];
            if (static_cast<int>(pixel[id]) != 3 || expected.material != 3) continue;
            for (int c = 0; c < 3; ++c) {
                const double got = static_cast<double>(pixel[c]), wanted = expected.total()[c];
                // A light's edge may fall on the other side of the pixel's centre.
                if (!(got > 0.0 && wanted > 0.0)) continue;
                largest = std::max(largest, std::abs(got - wanted));
                ++seen;
            }
        }
    std::printf("mirror: largest difference %.2e of %d values\n", largest, seen);
    EXPECT_GT(seen, 20);
    EXPECT_LT(largest, 2e-4);
}

TEST(ImagePictures, ForwardShadesAsDeferredDoes) {
    Scene made = litBy("lambert", 12, 8, panes);
    made.primitives[1].material = test::addMaterial(made, "ggx");
    test::addInstance(made, test::addSphere(made, test::addMaterial(made, "mirror"), 24),
                      glm::scale(glm::translate(glm::dmat4(1.0), {0.8, 0.3, 0.2}), glm::dvec3(0.3)));
    made.lights.push_back(body(LightType::sphere));
    made.lights.push_back(body(LightType::rect));
    made.lights[2].position = {0.8, 0.9, 1.2};
    for (const Shadows shadows : {Shadows::none, Shadows::hard, Shadows::soft}) {
        Quality quality = exact();
        quality.normalBits = 32;
        quality.lightSamples = 4;
        quality.shadows = shadows;
        RenderOptions options = test::smallPicture(quality);
        const Image deferred = test::render(made, camera(), options);
        options.quality.shading = Shading::forward;
        const Image forward = test::render(made, camera(), options);
        size_t apart = 0;
        for (size_t i = 0; i < deferred.values.size(); ++i)
            apart += std::abs(deferred.values[i] - forward.values[i]) > 1e-3f * deferred.values[i] + 1e-5f
                         ? 1u
                         : 0u;
        EXPECT_LT(apart, deferred.values.size() / 50);
    }
}

struct Extreme {
    const char* name;
    int width, height;
    Color color;
    std::function<void(Light&)> change;
    double allowed;  ///< of Error::mean, of the closed form
};

std::vector<Extreme> extremes() {
    const auto none = [](Light&) {};
    return {{"one texel", 1, 1, [](int, int) { return glm::vec3(0.5, 1.0, 2.0); }, none, 2e-5},
            {"a bright texel", 16, 16,
             [](int x, int y) { return glm::vec3(x == 5 && y == 10 ? 1e6F : 0.01F); }, none, 0.15},
            {"black", 4, 4, [](int, int) { return glm::vec3(0.0); }, none, 0.0},
            {"a line", 64, 1, [](int x, int) { return panes(x % 12, x % 7); },
             [](Light& light) {
                 light.width = 3.0;
                 light.height = 0.01;
             },
             0.02},
            {"a huge aspect, texels across", 2, 16, [](int x, int y) { return panes(3 * x, y % 8); },
             [](Light& light) {
                 light.width = 2000.0;
                 light.height = 0.2;
             },
             0.05},
            {"touching the ground", 12, 8, panes,
             [](Light& light) {
                 light.direction = glm::normalize(glm::dvec3(0.8, 0.0, -0.6));
                 light.axis = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), light.direction));
                 light.position = glm::dvec3(-0.7, 0.25, 0.4);
             },
             0.04},
            {"through the ground", 12, 8, panes,
             [](Light& light) {
                 light.direction = glm::normalize(glm::dvec3(0.8, 0.0, -0.6));
                 light.axis = glm::normalize(glm::cross(glm::dvec3(0.1, 1, 0), light.direction));
                 light.position = glm::dvec3(-0.7, 0.02, 0.4);
             },
             0.04},
            {"tiny", 12, 8, panes,
             [](Light& light) {
                 light.width = 3e-6;
                 light.height = 2e-6;
                 light.intensity *= 1e11;
             },
             2e-4},
            {"far", 12, 8, panes,
             [](Light& light) {
                 light.position = {4e5, 8e5, 4e5};
                 light.direction = -glm::normalize(light.position);
                 light.axis = glm::normalize(glm::cross(light.direction, glm::dvec3(0.2, 0.1, 1.0)));
                 light.width = 4e4;
                 light.height = 3e4;
                 light.intensity *= 1e3;
             },
             1e-3}};
}

TEST(ImagePictures, ExtremesAgreeWithTheReference) {
    for (const Extreme& extreme : extremes()) {
        Scene made = litBy("lambert", extreme.width, extreme.height, extreme.color);
        extreme.change(made.lights[0]);
        const auto truths = truth(made, false, 3e-3);
        Quality quality = exact();
        const Error closed = compareWith(drawn(made, quality), truths);
        quality.areaLights = AreaLights::sampled;
        quality.lightSamples = 1024;
        const Error sampled = compareWith(drawn(made, quality), truths);
        print(extreme.name, closed);
        print("    sampled", sampled);
        EXPECT_FALSE(closed.bad || sampled.bad) << extreme.name;
        if (extreme.allowed == 0.0) {
            EXPECT_EQ(closed.largest, 0.0);
            EXPECT_EQ(sampled.largest, 0.0);
        } else {
            EXPECT_LT(closed.mean, extreme.allowed) << extreme.name;
        }
    }
}

/// Every model, every method, under all of the above at once.
TEST(ImagePictures, NothingIsNegativeOrNotFinite) {
    for (const Extreme& extreme : extremes()) {
        Scene made = test::modelsAndLights();
        made.ambientRadiance.reset();
        made.lights = {body(LightType::rect)};
        made.lights[0].image = addPicture(made, extreme.width, extreme.height, extreme.color);
        extreme.change(made.lights[0]);
        made.lights.push_back(made.lights[0]);
        made.lights[1].position = {-0.95, 0.95, test::kModelRadius + 1e-7};
        for (const Shadows shadows : {Shadows::none, Shadows::soft}) {
            Quality quality = exact();
            quality.shadows = shadows;
            quality.lightSamples = 4;
            const Image image = test::render(made, test::frontCamera(), test::smallPicture(quality));
            for (size_t i = 0; i < image.values.size(); ++i)
                ASSERT_TRUE(std::isfinite(image.values[i]) && image.values[i] >= 0.0f)
                    << extreme.name << " " << i;
        }
    }
}

/// Each light's share of a pixel, the picture's among them, adds up to the truth.
TEST(ImagePictures, AreExplained) {
    const auto made = std::make_shared<Scene>(litBy("lambert", 12, 8, panes));
    const PixelIntegrator integrator(made, camera(), kWidth, kHeight, {});
    Effort effort;
    effort.relativeError = 0.005;
    const Explanation explained = explain(integrator, *made, kWidth / 2, kHeight - 4, effort, true);
    ASSERT_EQ(explained.surfaces.size(), 1U);
    ASSERT_EQ(explained.surfaces[0].lights.size(), 1U);
    const LightShare& share = explained.surfaces[0].lights[0];
    EXPECT_GT(share.radiance.y, 0.0);
    EXPECT_NEAR(share.radiance.y, explained.truth.total().y,
                6.0 * std::hypot(share.error.y, std::sqrt(explained.truth.variance.y)) + 1e-9);
}

}  // namespace
}  // namespace lobe::reference
