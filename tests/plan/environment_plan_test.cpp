// The environment in the plan: nothing of it without one, and each choice with its reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "planning.hpp"

namespace lobe {
namespace {

using test::definesOf;
using test::planOf;
using test::reasonFor;
using testing::HasSubstr;

Scene quad(const std::string& brdf) {
    Scene scene;
    test::addInstance(scene, test::addQuad(scene, test::addMaterial(scene, brdf), 1.0f));
    return scene;
}

Scene surrounded(const std::string& brdf) {
    Scene scene = quad(brdf);
    scene.environment = Environment{};
    return scene;
}

TEST(EnvironmentPlan, AbsentWithoutOne) {
    Scene scene = quad("metallic_roughness");
    scene.lights.push_back(test::point({0, 0, 2}, glm::dvec3(1.0)));
    const FramePlan plan = planOf(scene, {}, {Aov::radiance, Aov::contributions});
    EXPECT_EQ(plan.pass("light.environment"), nullptr);
    EXPECT_EQ(plan.pass("background"), nullptr);
    EXPECT_EQ(plan.channel("contribution.environment"), nullptr);
    EXPECT_TRUE(plan.environmentMethods.empty());
    for (const std::string& define : definesOf(plan))
        EXPECT_EQ(define.find("ENVIRONMENT"), std::string::npos) << define;
    EXPECT_EQ(reasonFor(plan, "light.environment"), "the scene has no environment");
}

TEST(EnvironmentPlan, SaysHowTheEnvironmentCameAbout) {
    Scene scene = surrounded("lambert");
    scene.environment->notes = {"the sun is taken out"};
    EXPECT_THAT(planOf(scene).notes, testing::Contains("environment: the sun is taken out"));
}

TEST(EnvironmentPlan, APictureOfItsOwnBehindSurfacesLeavesTheOtherOut) {
    Scene scene = surrounded("lambert");
    scene.images.resize(2);
    scene.environment->image = 0;
    scene.environment->backgroundImage = 1;
    const FramePlan plan = planOf(scene);
    EXPECT_FALSE(plan.environmentMap);
    ASSERT_NE(plan.pass("background"), nullptr);
    EXPECT_THAT(plan.pass("background")->reason, HasSubstr("a picture of its own"));
}

TEST(EnvironmentPlan, PrefilteredNeedsNoRaysAndNoDirections) {
    const FramePlan plan = planOf(surrounded("metallic_roughness"));
    ASSERT_NE(plan.pass("light.environment"), nullptr);
    ASSERT_NE(plan.pass("background"), nullptr);
    EXPECT_EQ(plan.environmentMethods.at("metallic_roughness").method, EnvironmentMethod::prefiltered);
    EXPECT_EQ(plan.environmentSamples, 0);
    EXPECT_FALSE(plan.rays);
    EXPECT_EQ(plan.channel("geometric_normal"), nullptr);
    EXPECT_THAT(reasonFor(plan, "environment"), HasSubstr("as if nothing blocked it"));
}

TEST(EnvironmentPlan, OcclusionOnlyWhereSomethingIsPrefilteredAndBlocked) {
    const Scene scene = surrounded("metallic_roughness");
    const FramePlan plan = planOf(scene);
    ASSERT_NE(plan.pass("ambient_occlusion"), nullptr);
    EXPECT_NE(plan.channel("ambient_occlusion"), nullptr);
    EXPECT_TRUE(definesOf(plan).contains("AMBIENT_OCCLUSION"));
    Scene open = scene;
    open.environment->castsShadow = false;
    const std::vector<std::pair<FramePlan, std::string>> without{
        {planOf(quad("metallic_roughness")), "no environment"},
        {planOf(scene, {.shadows = Shadows::none}), "shadows are off"},
        {planOf(open), "as if nothing blocked"},
        {planOf(scene, {.envLighting = EnvironmentLighting::sampled}),
         "no surface shows what is prefiltered"},
        {planOf(surrounded("mirror")), "no surface shows what is prefiltered"},
        {planOf(scene, {.shading = Shading::forward}), "forward shading"},
        {planOf(scene, {.ambientOcclusion = AmbientOcclusion::off}), "ambient_occlusion is off"}};
    for (const auto& [bare, reason] : without) {
        EXPECT_EQ(bare.pass("ambient_occlusion"), nullptr) << reason;
        EXPECT_EQ(bare.channel("ambient_occlusion"), nullptr) << reason;
        EXPECT_FALSE(definesOf(bare).contains("AMBIENT_OCCLUSION")) << reason;
        EXPECT_THAT(reasonFor(bare, "ambient_occlusion"), HasSubstr(reason));
    }
}

TEST(EnvironmentPlan, OcclusionTexturesOnlyWhereTheyDimSomething) {
    Scene scene = surrounded("metallic_roughness");
    scene.materials[0].occlusionTexture.texture =
        test::addImage(scene, 1, 1, 3, [](int, int, int) { return 128; });
    const FramePlan plan = planOf(scene);
    ASSERT_NE(plan.channel("occlusion"), nullptr);
    EXPECT_TRUE(definesOf(plan).contains("OCCLUSION_TEXTURES"));
    const FramePlan forward = planOf(scene, {.shading = Shading::forward});
    EXPECT_EQ(forward.channel("occlusion"), nullptr);
    EXPECT_TRUE(definesOf(forward).contains("OCCLUSION_TEXTURES"));
    for (const FramePlan& bare : {planOf(scene, {.shadows = Shadows::none}),
                                  planOf(scene, {.envLighting = EnvironmentLighting::sampled}),
                                  planOf(surrounded("metallic_roughness"))}) {
        EXPECT_EQ(bare.channel("occlusion"), nullptr);
        EXPECT_FALSE(definesOf(bare).contains("OCCLUSION"));
        EXPECT_FALSE(definesOf(bare).contains("OCCLUSION_TEXTURES"));
        EXPECT_FALSE(definesOf(bare).contains("UV0"));
    }
}

TEST(EnvironmentPlan, ModelsThatAreNotSplitAreSampled) {
    const FramePlan plan = planOf(surrounded("he"));
    const PlannedEnvironment& how = plan.environmentMethods.at("he");
    EXPECT_EQ(how.method, EnvironmentMethod::sampled);
    EXPECT_THAT(how.reason, HasSubstr("no fit serves its lobe"));
    EXPECT_EQ(plan.environmentSamples, Quality{}.envSamples);
    EXPECT_EQ(plan.environmentShadow, PlannedShadow::rays);
    EXPECT_TRUE(plan.environmentMap);
}

TEST(EnvironmentPlan, SampledWhereItIsAskedFor) {
    const FramePlan plan = planOf(surrounded("lambert"), qualityPreset("converged"));
    EXPECT_EQ(plan.environmentMethods.at("lambert").method, EnvironmentMethod::sampled);
    EXPECT_TRUE(definesOf(plan).contains("ENVIRONMENT_SHADOWS"));
    Quality bare = qualityPreset("converged");
    bare.shadows = Shadows::none;
    const FramePlan unshadowed = planOf(surrounded("lambert"), bare);
    EXPECT_EQ(unshadowed.environmentShadow, PlannedShadow::none);
    EXPECT_FALSE(definesOf(unshadowed).contains("ENVIRONMENT_SHADOWS"));
}

TEST(EnvironmentPlan, HiddenAndOnlySeen) {
    Scene scene = surrounded("metallic_roughness");
    scene.environment->background = false;
    const FramePlan plan = planOf(scene);
    EXPECT_EQ(plan.pass("background"), nullptr);
    EXPECT_FALSE(plan.environmentMap);
    Scene unlit = surrounded("unlit");
    const FramePlan seen = planOf(unlit);
    EXPECT_EQ(seen.pass("light.environment"), nullptr);
    EXPECT_NE(seen.pass("background"), nullptr);
}

TEST(EnvironmentPlan, MirrorsLookIntoTheMap) {
    const FramePlan plan = planOf(surrounded("mirror"));
    EXPECT_EQ(plan.environmentMethods.at("mirror").method, EnvironmentMethod::mirrored);
    EXPECT_TRUE(plan.environmentMap);
    EXPECT_EQ(plan.environmentSamples, 0);
}

TEST(EnvironmentPlan, TooLargeForTheDriver) {
    Scene scene = surrounded("mirror");
    Bitmap picture;
    picture.width = 40000;
    picture.height = 20000;
    scene.environment->image = 0;
    scene.images.push_back(picture);
    EXPECT_THROW(planOf(scene), ContextError);
}

}  // namespace
}  // namespace lobe
