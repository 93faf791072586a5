// The plan as plain data: what a scene needs is kept, and what it does not need is left out, with a reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "planning.hpp"

namespace lobe {
namespace {

using test::modern;
using test::reasonFor;

Scene litQuad(const std::string& brdf = "lambert") {
    Scene scene;
    test::addInstance(scene, test::addQuad(scene, test::addMaterial(scene, brdf), 1.0f));
    scene.lights.push_back(test::directional({0, 0, -1}, glm::dvec3(1.0)));
    return scene;
}

/// Without shadows, whose plan has tests of its own.
FramePlan planOf(const Scene& scene, Quality quality = {}, const AovSet& aovs = {Aov::radiance}) {
    quality.shadows = Shadows::none;
    return planFrame(summarise(scene), quality, modern(), aovs);
}

bool anyDefine(const FramePlan& plan, const std::string& key) {
    for (const PlannedPass& pass : plan.passes)
        for (const Variant& variant : pass.variants)
            if (variant.defines.contains(key)) return true;
    return false;
}

TEST(Plan, SmallestSceneHasNothingToSpare) {
    const FramePlan plan = planOf(litQuad(), {.samples = 1});
    EXPECT_THAT(plan.gbufferTargets, testing::ElementsAre("normal"));
    EXPECT_EQ(plan.gbufferBytesPerPixel(), 8) << "depth and a packed normal";
    ASSERT_EQ(plan.passes.size(), 3u);
    EXPECT_EQ(plan.passes[0].name, "gbuffer");
    EXPECT_EQ(plan.passes[1].name, "coverage");
    EXPECT_EQ(plan.passes[2].name, "light.directional");
    EXPECT_FALSE(plan.masked);
}

TEST(Plan, LightsAreLeftOutOnlyBelowABound) {
    Scene scene = litQuad();
    for (int i = 0; i < 9; ++i)
        scene.lights.push_back(test::point({0, 0, 1}, {32.0, 1.0, 1.0}));
    EXPECT_EQ(planOf(scene).lightReach, 0.0);
    EXPECT_FALSE(planOf(scene).clusteredPoint) << "no light has a range";
    const FramePlan plan = planOf(scene, {.lightThreshold = 2});
    EXPECT_TRUE(plan.clusteredPoint);
    EXPECT_EQ(plan.globalPointLights, 0);
    // 9 lights that share 0.002 alike, on white Lambert: 32 / pi / d^2 = 0.002 / 9.
    EXPECT_NEAR(plan.lightReach * std::pow(32.0, 0.2), std::sqrt(32.0 / std::numbers::pi * 9.0 / 0.002),
                1e-9);
    EXPECT_THAT(plan.notes, testing::Contains(testing::HasSubstr("adds up to at most 0.002")));
    EXPECT_THAT(planOf(scene, {.clusterFrom = 0, .lightThreshold = 2}).notes,
                testing::Contains(testing::HasSubstr("clusters are off")));

    test::addInstance(scene, test::addQuad(scene, test::addMaterial(scene, "ward"), 1.0f));
    EXPECT_EQ(planOf(scene, {.lightThreshold = 2}).lightReach, 0.0);
    EXPECT_THAT(planOf(scene, {.lightThreshold = 2}).notes,
                testing::Contains(testing::HasSubstr("what ward reflects has no bound")));
}

TEST(Plan, SceneWithoutSpotLightsHasNoSpotPassAndNoSpotProgram) {
    Scene scene = litQuad();
    EXPECT_EQ(planOf(scene).pass("light.spot"), nullptr);
    EXPECT_EQ(reasonFor(planOf(scene), "light.spot"), "the scene has no spot light");
    EXPECT_FALSE(anyDefine(planOf(scene), "SPOT_LIGHTS"));
    scene.lights.push_back(test::spot({0, 0, 1}, {0, 0, 0}, glm::dvec3(1.0), 0.1, 0.2));
    EXPECT_NE(planOf(scene).pass("light.spot"), nullptr);
    EXPECT_TRUE(anyDefine(planOf(scene), "SPOT_LIGHTS"));
}

TEST(Plan, TangentsOnlyWithNormalMaps) {
    Scene scene = litQuad();
    EXPECT_FALSE(anyDefine(planOf(scene), "TANGENTS"));
    EXPECT_FALSE(reasonFor(planOf(scene), "tangents").empty());
    scene.materials[0].normalTexture.texture =
        test::addImage(scene, 1, 1, 3, [](int, int, int c) { return c == 2 ? 255 : 128; });
    EXPECT_TRUE(anyDefine(planOf(scene), "TANGENTS"));
    EXPECT_TRUE(reasonFor(planOf(scene), "tangents").empty());
}

TEST(Plan, RoughnessChannelOnlyWithTexturedRoughness) {
    Scene scene = litQuad("metallic_roughness");
    EXPECT_EQ(planOf(scene).channel("parameters0"), nullptr);
    EXPECT_EQ(reasonFor(planOf(scene), "metallic_roughness.roughness"), "the same everywhere: a uniform");
    const int texture = test::addImage(scene, 1, 1, 3, [](int, int, int) { return 128; });
    const int roughness = requireBrdf("metallic_roughness").parameterIndex("roughness");
    scene.materials[0].textures[static_cast<size_t>(roughness)].texture = texture;
    const FramePlan plan = planOf(scene);
    ASSERT_NE(plan.channel("parameters0"), nullptr);
    EXPECT_EQ(plan.channel("parameters0")->format, "R16");
    EXPECT_THAT(plan.channel("parameters0")->holds, testing::HasSubstr("roughness"));
}

TEST(Plan, MaterialChannelOnlyWhereMaterialsOfOneModelDiffer) {
    Scene scene = litQuad();
    const int other = test::addMaterial(scene, "lambert");
    test::addInstance(scene, test::addQuad(scene, other, 0.5f));
    EXPECT_EQ(planOf(scene).channel("material"), nullptr) << "both have the default values";
    test::setParameter(scene.materials[static_cast<size_t>(other)], "diffuse", {0.2, 0.3, 0.4});
    const FramePlan plan = planOf(scene);
    ASSERT_NE(plan.channel("material"), nullptr);
    EXPECT_EQ(plan.channel("material")->format, "R8UI");
    EXPECT_THAT(plan.brdf("lambert")->perMaterial, testing::ElementsAre(0));
}

TEST(Plan, MaskOnlyWithSeveralModels) {
    Scene scene = litQuad();
    EXPECT_EQ(planOf(scene).channel("depth")->format, "DEPTH_COMPONENT32F");
    test::addInstance(scene, test::addQuad(scene, test::addMaterial(scene, "phong"), 0.5f));
    const FramePlan plan = planOf(scene);
    EXPECT_TRUE(plan.masked);
    EXPECT_EQ(plan.channel("depth")->format, "DEPTH32F_STENCIL8");
    EXPECT_NE(plan.brdf("lambert")->stencil, plan.brdf("phong")->stencil);
    EXPECT_EQ(plan.pass("light.directional")->variants.size(), 2u) << "one program a model";
}

TEST(Plan, WideNormalsForSharpLobes) {
    Scene scene = litQuad("blinn_phong");
    EXPECT_EQ(planOf(scene).channel("normal")->format, "RG16");
    test::setParameter(scene.materials[0], "shininess", glm::dvec3(1e6));
    EXPECT_EQ(planOf(scene).channel("normal")->format, "RG32F");
}

TEST(Plan, NormalBitsWinOverTheSharpestLobe) {
    Scene scene = litQuad("blinn_phong");
    test::setParameter(scene.materials[0], "shininess", glm::dvec3(1e6));
    const auto normal = [&](int bits, int gbufferBits) {
        return *planOf(scene, {.gbufferBits = gbufferBits, .normalBits = bits}).channel("normal");
    };
    EXPECT_EQ(normal(8, 32).format, "RG8");
    EXPECT_EQ(normal(16, 32).format, "RG16");
    EXPECT_EQ(normal(32, 8).format, "RG32F");
    EXPECT_THAT(normal(8, 16).reason, testing::HasSubstr("normal_bits asks for 8 bits"));
    EXPECT_THAT(normal(0, 8).reason, testing::HasSubstr("sharpest lobe"));
    EXPECT_TRUE(anyDefine(planOf(scene, {.normalBits = 8}), "NORMAL_8"));
    EXPECT_FALSE(anyDefine(planOf(scene, {.normalBits = 8}), "NORMAL_32F"));
}

TEST(Plan, RadianceBitsAreTheFormatThatLightsAddTo) {
    EXPECT_EQ(planOf(litQuad()).channel("radiance")->format, "RGBA32F");
    const FramePlan plan = planOf(litQuad(), {.radianceBits = 16}, {Aov::radiance, Aov::contributions});
    EXPECT_EQ(plan.channel("radiance")->format, "RGBA16F");
    EXPECT_EQ(plan.channel("radiance")->bytesPerPixel, 8);
    EXPECT_EQ(plan.channel("contribution.directional")->format, "RGBA16F");
    EXPECT_EQ(plan.channel("accumulated")->format, "RGBA32F");
    EXPECT_THAT(plan.channel("radiance")->reason, testing::HasSubstr("65504"));
}

TEST(Plan, WithoutClipControlLinearDepthIsAChannel) {
    Capabilities capabilities = modern();
    capabilities.clipControl = false;
    const FramePlan plan = planFrame(summarise(litQuad()), {}, capabilities);
    EXPECT_FALSE(plan.reversedDepth);
    EXPECT_NE(plan.channel("linear_z"), nullptr);
    EXPECT_EQ(planOf(litQuad()).channel("linear_z"), nullptr);
}

TEST(Plan, EmissionAndAmbientShareTheGbufferPass) {
    Scene scene = litQuad();
    EXPECT_EQ(reasonFor(planOf(scene), "emission"), "no material emits");
    EXPECT_NE(planOf(scene).pass("coverage"), nullptr);
    scene.materials[0].emission = glm::vec3(1.0f);
    const FramePlan plan = planOf(scene);
    EXPECT_EQ(plan.gbufferTargets.back(), "radiance");
    EXPECT_EQ(plan.pass("coverage"), nullptr) << "coverage is written with radiance";
}

TEST(Plan, OcclusionOnlyWhereAmbientLightCanReachIt) {
    Scene scene = litQuad();
    scene.materials[0].occlusionTexture.texture =
        test::addImage(scene, 1, 1, 1, [](int, int, int) { return 100; });
    EXPECT_FALSE(anyDefine(planOf(scene), "OCCLUSION"));
    EXPECT_EQ(reasonFor(planOf(scene), "images[0] image1"), "no material in use reads it");
    scene.ambientRadiance = glm::dvec3(0.1);
    EXPECT_TRUE(anyDefine(planOf(scene), "OCCLUSION"));
}

TEST(Plan, ClustersOnlyForManyRangedLights) {
    Scene scene = litQuad();
    for (int i = 0; i < 8; ++i)
        scene.lights.push_back(test::point({i, 0, 1}, glm::dvec3(1.0), 2.0));
    EXPECT_FALSE(planOf(scene).clusteredPoint);
    scene.lights.push_back(test::point({8, 0, 1}, glm::dvec3(1.0), 2.0));
    EXPECT_TRUE(planOf(scene).clusteredPoint);
    EXPECT_EQ(planOf(scene).globalPointLights, 0);
    scene.lights.push_back(test::point({9, 0, 1}, glm::dvec3(1.0)));
    EXPECT_EQ(planOf(scene).globalPointLights, 1) << "a light without range reaches everything";
    EXPECT_FALSE(planOf(scene, {.clusterFrom = 0}).clusteredPoint);
}

TEST(Plan, BlendedSurfacesAreForwardAndOthersAreNot) {
    Scene scene = litQuad();
    EXPECT_EQ(planOf(scene).pass("forward"), nullptr);
    const int glass = test::addMaterial(scene, "lambert");
    scene.materials[static_cast<size_t>(glass)].alphaMode = AlphaMode::blend;
    test::addInstance(scene, test::addQuad(scene, glass, 0.5f));
    const FramePlan plan = planOf(scene);
    ASSERT_NE(plan.pass("forward"), nullptr);
    EXPECT_EQ(plan.pass("forward")->variants.size(), 1u);
    EXPECT_EQ(plan.pass("gbuffer")->variants.size(), 1u);
    EXPECT_EQ(planOf(scene, {.shading = Shading::forward}).pass("gbuffer"), nullptr);
}

TEST(Plan, UnlitSceneHasNoLightPassAndNoNormals) {
    Scene scene = litQuad(kUnlit);
    const FramePlan plan = planOf(scene);
    EXPECT_EQ(plan.pass("light.directional"), nullptr);
    EXPECT_EQ(plan.channel("normal"), nullptr);
    EXPECT_THAT(plan.gbufferTargets, testing::ElementsAre("radiance"));
}

TEST(Plan, OneSampleNeedsNoAccumulation) {
    EXPECT_EQ(planOf(litQuad(), {.samples = 1}).pass("accumulate"), nullptr);
    EXPECT_EQ(planOf(litQuad(), {.samples = 1}).channel("accumulated"), nullptr);
    EXPECT_NE(planOf(litQuad(), {.samples = 4}).pass("accumulate"), nullptr);
}

TEST(Plan, TextAndJsonNameEveryPassChannelAndOmission) {
    const FramePlan plan = planOf(litQuad("metallic_roughness"));
    const std::string text = toText(plan);
    const auto json = nlohmann::json::parse(toJson(plan));
    EXPECT_EQ(json.at("schema"), 1);
    EXPECT_EQ(json.at("passes").size(), plan.passes.size());
    EXPECT_EQ(json.at("left_out").size(), plan.leftOut.size());
    for (const PlannedPass& pass : plan.passes)
        EXPECT_THAT(text, testing::HasSubstr(pass.name + ": " + pass.reason));
    for (const Channel& channel : plan.channels)
        EXPECT_THAT(text, testing::HasSubstr(channel.name + " " + channel.format));
    for (const LeftOut& leftOut : plan.leftOut) {
        EXPECT_THAT(text, testing::HasSubstr(leftOut.kind + " " + leftOut.name + ": " + leftOut.reason));
        EXPECT_FALSE(leftOut.reason.empty());
    }
}

TEST(Plan, MoreLightsThanTheDriversBuffersHoldAreRefused) {
    Scene scene = litQuad();
    scene.lights.resize(40000, test::point({0, 0, 1}, glm::dvec3(1.0)));
    Capabilities smallest = modern();
    smallest.maxTextureBufferTexels = 65536;
    EXPECT_THROW(planFrame(summarise(scene), {}, smallest), ContextError);
    smallest.maxTextureBufferTexels = 1 << 27;
    EXPECT_NO_THROW(planFrame(summarise(scene), {}, smallest));
}

TEST(Overrides, AnotherModelTakesTheColourOfTheNamedOne) {
    Scene scene = litQuad("phong");
    test::setParameter(scene.materials[0], "diffuse", {0.1, 0.2, 0.3});
    const Scene lambert = withBrdf(scene, requireBrdf("lambert"));
    EXPECT_EQ(lambert.materials[0].brdf, "lambert");
    EXPECT_EQ(lambert.materials[0].values, (ParameterValues{0.1, 0.2, 0.3}));
    const Scene unlit = withBrdf(litQuad(kUnlit), requireBrdf("lambert"));
    EXPECT_EQ(unlit.materials[0].brdf, kUnlit) << "unlit surfaces take no light under any model";
}

TEST(Overrides, TexturedRoughnessIsTakenAsItsMean) {
    Scene scene = litQuad("metallic_roughness");
    scene.materials[0].metallicRoughness.roughness = 0.8;
    scene.materials[0].metallicRoughnessTexture.texture =
        test::addImage(scene, 2, 1, 3, [](int x, int, int) { return x == 0 ? 0 : 255; });
    const Scene blinn = withBrdf(scene, requireBrdf("blinn_phong"));
    MetallicRoughness expected = scene.materials[0].metallicRoughness;
    expected.roughness *= 0.5;
    expected.metallic *= 0.5;
    EXPECT_EQ(blinn.materials[0].values, requireBrdf("blinn_phong").fromMetallicRoughness(expected));
}

TEST(Overrides, DefaultLightOnlyWhereNothingLightsWhatTakesLight) {
    const Camera camera = lookAt({0, 0, 4}, {0, 0, 0}, 0.7);
    Scene lit = litQuad();
    EXPECT_FALSE(addDefaultLight(lit, camera));
    lit.lights.clear();
    EXPECT_TRUE(addDefaultLight(lit, camera));
    EXPECT_EQ(lit.lights.size(), 1u);
    EXPECT_LT(lit.lights[0].direction.z, 0.0) << "with the camera's line of sight";
    EXPECT_FALSE(addDefaultLight(lit, camera)) << "not twice";
    Scene unlit = litQuad(kUnlit);
    unlit.lights.clear();
    EXPECT_FALSE(addDefaultLight(unlit, camera));
}

TEST(Plan, EveryPresetIsKnownAndOthersAreRefusedWithTheNearest) {
    for (const std::string& name : qualityPresetNames())
        EXPECT_NO_THROW(qualityPreset(name));
    try {
        qualityPreset("balancd");
        FAIL() << "expected a refusal";
    } catch (const std::exception& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("did you mean 'balanced'"));
    }
}

}  // namespace
}  // namespace lobe
