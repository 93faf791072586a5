// Pictures of scenes whose radiance is known.
#include <gmock/gmock.h>

#include <numbers>

#include "passes/rendering.hpp"
#include "shading/punctual.hpp"

namespace lobe {
namespace {

using namespace test;

constexpr double kEpsilon = 5.96e-8;  // 2^-24

TEST(Picture, WhiteLambertPlaneShowsIrradianceOverPi) {
    Scene scene;
    addInstance(scene, addQuad(scene, addMaterial(scene, "lambert"), 10.0f));
    setParameter(scene.materials[0], "diffuse", glm::dvec3(1.0));
    const glm::dvec3 irradiance(3.0, 0.001, 12345.0);
    scene.lights.push_back(directional({0, 0, -1}, irradiance));
    for (const char* quality : {"draft", "balanced", "converged"}) {
        const Image image = render(scene, frontCamera(), smallPicture(qualityPreset(quality)));
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(
                        static_cast<double>(image.pixel(x, y)[c]) / (irradiance[c] / std::numbers::pi), 1.0,
                        1e-6)
                        << quality << " at " << x << ", " << y;
    }
}

/// Radiance at a surface point from the scene's lights, in double, from the registry's twins.
glm::dvec3 twinRadiance(const Scene& scene, const Material& material, const glm::dvec3& position,
                        const glm::dvec3& normal, const glm::dvec3& eye) {
    const Brdf& brdf = requireBrdf(material.brdf);
    const glm::dvec3 helper = std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 tangent = glm::normalize(glm::cross(helper, normal));
    const glm::dmat3 local = glm::transpose(glm::dmat3(tangent, glm::cross(normal, tangent), normal));
    const glm::dvec3 wo = local * glm::normalize(eye - position);
    glm::dvec3 sum = brdf.ambient(material.values) * scene.ambientRadiance.value_or(glm::dvec3(0.0)) +
                     glm::dvec3(material.emission);
    for (const Light& light : scene.lights) {
        glm::dvec3 wi = -light.direction;
        double attenuation = 1.0;
        if (light.type != LightType::directional) {
            const glm::dvec3 toLight = light.position - position;
            wi = glm::normalize(toLight);
            attenuation = distanceAttenuation(glm::dot(toLight, toLight), light.range);
            if (light.type == LightType::spot)
                attenuation *= spotAttenuation(-glm::dot(wi, light.direction), light.innerConeAngle,
                                               light.outerConeAngle);
        }
        sum += light.intensity * attenuation * brdf.fCos(Directions(local * wi, wo), material.values);
    }
    return sum;
}

TEST(Picture, EveryModelUnderEveryLightIsItsTwin) {
    const Scene scene = modelsAndLights();
    const Camera camera = frontCamera(5.0);
    const Image image = render(scene, camera,
                               smallPicture({.samples = 1, .gbufferBits = 32},
                                            {Aov::radiance, Aov::position, Aov::normal, Aov::materialId}));
    const size_t px = channelIndex(image, "position.X");
    const size_t nx = channelIndex(image, "normal.X");
    const size_t id = channelIndex(image, "material.id");
    const glm::dvec3 eye(camera.worldFromCamera[3]);
    std::map<int, int> seen;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const float* pixel = image.pixel(x, y);
            const int materialId = static_cast<int>(pixel[id]);
            if (materialId == 0) {
                EXPECT_EQ(pixel[0], 0.0f);
                continue;
            }
            ++seen[materialId];
            const Material& material = scene.materials[static_cast<size_t>(materialId - 1)];
            const glm::dvec3 position(pixel[px], pixel[px + 1], pixel[px + 2]);
            const glm::dvec3 normal = glm::normalize(glm::dvec3(pixel[nx], pixel[nx + 1], pixel[nx + 2]));
            const double cosView = glm::dot(normal, glm::normalize(eye - position));
            if (cosView < 0.05) continue;  // a grazing pixel's condition number is beyond this test's budget
            const glm::dvec3 expected = twinRadiance(scene, material, position, normal, eye);
            // The AOVs are rounded to float: directions are off by up to 16 eps (position, normal, two
            // normalised vectors), which the lobe's sharpness and the cosines multiply.
            const double sharpness = requireBrdf(material.brdf).lobeSharpness(material.values);
            const double budget = 16.0 * kEpsilon * (8.0 + 2.0 * sharpness + 2.0 / cosView);
            const double brightest = std::max({expected.x, expected.y, expected.z});
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(static_cast<double>(pixel[c]), expected[c], budget * brightest)
                    << material.brdf << " at " << x << ", " << y << " channel " << c;
        }
    EXPECT_EQ(seen.size(), allBrdfs().size()) << "every model is in the picture";
    for (const auto& [material, pixels] : seen)
        EXPECT_GT(pixels, 100);
}

TEST(Picture, DeferredAndForwardAgreeToRounding) {
    const Scene scene = modelsAndLights();
    const Image deferred = render(scene, frontCamera(5.0));
    const Image forward =
        render(scene, frontCamera(5.0),
               smallPicture({.samples = 1, .gbufferBits = 32, .shading = Shading::forward}));
    int compared = 0;
    for (int y = 0; y < deferred.height; ++y)
        for (int x = 0; x < deferred.width; ++x) {
            const float* a = deferred.pixel(x, y);
            const float* b = forward.pixel(x, y);
            ASSERT_EQ(a[3], b[3]) << "coverage at " << x << ", " << y;
            const double brightest = static_cast<double>(std::max({b[0], b[1], b[2]}));
            // Octahedral floats are off by 3.2e-7 rad and depth by 6e-8 relative; the sharpest lobe here is
            // alpha 0.25, 8 per rad, and the grazing silhouettes multiply by 1 / cos, up to 1 / 0.05 at a
            // pixel's width.
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(static_cast<double>(a[c]), static_cast<double>(b[c]),
                            3.8e-7 * (8.0 + 20.0) * brightest + 1e-12)
                    << x << ", " << y;
            compared += brightest > 0.0;
        }
    EXPECT_GT(compared, 1000);
}

/// Brushed spheres: an anisotropic lobe about a tangent of its own, left-handed on one of them.
TEST(Picture, AnisotropicLobesFollowTheTangent) {
    Scene scene;
    for (const double handedness : {1.0, -1.0}) {
        const int material = addMaterial(scene, "ggx");
        const Brdf& ggx = requireBrdf("ggx");
        Material& brushed = scene.materials[static_cast<size_t>(material)];
        for (const auto& [name, value] :
             {std::pair("alphaX", 0.05), std::pair("alphaY", 0.5), std::pair("rotation", 0.6)})
            brushed.values[static_cast<size_t>(ggx.valueOffset(ggx.parameterIndex(name)))] = value;
        const int sphere = addSphere(scene, material);
        Primitive& primitive = scene.primitives[static_cast<size_t>(sphere)];
        for (const glm::vec3& n : primitive.normals) {
            const glm::vec3 around = glm::cross(glm::vec3(0.1f, 1.0f, 0.2f), n);
            primitive.tangents.emplace_back(glm::normalize(around), static_cast<float>(handedness));
        }
        addInstance(scene, sphere, glm::translate(glm::dmat4(1.0), glm::dvec3(1.1 * handedness, 0, 0)));
    }
    scene.lights.push_back(directional({0.3, -1, -0.5}, {2.0, 1.9, 1.7}));
    scene.lights.push_back(point({0.5, 1.5, 2.0}, {3.0, 2.0, 1.0}));
    const Image deferred = render(scene, frontCamera(4.0));
    const Image forward =
        render(scene, frontCamera(4.0),
               smallPicture({.samples = 1, .gbufferBits = 32, .shading = Shading::forward}));
    double brightest = 0.0;
    for (const float value : forward.values)
        brightest = std::max(brightest, static_cast<double>(value));
    int lit = 0;
    double mirrored = 0.0;
    for (int y = 0; y < deferred.height; ++y)
        for (int x = 0; x < deferred.width; ++x) {
            const float* a = deferred.pixel(x, y);
            const float* b = forward.pixel(x, y);
            lit += b[0] > 0.0f;
            mirrored = std::max(mirrored, static_cast<double>(std::abs(b[0] - forward.pixel(95 - x, y)[0])));
            // The tangent's code turns it by up to 5e-7 rad and the normal's by 3e-7; the lobe, 2 / 0.05 per
            // rad across, is turned out of its long axis by ten times its share.
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(static_cast<double>(a[c]), static_cast<double>(b[c]),
                            8e-7 * (40.0 * 10.0 + 20.0) * brightest)
                    << x << ", " << y;
        }
    EXPECT_GT(lit, 500);
    // Handedness turns the rotation about: the spheres would be mirror images but for it and the light.
    EXPECT_GT(mirrored, 0.05 * brightest);
}

TEST(Picture, EglAndOsmesaGiveTheSameBits) {
    const Scene scene = modelsAndLights();
    const Image egl = render(scene, frontCamera(5.0));
    eglContext().release();
    const auto osmesa = gl::Context::create({.backend = gl::Backend::osmesa});
    const Image other = render(*osmesa, scene, frontCamera(5.0));
    osmesa->release();
    EXPECT_EQ(egl.values, other.values) << compare(egl, other);
}

TEST(Picture, WithoutClipControlThePictureIsTheSameToRounding) {
    const Scene scene = modelsAndLights();
    const Image reversed = render(scene, frontCamera(5.0));
    eglContext().release();
    const auto masked =
        gl::Context::create({.backend = gl::Backend::egl, .maskedExtensions = {"GL_ARB_clip_control"}});
    const Image linear = render(*masked, scene, frontCamera(5.0));
    masked->release();
    for (size_t i = 0; i < reversed.values.size(); ++i)
        ASSERT_NEAR(reversed.values[i], linear.values[i], 2e-5f * std::max(1.0f, reversed.values[i]));
}

TEST(Picture, ContributionsSumToRadianceExactly) {
    Scene scene = modelsAndLights();
    const Image plain = render(scene, frontCamera(5.0));
    const Image split =
        render(scene, frontCamera(5.0),
               smallPicture({.samples = 1, .gbufferBits = 32}, {Aov::radiance, Aov::contributions}));
    for (int y = 0; y < plain.height; ++y)
        for (int x = 0; x < plain.width; ++x)
            for (size_t c = 0; c < 4; ++c)
                ASSERT_EQ(plain.pixel(x, y)[c], split.pixel(x, y)[c]) << x << ", " << y << " channel " << c;
    for (const char* type : {"emission.R", "ambient.G", "directional.R", "point.R", "spot.R"}) {
        float largest = 0.0f;
        for (size_t i = 0; i < split.pixelCount(); ++i)
            largest = std::max(largest, split.values[i * split.channelCount() + channelIndex(split, type)]);
        EXPECT_GT(largest, 0.0f) << type;
    }
}

TEST(Picture, WhatIsLeftOutChangesNoBit) {
    Scene scene = modelsAndLights();
    const Image thin = render(scene, frontCamera(5.0));
    // Asking for the material AOV adds a channel to the G-buffer and a pass; radiance must not change.
    const Image fat = render(
        scene, frontCamera(5.0),
        smallPicture({.samples = 1, .gbufferBits = 32}, {Aov::radiance, Aov::materialId, Aov::albedo}));
    for (int y = 0; y < thin.height; ++y)
        for (int x = 0; x < thin.width; ++x)
            for (size_t c = 0; c < 4; ++c)
                ASSERT_EQ(thin.pixel(x, y)[c], fat.pixel(x, y)[c]);
}

TEST(Picture, BlendedPaneLetsThroughWhatItDoesNotCover) {
    Scene scene;
    const int back = addMaterial(scene, kUnlit);
    scene.materials[0].metallicRoughness.baseColor = {0.25, 0.5, 1.0};
    addInstance(scene, addQuad(scene, back, 10.0f));
    const int pane = addMaterial(scene, kUnlit);
    scene.materials[1].metallicRoughness.baseColor = {1.0, 0.0, 0.5};
    scene.materials[1].alphaMode = AlphaMode::blend;
    scene.materials[1].alpha = 0.25f;
    addInstance(scene, addQuad(scene, pane, 10.0f), glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 1)));
    for (const AovSet& aovs : {AovSet{Aov::radiance}, AovSet{Aov::radiance, Aov::contributions}}) {
        const Image image = render(scene, frontCamera(), smallPicture({.samples = 1}, aovs));
        const float* pixel = image.pixel(40, 30);
        EXPECT_NEAR(pixel[0], 0.25 * 0.75 + 0.25, 1e-6);
        EXPECT_NEAR(pixel[1], 0.5 * 0.75, 1e-6);
        EXPECT_NEAR(pixel[2], 0.75 + 0.125, 1e-6);
        EXPECT_EQ(pixel[3], 1.0f);
    }
}

TEST(Picture, MaskedSurfaceIsCut) {
    Scene scene;
    const int material = addMaterial(scene, kUnlit);
    const int texture =
        addImage(scene, 2, 1, 4, [](int x, int, int c) { return c == 3 ? (x == 0 ? 0 : 255) : 255; });
    scene.textures[static_cast<size_t>(texture)].sampler.magnify = Filter::nearest;
    scene.materials[0].baseColorTexture.texture = texture;
    scene.materials[0].alphaMode = AlphaMode::mask;
    addInstance(scene, addQuad(scene, material, 1.0f));
    const Image image = render(scene, frontCamera());
    EXPECT_EQ(image.pixel(40, 32)[3], 0.0f) << "left half is transparent";
    EXPECT_EQ(image.pixel(56, 32)[3], 1.0f);
}

TEST(Picture, SamplesAverageCoverageAtEdges) {
    Scene scene;
    addInstance(scene, addQuad(scene, addMaterial(scene, kUnlit), 1.0f),
                glm::rotate(glm::dmat4(1.0), 0.3, glm::dvec3(0, 0, 1)));
    const Image one = render(scene, frontCamera(), smallPicture({.samples = 1}));
    const Image many = render(scene, frontCamera(), smallPicture({.samples = 16}));
    double areaOne = 0.0, areaMany = 0.0;
    int partial = 0;
    for (size_t i = 0; i < one.pixelCount(); ++i) {
        areaOne += static_cast<double>(one.values[i * 4 + 3]);
        areaMany += static_cast<double>(many.values[i * 4 + 3]);
        partial += many.values[i * 4 + 3] > 0.01f && many.values[i * 4 + 3] < 0.99f;
    }
    EXPECT_GT(partial, 20);
    EXPECT_NEAR(areaMany / areaOne, 1.0, 0.01);
}

TEST(Picture, OrthographicCameraSeesParallelLines) {
    Scene scene = modelsAndLights();
    Camera camera = frontCamera(5.0);
    camera.orthographic = true;
    camera.xMag = 3.0;
    camera.yMag = 2.0;
    camera.zFar = 20.0;
    const Image deferred = render(
        scene, camera,
        smallPicture({.samples = 1, .gbufferBits = 32}, {Aov::radiance, Aov::position, Aov::materialId}));
    const size_t px = channelIndex(deferred, "position.X");
    int seen = 0;
    for (int y = 0; y < deferred.height; ++y)
        for (int x = 0; x < deferred.width; ++x) {
            if (deferred.pixel(x, y)[channelIndex(deferred, "material.id")] == 0.0f) continue;
            ++seen;
            EXPECT_NEAR(deferred.pixel(x, y)[px], ((x + 0.5) / 96.0 - 0.5) * 6.0, 1e-5);
            EXPECT_NEAR(deferred.pixel(x, y)[px + 1], (0.5 - (y + 0.5) / 64.0) * 4.0, 1e-5);
        }
    // A disc for each model in a window of 6 m x 4 m; along its edge, half a pixel either way.
    const double models = static_cast<double>(allBrdfs().size());
    const double pixelsPerMetre = 96 / 6.0;
    const double edge = models * 2 * std::numbers::pi * test::kModelRadius * pixelsPerMetre;
    EXPECT_NEAR(
        seen,
        models * std::numbers::pi * test::kModelRadius * test::kModelRadius * pixelsPerMetre * pixelsPerMetre,
        0.5 * edge);
    const Image forward =
        render(scene, camera, smallPicture({.samples = 1, .gbufferBits = 32, .shading = Shading::forward}));
    for (int y = 0; y < deferred.height; ++y)
        for (int x = 0; x < deferred.width; ++x)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(deferred.pixel(x, y)[c], forward.pixel(x, y)[c],
                            2e-5f * std::max(1.0f, forward.pixel(x, y)[c]));
}

}  // namespace
}  // namespace lobe
