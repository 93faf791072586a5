// What the plan decides of shadow maps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.hpp"
#include "planning.hpp"

namespace lobe::test {
namespace {

using testing::HasSubstr;

Quality mapped(int size = 2048, int taps = 16) {
    Quality quality;
    quality.shadowMethod = ShadowMethod::maps;
    quality.shadowSize = size;
    quality.shadowTaps = taps;
    return quality;
}

Scene sphereScene(const std::vector<Light>& lights) {
    Scene scene;
    addInstance(scene, addSphere(scene, addMaterial(scene, "lambert"), 4));
    scene.lights = lights;
    return scene;
}

FramePlan planned(const Scene& scene, const Quality& quality, const Capabilities& capabilities = modern()) {
    return planFrame(summarise(scene), quality, capabilities);
}

std::string notes(const FramePlan& plan) {
    std::string all;
    for (const std::string& note : plan.notes)
        all += note + "\n";
    return all;
}

TEST(PlanShadowMaps, EachKindOfLightHasItsLayers) {
    const FramePlan plan =
        planned(sphereScene({directional({0, -1, 0}, {1, 1, 1}), point({0, 2, 0}, {1, 1, 1}),
                             spot({0, 2, 0}, {0, 0, 0}, {1, 1, 1}, 0.1, 0.5),
                             spot({0, 2, 0}, {0, 0, 0}, {1, 1, 1}, 0.1, 1.5)}),
                mapped(1024));
    EXPECT_EQ(plan.shadowMaps.whole, 2);
    EXPECT_EQ(plan.shadowMaps.cubes, 2);
    EXPECT_EQ(plan.shadowMaps.layers(), 5);
    EXPECT_EQ(plan.shadowMaps.size, 1024);
    ASSERT_NE(plan.pass("shadow.maps"), nullptr);
    EXPECT_THAT(plan.pass("shadow.maps")->reason, HasSubstr("4 lights cast shadows by maps"));
    ASSERT_NE(plan.channel("shadow.maps"), nullptr);
    EXPECT_THAT(plan.channel("shadow.maps")->reason, HasSubstr("5 layers of 1024 x 1024, 20 MiB"));
    EXPECT_EQ(plan.pass("light.spot")->variants.front().defines.count("WIDE_SPOT_SHADOWS"), 1u);
    EXPECT_EQ(plan.pass("light.point")->variants.front().defines.count("WIDE_SPOT_SHADOWS"), 0u);
}

TEST(PlanShadowMaps, AreLeftOutWhereNoneIsSought) {
    const std::vector<Light> lights = {point({0, 2, 0}, {1, 1, 1})};
    Quality none = mapped();
    none.shadows = Shadows::none;
    Scene scene = sphereScene(lights);
    for (const FramePlan& plan : {planned(sphereScene({}), mapped()), planned(scene, none)}) {
        EXPECT_EQ(plan.pass("shadow.maps"), nullptr);
        EXPECT_EQ(plan.channel("shadow.maps"), nullptr);
        EXPECT_EQ(reasonFor(plan, "shadow.maps"), "no shadow is sought");
    }
    scene.lights[0].castsShadow = false;
    EXPECT_EQ(planned(scene, mapped()).pass("shadow.maps"), nullptr);
}

TEST(PlanShadowMaps, TapsAreTheSideOfTheFilter) {
    const Scene scene = sphereScene({point({0, 2, 0}, {1, 1, 1})});
    for (const auto& [taps, side] : {std::pair(1, "1"), std::pair(16, "4"), std::pair(64, "8")})
        EXPECT_EQ(planned(scene, mapped(2048, taps))
                      .pass("light.point")
                      ->variants.front()
                      .defines.at("SHADOW_SIDE"),
                  side);
}

TEST(PlanShadowMaps, MasksAreReadAndBlendedSurfacesLeftOut) {
    Scene scene = sphereScene({point({0, 2, 0}, {1, 1, 1})});
    for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
        const int material = addMaterial(scene, "lambert");
        scene.materials[static_cast<size_t>(material)].alphaMode = mode;
        scene.materials[static_cast<size_t>(material)].baseColorTexture.texture =
            addImage(scene, 2, 2, 4, [](int, int, int) { return 255; });
        addInstance(scene, addQuad(scene, material, 1.0f));
    }
    const FramePlan plan = planned(scene, mapped());
    const auto& variants = plan.pass("shadow.maps")->variants;
    EXPECT_EQ(variants.size(), 2u);
    EXPECT_EQ(std::count_if(variants.begin(), variants.end(),
                            [](const Variant& v) {
                                return v.defines.contains("ALPHA_MASK") && v.defines.contains("UV0");
                            }),
              1);
    EXPECT_THAT(notes(plan), HasSubstr("blended surfaces cast no shadow in them"));
}

TEST(PlanShadowMaps, AreSmallerWhereManyWouldTakeTooMuch) {
    const Scene scene = sphereScene(std::vector<Light>(32, point({0, 2, 0}, {1, 1, 1})));
    const FramePlan plan = planned(scene, mapped(2048));
    EXPECT_EQ(plan.shadowMaps.layers(), 48);
    EXPECT_EQ(plan.shadowMaps.size, 1024);
    EXPECT_THAT(
        notes(plan),
        HasSubstr("1024 x 1024 in place of 2048 x 2048, since 48 layers would take more than 512 MiB"));
    Capabilities small = modern();
    small.maxTextureSize = 1024;
    EXPECT_THAT(notes(planned(sphereScene({point({0, 2, 0}, {1, 1, 1})}), mapped(4096), small)),
                HasSubstr("1024 x 1024 in place of 4096 x 4096, since the driver's textures are no larger"));
}

TEST(PlanShadowMaps, MoreLightsThanLayersAreRefused) {
    Capabilities few = modern();
    few.maxArrayLayers = 256;
    const Scene scene = sphereScene(std::vector<Light>(200, point({0, 2, 0}, {1, 1, 1})));
    try {
        planned(scene, mapped(512), few);
        FAIL() << "not refused";
    } catch (const ContextError& error) {
        EXPECT_THAT(error.what(),
                    HasSubstr("shadow maps of 200 lights take 300 layers; expected at most 256 layers"));
        EXPECT_THAT(error.what(), HasSubstr("--shadow-method rays"));
    }
}

TEST(PlanShadowMaps, LightsWithABodyHaveCubesWhereMapsAreAskedFor) {
    Light sphere = point({0, 2, 0}, {1, 1, 1});
    sphere.type = LightType::sphere;
    sphere.radius = 0.2;
    Scene scene = sphereScene({sphere});
    const FramePlan soft = planned(scene, mapped(1024, 32));
    EXPECT_EQ(soft.shadowOf(LightType::sphere), PlannedShadow::maps);
    EXPECT_EQ(soft.shadowMaps.cubes, 1);
    EXPECT_FALSE(soft.rays);
    const auto& defines = soft.pass("light.sphere")->variants.front().defines;
    EXPECT_EQ(defines.at("SHADOW_TAPS"), "32");
    EXPECT_TRUE(defines.contains("AREA_MAP_SHADOWS"));
    EXPECT_FALSE(defines.contains("AREA_POINT_SHADOWS"));
    EXPECT_THAT(notes(soft), HasSubstr("shadows of sphere lights: maps about their centres"));
    Quality hard = mapped(1024);
    hard.shadows = Shadows::hard;
    EXPECT_TRUE(
        planned(scene, hard).pass("light.sphere")->variants.front().defines.contains("AREA_POINT_SHADOWS"));
    // A mirror shows one point of the light: that takes a ray.
    addInstance(scene, addSphere(scene, addMaterial(scene, "mirror"), 4));
    EXPECT_EQ(planned(scene, mapped(1024)).shadowOf(LightType::sphere), PlannedShadow::rays);
}

TEST(ShadowMapPlan, LightsTooFarForACubeGetRaysOrNone) {
    Scene scene;
    test::addInstance(scene, test::addQuad(scene, test::addMaterial(scene, "lambert"), 1.0f));
    Light disk;
    disk.type = LightType::disk;
    disk.position = {0, 0, 10};
    disk.radius = 0.5;
    scene.lights.push_back(disk);
    Quality quality;
    quality.shadowMethod = ShadowMethod::maps;
    EXPECT_EQ(planOf(scene, quality).shadowOf(LightType::disk), PlannedShadow::maps);
    scene.lights[0].position = {0, 0, 1000};
    const FramePlan far = planOf(scene, quality);
    EXPECT_EQ(far.shadowOf(LightType::disk), PlannedShadow::rays);
    EXPECT_THAT(far.notes,
                testing::Contains(testing::HasSubstr("so far away would hold the scene in few texels")));
    Capabilities few;
    few.maxTextureBufferTexels = 1000;  // enough for the light
    test::addInstance(scene, test::addSphere(scene, 0));
    const FramePlan none = planFrame(summarise(scene), quality, few);
    EXPECT_EQ(none.shadowOf(LightType::disk), PlannedShadow::none);
    EXPECT_THAT(test::reasonFor(none, "disk"), testing::HasSubstr("sun_size 0"));
}

}  // namespace
}  // namespace lobe::test
