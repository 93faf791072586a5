/// Pictures of surfaces in an environment, drawn with OpenGL, against the reference.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "environment/pictures.hpp"
#include "reference/pictures.hpp"

namespace lobe::reference {
namespace {

constexpr int kWidth = 30, kHeight = 16;

struct Surface {
    const char* model;
    double roughness, metallic;
    double prefiltered = 0.0;  ///< what it is off by at most, a share of the mean
};

/// A ball, fine enough that its normals are those of a sphere.
Scene ball(const Surface& surface) {
    Scene scene;
    for (int i = 0; i < 3; ++i) {
        const int material = test::addMaterial(scene, surface.model);
        const Brdf& brdf = requireBrdf(surface.model);
        if (brdf.fromMetallicRoughness)
            scene.materials[static_cast<size_t>(material)].values =
                brdf.fromMetallicRoughness({glm::dvec3(0.8, 0.7, 0.5), surface.metallic, surface.roughness});
    }
    test::addInstance(scene, test::addSphere(scene, 0, 64), glm::scale(glm::dmat4(1.0), glm::dvec3(0.9)));
    scene.images.push_back(test::directionPicture(128, 64, test::skyWithLamps));
    scene.environment = Environment{};
    scene.environment->image = 0;
    return scene;
}

Camera camera() {
    Camera camera = lookAt({0.4, 0.7, 4.0}, {0.0, 0.0, 0.0}, 0.52);
    camera.zNear = 0.01;
    return camera;
}

Image drawn(const Scene& scene, const Quality& quality) {
    RenderOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.quality = quality;
    return test::render(scene, camera(), options);
}

std::vector<glm::dvec3> truth(const Scene& scene, double error, bool shadows = false) {
    return truthOf(scene, camera(), kWidth, kHeight, error, shadows);
}

class EnvironmentPicture : public testing::TestWithParam<Surface> {};

/// What `prefiltered` is off by, of the split sum with a dominant direction, has been measured for each
/// surface (docs/environment.md): the bounds are half as much again. Sampling has none but its noise.
TEST_P(EnvironmentPicture, AgreesWithTheReference) {
    const Scene scene = ball(GetParam());
    const auto truths = truth(scene, 5e-3);
    Quality quality = exact();
    const auto [off, bias] = errorOf(drawn(scene, quality), truths);
    quality.envLighting = EnvironmentLighting::sampled;
    quality.envSamples = 512;
    quality.samples = 1;
    const auto [noise, sampledBias] = errorOf(drawn(scene, quality), truths);
    std::printf("%s %.2f: prefiltered %.2f %%, bias %.2f %%; sampled %.2f %%, bias %.2f %%\n",
                GetParam().model, GetParam().roughness, 100 * off, 100 * bias, 100 * noise,
                100 * sampledBias);
    EXPECT_LT(off, GetParam().prefiltered);
    EXPECT_LT(noise, 0.01);
    EXPECT_LT(std::abs(sampledBias), 5e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Models, EnvironmentPicture,
    testing::Values(Surface{"lambert", 1.0, 0.0, 0.003}, Surface{"metallic_roughness", 0.2, 1.0, 0.041},
                    Surface{"metallic_roughness", 0.5, 0.0, 0.0075},
                    Surface{"metallic_roughness", 1.0, 1.0, 0.012}, Surface{"cook_torrance", 0.5, 1.0, 0.053},
                    Surface{"ward", 0.4, 1.0, 0.036}, Surface{"phong", 0.5, 1.0, 0.023},
                    Surface{"ashikhmin_shirley", 0.4, 1.0, 0.039}, Surface{"oren_nayar", 1.0, 0.0, 0.023},
                    Surface{"he", 0.5, 1.0, 0.09}));

TEST(EnvironmentPictures, MirrorAndBackgroundAreTheMapItself) {
    const Scene scene = ball({"mirror", 0.0, 1.0});
    const auto [off, bias] = errorOf(drawn(scene, exact()), truth(scene, 1e-3));
    EXPECT_LT(off, 2e-3);  // edges of lamps on either side of a pixel's ray
}

/// A light with a body before the environment hides it, deferred and forward.
TEST(EnvironmentPictures, MirrorsShowBodiesBeforeTheEnvironment) {
    Scene scene = ball({"mirror", 0.0, 1.0});
    Light body;
    body.type = LightType::sphere;
    body.position = {1.5, 1.5, 3.0};
    body.radius = 0.8;
    body.intensity = glm::dvec3(0.5);
    scene.lights.push_back(body);
    const auto truths = truth(scene, 1e-3);
    for (const Shading shading : {Shading::deferred, Shading::forward}) {
        Quality quality = exact();
        quality.shading = shading;
        const auto [off, bias] = errorOf(drawn(scene, quality), truths);
        EXPECT_LT(off, 4e-3) << "edges of lamps and of the body on either side of a pixel's ray";
    }
}

TEST(EnvironmentPictures, DiffuseByHarmonicsIsClose) {
    const Scene scene = ball({"lambert", 1.0, 0.0});
    const auto truths = truth(scene, 2e-3);
    for (const auto& [diffuse, bound] :
         {std::pair(EnvironmentDiffuse::map, 2e-3), std::pair(EnvironmentDiffuse::sh4, 0.0075),
          std::pair(EnvironmentDiffuse::sh2, 0.02)}) {
        Quality quality = exact();
        quality.envDiffuse = diffuse;
        const auto [off, bias] = errorOf(drawn(scene, quality), truths);
        std::printf("diffuse %d: %.3f %%\n", static_cast<int>(diffuse), 100 * off);
        EXPECT_LT(off, bound);
    }
}

TEST(EnvironmentPictures, ForwardShadesAsDeferredDoes) {
    for (const char* model : {"metallic_roughness", "mirror", "he"}) {
        const Scene scene = ball({model, 0.4, 0.5});
        Quality quality = exact();
        quality.normalBits = 32;
        const Image deferred = drawn(scene, quality);
        quality.shading = Shading::forward;
        const Image forward = drawn(scene, quality);
        size_t apart = 0;
        for (size_t i = 0; i < deferred.values.size(); ++i)
            apart += std::abs(deferred.values[i] - forward.values[i]) > 2e-3F * deferred.values[i] + 1e-5F
                         ? 1U
                         : 0U;
        EXPECT_LT(apart, deferred.values.size() / 50) << model;
    }
}

/// Behind fog and a pane, deferred and forward: contributions add up to the picture that is drawn without
/// them, to a few roundings of sums in another order, and so does coverage.
TEST(EnvironmentPictures, ContributionsAddUp) {
    Scene scene = ball({"metallic_roughness", 0.4, 0.5});
    scene.fog = Fog{};
    scene.fog->extinction = {0.05, 0.1, 0.2};
    scene.fog->radiance = {0.3, 0.2, 0.1};
    scene.fog->heightFalloff = 0.5;
    const int pane = test::addMaterial(scene, "metallic_roughness");
    scene.materials[static_cast<size_t>(pane)].alphaMode = AlphaMode::blend;
    scene.materials[static_cast<size_t>(pane)].alpha = 0.3F;
    test::addInstance(scene, test::addQuad(scene, pane, 0.5F),
                      glm::translate(glm::dmat4(1.0), glm::dvec3(0.4, 0.2, 2.0)));
    for (const Shading shading : {Shading::deferred, Shading::forward}) {
        RenderOptions options;
        options.width = kWidth;
        options.height = kHeight;
        options.quality = exact();
        options.quality.shading = shading;
        const Image plain = test::render(scene, camera(), options);
        options.aovs = {Aov::radiance, Aov::contributions};
        const Image split = test::render(scene, camera(), options);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                for (size_t c = 0; c < 4; ++c)
                    ASSERT_NEAR(split.pixel(x, y)[c], plain.pixel(x, y)[c],
                                8 * 6e-8F * (1.0F + plain.pixel(x, y)[c]))
                        << x << ", " << y << " channel " << c;
    }
}

/// A sphere of albedo A in an environment of 1 shows A.
TEST(EnvironmentPictures, WhiteFurnace) {
    for (double roughness : {0.05, 0.3, 0.7, 1.0}) {
        Scene scene = ball({"ggx", roughness, 1.0});
        scene.images.clear();
        scene.environment->image = -1;
        const auto truths = truth(scene, 2e-3);
        Quality quality = exact();
        const auto [off, bias] = errorOf(drawn(scene, quality), truths);
        quality.envLighting = EnvironmentLighting::sampled;
        quality.envSamples = 1024;
        const auto [noise, sampledBias] = errorOf(drawn(scene, quality), truths);
        std::printf("furnace, roughness %.2f: prefiltered %.3f %%, sampled %.3f %%, bias %.3f %%\n",
                    roughness, 100 * off, 100 * noise, 100 * sampledBias);
        EXPECT_LT(off, 5e-3);
        EXPECT_LT(std::abs(sampledBias), 5e-4);
    }
}

/// What no map should hold, at roughness 0 and 1, with the poles in view and the seam turned.
TEST(EnvironmentPictures, ExtremesStayFinite) {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(64, 32)}) {
        for (double roughness : {0.0, 1.0}) {
            Scene scene = ball({"metallic_roughness", roughness, 1.0});
            scene.images[0] = test::floatPicture(width, height, [&](int x, int y) {
                if (width == 1) return glm::vec3(2.0F);
                if (x == 3) return glm::vec3(std::numeric_limits<float>::quiet_NaN());
                if (x == 4) return glm::vec3(std::numeric_limits<float>::infinity());
                if (x == 5) return glm::vec3(-1.0F);
                return glm::vec3(x == 0 && y == 0 ? 1e6F : 0.0F);
            });
            scene.environment->worldFromMap =
                glm::dmat3(glm::rotate(glm::dmat4(1.0), 1.0, glm::dvec3(0.3, 0.9, 0.1)));
            for (const EnvironmentLighting lighting :
                 {EnvironmentLighting::prefiltered, EnvironmentLighting::sampled})
                for (const EnvironmentDiffuse diffuse :
                     {EnvironmentDiffuse::sh2, EnvironmentDiffuse::sh4, EnvironmentDiffuse::map}) {
                    Quality quality = exact();
                    quality.envLighting = lighting;
                    quality.envDiffuse = diffuse;
                    if (lighting == EnvironmentLighting::sampled && diffuse != EnvironmentDiffuse::map)
                        continue;
                    const Image image = drawn(scene, quality);
                    for (float value : image.values)
                        ASSERT_TRUE(std::isfinite(value) && value >= 0.0F);
                }
        }
    }
}

}  // namespace
}  // namespace lobe::reference
