// Shadows by rays: for which lights they are planned, and what they need.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "planning.hpp"

namespace lobe {
namespace {

using test::reasonFor;

Capabilities withTexels(int texels) {
    Capabilities capabilities = test::modern();
    capabilities.maxTextureBufferTexels = texels;
    return capabilities;
}

Quality byRays() {
    Quality quality{.samples = 1};
    quality.shadowMethod = ShadowMethod::rays;
    return quality;
}

FramePlan planOf(const Scene& scene, const Quality& quality = byRays(), int texels = 1 << 27) {
    return planFrame(summarise(scene), quality, withTexels(texels));
}

Scene ballAndLights() {
    Scene scene;
    test::addInstance(scene, test::addSphere(scene, test::addMaterial(scene, "lambert"), 8));
    scene.lights.push_back(test::directional({0, -1, 0}, glm::dvec3(1.0)));
    scene.lights.push_back(test::point({0, 3, 0}, glm::dvec3(1.0)));
    scene.lights.push_back(test::spot({3, 0, 0}, {0, 0, 0}, glm::dvec3(1.0), 0.1, 0.2));
    return scene;
}

const std::map<std::string, std::string>& definesOf(const FramePlan& plan, const std::string& pass) {
    return plan.pass(pass)->variants.front().defines;
}

TEST(RayShadows, EachTypeOfLightHasThem) {
    const FramePlan plan = planOf(ballAndLights());
    EXPECT_TRUE(plan.rays);
    EXPECT_NE(plan.channel("geometric_normal"), nullptr);
    for (const auto& [pass, name] : {std::pair("light.directional", "DIRECTIONAL"),
                                     std::pair("light.point", "POINT"), std::pair("light.spot", "SPOT")}) {
        EXPECT_TRUE(definesOf(plan, pass).contains(std::string(name) + "_SHADOW_RAYS"));
        EXPECT_FALSE(definesOf(plan, pass).contains("RAY_ALPHA"));
    }
    EXPECT_THAT(plan.notes, testing::Contains(testing::HasSubstr("shadows of point lights: rays")));
    EXPECT_EQ(reasonFor(plan, "holes and dimming of rays"), "all surfaces that cast shadows are opaque");
}

TEST(RayShadows, WhereNobodyAsksTheyAreTakenForAsManyTrianglesAsTheyAreFastFor) {
    SceneSummary summary = summarise(ballAndLights());
    summary.bodyLights[LightType::sphere] = 1;
    summary.shadowLights[LightType::sphere] = 1;
    const auto methods = [&](const Capabilities& capabilities) {
        const FramePlan plan = planFrame(summary, {}, capabilities);
        std::set<PlannedShadow> found;
        for (const auto& [type, method] : plan.shadows)
            found.insert(method);
        return found;
    };
    EXPECT_THAT(methods(test::modern()), testing::ElementsAre(PlannedShadow::rays));
    summary.castingTriangles = 200000;
    EXPECT_THAT(methods(test::modern()), testing::ElementsAre(PlannedShadow::rays));
    summary.castingTriangles = 200001;
    EXPECT_THAT(methods(test::modern()), testing::ElementsAre(PlannedShadow::maps));
    EXPECT_THAT(planFrame(summary, {}, test::modern()).notes,
                testing::Contains(testing::HasSubstr("rays through 200001 triangles would take longer")));
    summary.blendedCasters = true;
    EXPECT_THAT(methods(test::modern()), testing::ElementsAre(PlannedShadow::rays)) << "maps have no panes";
    summary.castingTriangles = 1000;
    summary.blendedCasters = false;
    EXPECT_THAT(methods(withTexels(100)), testing::ElementsAre(PlannedShadow::maps))
        << "the buffers are too small";
}

TEST(RayShadows, NothingOfThemWhereShadowsAreOff) {
    Quality quality = byRays();
    quality.shadows = Shadows::none;
    const FramePlan plan = planOf(ballAndLights(), quality);
    EXPECT_FALSE(plan.rays);
    EXPECT_EQ(plan.channel("geometric_normal"), nullptr);
    EXPECT_FALSE(definesOf(plan, "light.point").contains("SHADOWS"));
    EXPECT_EQ(reasonFor(plan, "point"), "shadows are off");
    EXPECT_EQ(reasonFor(plan, "hierarchy of triangles"), "no ray is cast");
}

TEST(RayShadows, LightsAndSurfacesThatCastNone) {
    Scene scene = ballAndLights();
    scene.lights[1].castsShadow = false;
    const FramePlan plan = planOf(scene);
    EXPECT_EQ(plan.shadowOf(LightType::point), PlannedShadow::none);
    EXPECT_EQ(plan.shadowOf(LightType::spot), PlannedShadow::rays);
    EXPECT_FALSE(definesOf(plan, "light.point").contains("SHADOWS"));
    EXPECT_THAT(reasonFor(plan, "point"), testing::HasSubstr("LOBE_shadow"));
    scene.instances[0].castsShadow = false;
    EXPECT_FALSE(planOf(scene).anyShadow());
    EXPECT_FALSE(planOf(scene).rays);
    EXPECT_EQ(reasonFor(planOf(scene), "spot"), "no surface of the scene casts any");
}

TEST(RayShadows, HolesOnlyWhereSomethingIsNotOpaque) {
    Scene scene = ballAndLights();
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].alphaMode = AlphaMode::mask;
    test::addInstance(scene, test::addQuad(scene, 1, 1.0f));
    EXPECT_TRUE(definesOf(planOf(scene), "light.point").contains("RAY_ALPHA"));
    scene.instances[1].castsShadow = false;
    EXPECT_FALSE(definesOf(planOf(scene), "light.point").contains("RAY_ALPHA"));
    scene.instances[1].castsShadow = true;
    scene.materials[1].alphaMode = AlphaMode::blend;
    const FramePlan plan = planOf(scene);
    EXPECT_TRUE(definesOf(plan, "light.point").contains("RAY_ALPHA"));
    EXPECT_TRUE(definesOf(plan, "forward").contains("POINT_SHADOW_RAYS"));
    EXPECT_TRUE(definesOf(plan, "forward").contains("RAY_ALPHA"));
}

TEST(RayShadows, BuffersThatAreTooSmallAreRefused) {
    EXPECT_TRUE(planOf(ballAndLights(), byRays(), 65536).rays);
    try {
        planOf(ballAndLights(), byRays(), 100);
        FAIL();
    } catch (const ContextError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("the driver's hold 100"));
    }
}

}  // namespace
}  // namespace lobe
