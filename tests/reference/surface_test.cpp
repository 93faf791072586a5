// What a surface's materials, vertices and sides make of a point, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/tracer.hpp"
#include "support/scenes.hpp"

namespace lobe::reference {
namespace {

using namespace lobe::test;

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
    EXPECT_LT(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << ", expected " << b.x << ' ' << b.y << ' ' << b.z;
}

/// A square seen along the z axis, at x, y in it; a ray from behind where `fromZ` is negative.
SurfacePoint seen(const Scene& scene, double x = 0.25, double y = -0.5, double fromZ = 2.0) {
    const Tracer tracer(std::make_shared<const Scene>(scene), {0, 0, fromZ});
    std::vector<SurfacePoint> layers;
    tracer.surfacesAlong({{x, y, fromZ}, {0, 0, fromZ > 0.0 ? -1.0 : 1.0}}, nullptr, layers);
    if (layers.empty()) throw std::logic_error("nothing seen");
    return layers[0];
}

Scene square(const std::string& brdf) {
    Scene scene;
    addInstance(scene, addQuad(scene, addMaterial(scene, brdf), 1.0f));
    scene.materials[0].doubleSided = true;
    return scene;
}

TEST(Surface, TangentsKeepTheirSideAndHandedness) {
    for (const float handedness : {1.0f, -1.0f})
        for (const double fromZ : {2.0, -2.0}) {
            Scene scene = square("ggx");
            scene.primitives[0].tangents.assign(4, glm::vec4(0.6f, 0.8f, 0.0f, handedness));
            const SurfacePoint point = seen(scene, 0.25, -0.5, fromZ);
            const glm::dvec3 n(0, 0, fromZ > 0.0 ? 1.0 : -1.0);
            const glm::dvec3 t = glm::normalize(glm::dvec3(0.6f, 0.8f, 0.0));
            expectNear(point.normal, n);
            expectNear(point.tangent, t);
            expectNear(point.bitangent, static_cast<double>(handedness) * glm::cross(n, t));
        }
}

TEST(Surface, NormalsAreInterpolatedAndFollowTheInverseTranspose) {
    Scene scene = square("lambert");
    scene.primitives[0].normals = {{-0.6f, 0, 0.8f}, {0.6f, 0, 0.8f}, {0.6f, 0, 0.8f}, {-0.6f, 0, 0.8f}};
    expectNear(seen(scene, 0.5).normal, glm::normalize(glm::dvec3(0.3, 0, 0.8)),
               1e-7);  // floats in the scene
    scene.instances[0].worldFromLocal = glm::scale(glm::dmat4(1.0), glm::dvec3(-2.0, 1.0, 1.0));
    // Mirrored: the vertex at local +x is at world -x, with its normal leaning there.
    const glm::dvec3 steep = glm::normalize(glm::dvec3(0.6 / 2.0, 0, 0.8));
    expectNear(seen(scene, 1.0).normal, glm::normalize(glm::dvec3(steep.x * 0.5, 0, steep.z)), 1e-7);
    scene.primitives[0].normals.assign(4, glm::vec3(0.0f));
    EXPECT_EQ(seen(scene).normal, glm::dvec3(0, 0, 1));
}

TEST(Surface, NormalMapsTurnTheNormal) {
    Scene scene = square("lambert");
    const int texture = addImage(scene, 1, 1, 3, [](int, int, int c) {
        return c == 0 ? 204 : c == 1 ? 51 : 255;
    });
    scene.materials[0].normalTexture.texture = texture;
    scene.materials[0].normalScale = 0.5f;
    // Texel 0.8, 0.2, 1 = direction 0.6, -0.6, 1, whose first two are scaled.
    expectNear(seen(scene).normal, glm::normalize(glm::dvec3(0.3, -0.3, 1.0)));
    expectNear(seen(scene, 0.25, -0.5, -2.0).normal, -glm::normalize(glm::dvec3(0.3, -0.3, 1.0)));
    expectNear(seen(scene).geometricNormal, {0, 0, 1});
}

TEST(Surface, TexturesAndVertexColoursAreMultipliedIn) {
    Scene scene = square("metallic_roughness");
    Material& material = scene.materials[0];
    setParameter(material, "baseColor", glm::dvec3(0.5, 0.25, 1.0));
    setParameter(material, "roughness", glm::dvec3(0.5));
    const int texture = addImage(scene, 1, 1, 4, [](int, int, int c) { return c == 1 ? 51 : 255; });
    const Brdf& brdf = requireBrdf("metallic_roughness");
    const auto roughness = static_cast<size_t>(brdf.parameterIndex("roughness"));
    material.textures[roughness].texture = texture;
    material.textureChannels[roughness] = 1;
    scene.primitives[0].colors.assign(4, glm::vec4(0.5f, 1.0f, 0.25f, 0.5f));
    const SurfacePoint point = seen(scene);
    const auto value = [&](const char* name, size_t c) {
        return point.values()[static_cast<size_t>(brdf.valueOffset(brdf.parameterIndex(name))) + c];
    };
    EXPECT_EQ(point.constantValues, nullptr);
    EXPECT_NEAR(value("roughness", 0), 0.5 * 0.2, 1e-15);
    EXPECT_NEAR(value("baseColor", 0), 0.25, 1e-15);
    EXPECT_NEAR(value("baseColor", 1), 0.25, 1e-15);
    EXPECT_NEAR(value("baseColor", 2), 0.25, 1e-15);
    EXPECT_EQ(point.alpha, 1.0) << "opaque, whatever its colours' alpha";
    material.alphaMode = AlphaMode::blend;
    material.alpha = 0.5f;
    EXPECT_NEAR(seen(scene).alpha, 0.25, 1e-15);
}

TEST(Surface, EmissionOcclusionAndUnlit) {
    Scene scene = square("lambert");
    const int texture = addImage(scene, 1, 1, 3, [](int, int, int c) { return c == 0 ? 51 : 255; });
    Material& material = scene.materials[0];
    material.emission = glm::vec3(4.0f, 2.0f, 1.0f);
    material.emissionTexture.texture = texture;
    material.occlusionTexture.texture = texture;
    material.occlusionStrength = 0.5f;
    const double decoded = std::pow((0.2 + 0.055) / 1.055, 2.4);
    expectNear(seen(scene).emission, {4.0 * decoded, 2.0, 1.0});
    EXPECT_EQ(seen(scene).occlusion, 1.0) << "no ambient light to occlude";
    scene.ambientRadiance = glm::dvec3(1.0);
    EXPECT_NEAR(seen(scene).occlusion, 1.0 + 0.5 * (0.2 - 1.0), 1e-15);

    material.brdf = "unlit";
    material.metallicRoughness.baseColor = {0.5, 0.5, 0.5};
    material.baseColorTexture.texture = texture;
    const SurfacePoint unlit = seen(scene);
    EXPECT_EQ(unlit.brdf, nullptr);
    expectNear(unlit.emission, {0.5 * decoded, 0.5, 0.5});
}

TEST(Surface, FootprintsFollowThePixels) {
    // Two texels a pixel: every value is the mean of its neighbourhood; a tenth of a texel: a texel's own.
    Scene scene = square("lambert");
    const int texture =
        addImage(scene, 64, 64, 1, [](int x, int y, int) { return (x + y) % 2 == 0 ? 0 : 254; });
    const Brdf& lambert = requireBrdf("lambert");
    scene.materials[0].textures[static_cast<size_t>(lambert.parameterIndex("diffuse"))].texture = texture;
    setParameter(scene.materials[0], "diffuse", glm::dvec3(1.0));
    for (const bool orthographic : {false, true}) {
        Camera camera = lookAt({0, 0, 2}, {0, 0, 0}, 2.0 * std::atan(0.5));
        camera.orthographic = orthographic;
        camera.zNear = 0.1;
        camera.zFar = 10.0;
        const View view = makeView(camera, 32, 32);  // the picture is the square
        const RayDifferentials change = pixelDifferentials(view);
        const Tracer tracer(std::make_shared<const Scene>(scene), view.eye);
        std::vector<SurfacePoint> layers;
        tracer.surfacesAlong(pixelRay(view, 20.25, 7.25), &change, layers);  // the centre of a texel
        ASSERT_EQ(layers.size(), 1u);
        const double srgb = std::pow((254.0 / 255.0 + 0.055) / 1.055, 2.4);
        EXPECT_NEAR(layers[0].values()[0], srgb / 2.0, 1e-9);
        tracer.surfacesAlong(pixelRay(view, 20.25, 7.25), nullptr, layers);
        EXPECT_GT(std::abs(layers[0].values()[0] - srgb / 2.0), 0.49 * srgb);
    }
}

}  // namespace
}  // namespace lobe::reference
