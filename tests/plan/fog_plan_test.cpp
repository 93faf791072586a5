// Fog and transparency in the plan: nothing of them where a scene has none, and each choice with its reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "planning.hpp"

namespace lobe {
namespace {

using test::planOf;
using test::reasonFor;
using testing::ElementsAre;
using testing::HasSubstr;

Scene litQuad() {
    Scene scene;
    test::addInstance(scene, test::addQuad(scene, test::addMaterial(scene, "lambert"), 1.0f));
    scene.lights.push_back(test::point({0, 0, 1}, glm::dvec3(1.0)));
    return scene;
}

Fog fogOf(double scattering) {
    Fog fog;
    fog.extinction = glm::dvec3(0.1);
    fog.scattering = glm::dvec3(scattering);
    return fog;
}

void addPane(Scene& scene, const std::string& model = "lambert") {
    const int material = test::addMaterial(scene, model);
    if (model == "thin_transmission")
        test::setParameter(scene.materials[static_cast<size_t>(material)], "transmission", glm::dvec3(0.5));
    else
        scene.materials[static_cast<size_t>(material)].alphaMode = AlphaMode::blend;
    // As importing a metallic surface of the default 1 would let nothing through.
    if (model == "thin_transmission")
        test::setParameter(scene.materials[static_cast<size_t>(material)], "metallic", glm::dvec3(0.0));
    test::addInstance(scene, test::addQuad(scene, material, 1.0f));
}

std::vector<std::string> definesWith(const FramePlan& plan, const std::string& part) {
    std::vector<std::string> found;
    for (const PlannedPass& pass : plan.passes)
        for (const Variant& variant : pass.variants)
            for (const auto& [key, value] : variant.defines)
                if (key.find(part) != std::string::npos) found.push_back(pass.name + " " + key + " " + value);
    return found;
}

TEST(FogPlan, ASceneWithoutFogHasNothingOfIt) {
    Scene scene = litQuad();
    addPane(scene);
    for (const AovSet& aovs : {AovSet{Aov::radiance}, AovSet{Aov::radiance, Aov::contributions}}) {
        const FramePlan plan = planOf(scene, {}, aovs);
        EXPECT_EQ(plan.pass("fog"), nullptr);
        EXPECT_EQ(plan.pass("airlight"), nullptr);
        EXPECT_EQ(reasonFor(plan, "fog"), "the scene has no fog");
        EXPECT_EQ(reasonFor(plan, "airlight"), "the scene has no fog");
        EXPECT_THAT(definesWith(plan, "FOG"), ElementsAre());
        EXPECT_THAT(definesWith(plan, "AIRLIGHT"), ElementsAre());
        EXPECT_EQ(plan.channel("contribution.fog"), nullptr);
    }
}

TEST(FogPlan, FogIsOneVariantForSurfacesAndOneForTheBackground) {
    Scene scene = litQuad();
    scene.fog = fogOf(0.0);
    const FramePlan plan = planOf(scene);
    ASSERT_NE(plan.pass("fog"), nullptr);
    EXPECT_EQ(plan.pass("fog")->variants.size(), 2u);
    EXPECT_THAT(definesWith(plan, "FOG"), ElementsAre("fog FOG_BACKGROUND 1"));
    EXPECT_EQ(reasonFor(plan, "airlight"), "the fog scatters no light");
    scene.fog->heightFalloff = 1.0;
    EXPECT_EQ(definesWith(planOf(scene), "FOG_HEIGHT").size(), 2u);
    // Surfaces that are drawn forward have it there.
    const FramePlan forward = planOf(scene, {.shading = Shading::forward});
    EXPECT_EQ(forward.pass("fog")->variants.size(), 1u);
    EXPECT_THAT(definesWith(forward, "FOG_HEIGHT"), ElementsAre("fog FOG_HEIGHT 1", "forward FOG_HEIGHT 1"));
}

TEST(FogPlan, FogDimsEachContribution) {
    Scene scene = litQuad();
    scene.fog = fogOf(0.0);
    const FramePlan plan = planOf(scene, {}, {Aov::radiance, Aov::contributions});
    EXPECT_THAT(plan.pass("fog")->writes,
                testing::IsSupersetOf({"contribution.fog", "contribution.point", "contribution.emission"}));
    EXPECT_EQ(plan.pass("fog")->writes.front(), "contribution.fog");
    EXPECT_THAT(definesWith(plan, "FOG_DIMS"), ElementsAre("fog FOG_DIMS 1"));
}

TEST(FogPlan, FogDimsTheEnvironmentBehindSurfaces) {
    Scene scene = litQuad();
    scene.fog = fogOf(0.0);
    scene.environment = Environment{};
    const AovSet both{Aov::radiance, Aov::contributions};
    EXPECT_THAT(definesWith(planOf(scene, {}, both), "FOG_DIMS"),
                ElementsAre("fog FOG_DIMS 1", "fog FOG_DIMS 1"));
    EXPECT_THAT(planOf(scene, {.shading = Shading::forward}, both).pass("fog")->writes,
                ElementsAre("contribution.fog", "contribution.transparent"));
    scene.environment->background = false;
    EXPECT_THAT(planOf(scene, {.shading = Shading::forward}, both).pass("fog")->writes,
                ElementsAre("contribution.fog"));
}

TEST(FogPlan, AirlightOnlyWhereFogScattersTheLightOfALamp) {
    Scene scene = litQuad();
    scene.fog = fogOf(0.05);
    const FramePlan plan = planOf(scene);
    ASSERT_NE(plan.pass("airlight"), nullptr);
    EXPECT_EQ(plan.airlightNodes, 8);
    EXPECT_EQ(definesWith(plan, "AIRLIGHT_POINTS").size(), 2u);
    EXPECT_THAT(definesWith(plan, "AIRLIGHT_SPOTS"), ElementsAre());
    EXPECT_EQ(definesWith(plan, "AIRLIGHT_GREY").size(), 2u);
    EXPECT_EQ(reasonFor(planOf(scene, {.airlightNodes = 0}), "airlight"), "airlight_nodes is 0");
    scene.fog->scattering.x = 0.02;
    EXPECT_THAT(definesWith(planOf(scene), "AIRLIGHT_GREY"), ElementsAre());
    scene.lights = {test::directional({0, 0, -1}, glm::dvec3(1.0))};
    EXPECT_EQ(reasonFor(planOf(scene), "airlight"), "no point or spot light in the fog");
}

TEST(FogPlan, MoreLampsThanALoopHoldsAreRefusedBehindPanesOnly) {
    Scene scene = litQuad();
    scene.fog = fogOf(0.05);
    scene.lights.resize(9000, test::point({0, 0, 1}, glm::dvec3(1.0), 2.0));
    EXPECT_NO_THROW(planOf(scene));
    addPane(scene);
    EXPECT_THROW(planOf(scene), InputError);
    EXPECT_NO_THROW(planOf(scene, {.airlightNodes = 4}));
}

TEST(TransparencyPlan, OpaqueScenesHaveNothingOfIt) {
    for (const Transparency transparency : {Transparency::sorted, Transparency::peeled}) {
        const FramePlan plan =
            planOf(litQuad(), {.transparency = transparency}, {Aov::radiance, Aov::contributions});
        EXPECT_EQ(plan.pass("forward"), nullptr);
        EXPECT_EQ(plan.pass("peel"), nullptr);
        EXPECT_EQ(plan.pass("dim"), nullptr);
        EXPECT_EQ(plan.channel("layer"), nullptr);
        EXPECT_EQ(plan.channel("transmittance"), nullptr);
        EXPECT_EQ(reasonFor(plan, "peel"), "no blended surface");
        EXPECT_THAT(definesWith(plan, "PEEL"), ElementsAre());
    }
}

TEST(TransparencyPlan, PeelingIsBoundedByTrianglesAndSaysSo) {
    Scene scene = litQuad();
    addPane(scene);
    EXPECT_EQ(planOf(scene).pass("peel"), nullptr);
    EXPECT_EQ(reasonFor(planOf(scene), "peel"), "blended surfaces are sorted by object");
    const FramePlan plan = planOf(scene, {.transparency = Transparency::peeled});
    ASSERT_NE(plan.pass("peel"), nullptr);
    EXPECT_EQ(plan.mostLayers, 2) << "a pane is two triangles";
    EXPECT_THAT(plan.pass("forward")->reason, HasSubstr("at most 2 layers"));
    EXPECT_THAT(definesWith(plan, "PEELED"), ElementsAre("peel PEELED 1", "forward PEELED 1"));
    for (int i = 0; i < 300; ++i)
        addPane(scene);
    EXPECT_EQ(planOf(scene, {.transparency = Transparency::peeled}).mostLayers, 256);
}

TEST(TransparencyPlan, ContributionsAreDimmedAtOnce) {
    Scene scene = litQuad();
    addPane(scene);
    const FramePlan plan = planOf(scene, {}, {Aov::radiance, Aov::contributions});
    EXPECT_THAT(plan.pass("forward")->writes,
                ElementsAre("contribution.transparent", "radiance", "transmittance"));
    ASSERT_NE(plan.pass("dim"), nullptr);
    EXPECT_THAT(plan.pass("dim")->writes, testing::Contains("contribution.point"));
}

TEST(TransparencyPlan, ColouredTransmittanceTakesAProgramForEachTarget) {
    Scene scene = litQuad();
    addPane(scene);
    addPane(scene, "thin_transmission");
    const SceneSummary summary = summarise(scene);
    EXPECT_TRUE(summary.transmits);
    EXPECT_EQ(summary.blendedInstances, 2u)
        << "a pane that lets light through is drawn over what is behind it";
    const FramePlan plan = planOf(scene);
    EXPECT_EQ(plan.pass("forward")->variants.size(), 2u);
    EXPECT_EQ(definesWith(plan, "COLORED_TRANSMITTANCE").size(), 2u);
    EXPECT_THAT(definesWith(plan, "TRANSMISSION"), ElementsAre("forward TRANSMISSION 1"));
    const FramePlan split = planOf(scene, {}, {Aov::radiance, Aov::contributions});
    EXPECT_EQ(split.pass("forward")->variants.size(), 6u) << "transparent, coverage, transmittance";
    // Without transmission it is a surface like any other.
    test::setParameter(scene.materials.back(), "transmission", glm::dvec3(0.0));
    EXPECT_FALSE(summarise(scene).transmits);
}

}  // namespace
}  // namespace lobe
