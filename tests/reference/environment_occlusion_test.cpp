/// What keeps the prefiltered environment from surfaces, against the reference, which casts rays.
#include <gtest/gtest.h>

#include <tuple>

#include "environment/pictures.hpp"
#include "reference/pictures.hpp"

namespace lobe::reference {
namespace {

constexpr int kWidth = 48, kHeight = 32;

/// A ball on the floor before a wall.
Scene corner(const char* model, double roughness, double metallic) {
    Scene scene;
    const int material = test::addMaterial(scene, model);
    scene.materials[0].values =
        requireBrdf(model).fromMetallicRoughness({glm::dvec3(0.8, 0.7, 0.5), metallic, roughness});
    const int quad = test::addQuad(scene, material, 4.0F);
    test::addInstance(scene, quad,
                      glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0)));
    test::addInstance(scene, quad, glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -1.5)));
    test::addInstance(scene, test::addSphere(scene, material, 48),
                      glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 1.0, 0.0)));
    scene.images.push_back(test::directionPicture(128, 64, test::skyWithLamps));
    scene.environment = Environment{};
    scene.environment->image = 0;
    return scene;
}

Camera camera() {
    Camera camera = lookAt({0.8, 2.2, 6.0}, {0.0, 0.8, -0.3}, 0.62);
    camera.zNear = 0.01;
    return camera;
}

Quality withOcclusion(AmbientOcclusion occlusion) {
    Quality quality = exact();
    quality.samples = 16;
    quality.shadows = Shadows::soft;
    quality.ambientOcclusion = occlusion;
    return quality;
}

Image drawn(gl::Context& context, const Scene& scene, const Camera& from, const Quality& quality) {
    RenderOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.quality = quality;
    return test::render(context, scene, from, options);
}

Image drawn(const Scene& scene, const Quality& quality) {
    return drawn(test::eglContext(), scene, camera(), quality);
}

struct Surface {
    const char* model;
    double roughness, metallic;
    double low, high;  ///< share of the mean that is allowed
};

class EnvironmentOcclusion : public testing::TestWithParam<Surface> {};

/// Pictures of 16 jittered frames against rays through pixels' centres: edges are in both errors. The bounds
/// are half as much again as was measured.
TEST_P(EnvironmentOcclusion, IsNearerToTheReferenceThanWithout) {
    const auto& [model, roughness, metallic, low, high] = GetParam();
    const Scene scene = corner(model, roughness, metallic);
    const auto truths = truthOf(scene, camera(), kWidth, kHeight, 1e-2, true);
    const auto [without, biasWithout] = errorOf(drawn(scene, withOcclusion(AmbientOcclusion::off)), truths);
    const auto [withLow, biasLow] = errorOf(drawn(scene, withOcclusion(AmbientOcclusion::low)), truths);
    const auto [withHigh, biasHigh] = errorOf(drawn(scene, withOcclusion(AmbientOcclusion::high)), truths);
    std::printf("%s %.2f: off %.2f %% (bias %.2f %%), low %.2f %% (%.2f %%), high %.2f %% (%.2f %%)\n", model,
                roughness, 100 * without, 100 * biasWithout, 100 * withLow, 100 * biasLow, 100 * withHigh,
                100 * biasHigh);
    EXPECT_LT(withLow, 0.6 * without);
    EXPECT_LT(withLow, low);
    EXPECT_LT(withHigh, high);
}

INSTANTIATE_TEST_SUITE_P(Models, EnvironmentOcclusion,
                         testing::Values(Surface{"lambert", 1.0, 0.0, 0.115, 0.128},
                                         Surface{"metallic_roughness", 0.3, 1.0, 0.68, 0.6},
                                         Surface{"metallic_roughness", 0.7, 0.0, 0.116, 0.126}));

/// Nothing is in the way of a plane, nor under a white texture: of its lobe as little as of its irradiance.
TEST(EnvironmentOcclusions, PlanesAreOpen) {
    for (const auto& [model, roughness, metallic] :
         {std::tuple("lambert", 1.0, 0.0), std::tuple("metallic_roughness", 0.3, 1.0),
          std::tuple("metallic_roughness", 0.7, 1.0), std::tuple("metallic_roughness", 1.0, 1.0)}) {
        Scene scene = corner(model, roughness, metallic);
        scene.instances.resize(1);
        const Image without = drawn(scene, withOcclusion(AmbientOcclusion::off));
        const Image low = drawn(scene, withOcclusion(AmbientOcclusion::low));
        scene.materials[0].occlusionTexture.texture =
            test::addImage(scene, 1, 1, 3, [](int, int, int) { return 255; });
        const Image white = drawn(scene, withOcclusion(AmbientOcclusion::off));
        for (size_t i = 0; i < without.values.size(); ++i) {
            ASSERT_NEAR(low.values[i], without.values[i], 5e-3F * without.values[i]) << model << roughness;
            ASSERT_NEAR(white.values[i], without.values[i], 5e-3F * without.values[i]) << model << roughness;
        }
    }
}

/// Linear depth in place of the reversed buffer, beside which there may be anything.
TEST(EnvironmentOcclusions, IsTheSameWithoutClipControl) {
    const Scene scene = corner("lambert", 1.0, 0.0);
    const Quality quality = withOcclusion(AmbientOcclusion::low);
    const Image reversed = drawn(scene, quality);
    test::eglContext().release();
    const auto masked =
        gl::Context::create({.backend = gl::Backend::egl, .maskedExtensions = {"GL_ARB_clip_control"}});
    const Image linear = drawn(*masked, scene, camera(), quality);
    masked->release();
    // A look that falls between two texels may see the other one: one of 24 in a frame of 16.
    size_t apart = 0;
    for (size_t i = 0; i < reversed.values.size(); ++i)
        apart += std::abs(reversed.values[i] - linear.values[i]) > 3e-3F * reversed.values[i] ? 1U : 0U;
    EXPECT_LT(apart, reversed.values.size() / 100);
}

TEST(EnvironmentOcclusions, StaysFiniteAtEveryScaleAndProjection) {
    for (const double scale : {1e-4, 1.0, 1e5})
        for (const bool orthographic : {false, true}) {
            Scene scene = corner("metallic_roughness", 0.3, 0.5);
            for (Instance& instance : scene.instances)
                instance.worldFromLocal =
                    glm::scale(glm::dmat4(1.0), glm::dvec3(scale)) * instance.worldFromLocal;
            for (const glm::dvec3& eye : {glm::dvec3(0.8, 2.2, 6.0), glm::dvec3(0.0, 1.0, 0.5)}) {
                Camera from = lookAt(scale * eye, scale * glm::dvec3(0.0, 0.8, -0.3), 0.62);
                from.zNear = 1e-3 * scale;
                from.orthographic = orthographic;
                from.xMag = from.yMag = 2.0 * scale;
                from.zFar = 100.0 * scale;
                const Image image =
                    drawn(test::eglContext(), scene, from, withOcclusion(AmbientOcclusion::low));
                for (float value : image.values)
                    ASSERT_TRUE(std::isfinite(value) && value >= 0.0F) << scale << ' ' << orthographic;
            }
        }
}

/// A plane in an environment of 1, under a texture that lets a fifth through, in full and in half strength:
/// deferred and forward, and not where shadows are off.
TEST(EnvironmentOcclusions, TexturesDimWhatIsPrefiltered) {
    Scene scene;
    const int material = test::addMaterial(scene, "lambert");
    test::setParameter(scene.materials[0], "diffuse", glm::dvec3(0.8));
    test::addInstance(scene, test::addQuad(scene, material, 20.0F));
    scene.environment = Environment{};
    const int texture = test::addImage(scene, 1, 1, 3, [](int, int, int) { return 51; });
    scene.materials[0].occlusionTexture.texture = texture;
    for (const Shading shading : {Shading::deferred, Shading::forward})
        for (const float strength : {1.0F, 0.5F})
            for (const Shadows shadows : {Shadows::none, Shadows::soft}) {
                scene.materials[0].occlusionStrength = strength;
                Quality quality = exact();
                quality.shading = shading;
                quality.shadows = shadows;
                quality.gbufferBits = 16;
                quality.ambientOcclusion = AmbientOcclusion::off;
                const Image image = drawn(scene, quality);
                const float share = shadows == Shadows::none ? 1.0F : 1.0F + strength * (0.2F - 1.0F);
                EXPECT_NEAR(image.pixel(20, 16)[0], 0.8F * share, 2e-3F)
                    << static_cast<int>(shading) << ' ' << strength << ' ' << static_cast<int>(shadows);
            }
}

}  // namespace
}  // namespace lobe::reference
