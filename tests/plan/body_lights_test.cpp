// Lights with a body in the plan: nothing of them without one, and each choice with its reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "planning.hpp"

namespace lobe {
namespace {

using test::planOf;
using test::reasonFor;

Scene quad(const std::string& brdf = "lambert") {
    Scene scene;
    test::addInstance(scene, test::addQuad(scene, test::addMaterial(scene, brdf), 1.0f));
    return scene;
}

Light body(LightType type) {
    Light light;
    light.type = type;
    light.width = light.height = light.radius = light.length = 1.0;
    light.position = {0, 0, 2};
    return light;
}

Scene underBody(LightType type, const std::string& brdf = "lambert") {
    Scene scene = quad(brdf);
    scene.lights.push_back(body(type));
    return scene;
}

/// Of the one light pass that there is.
std::map<std::string, std::string> lightDefinesOf(const FramePlan& plan) {
    std::map<std::string, std::string> all;
    for (const PlannedPass& pass : plan.passes)
        for (const Variant& variant : pass.variants)
            if (pass.name.starts_with("light.")) all.insert(variant.defines.begin(), variant.defines.end());
    return all;
}

constexpr LightType kBodies[] = {LightType::rect, LightType::disk, LightType::sphere, LightType::tube};

TEST(BodyLightPlan, AbsentWithoutThem) {
    Scene scene = quad();
    scene.lights.push_back(test::point({0, 0, 2}, glm::dvec3(1.0)));
    const FramePlan plan = planOf(scene, {}, {Aov::radiance, Aov::contributions});
    for (LightType type : kBodies) {
        const std::string name = std::string("light.") + nameOf(type);
        EXPECT_EQ(plan.pass(name), nullptr);
        EXPECT_EQ(reasonFor(plan, name), "the scene has no " + std::string(nameOf(type)) + " light");
        EXPECT_EQ(plan.channel(std::string("contribution.") + nameOf(type)), nullptr);
    }
    EXPECT_EQ(plan.areaPoints, 0);
    for (const std::string& key : test::definesOf(plan))
        EXPECT_THAT(key, testing::Not(testing::StartsWith("AREA_"))) << key;
}

TEST(BodyLightPlan, EachTypeHasItsPassAndContribution) {
    for (LightType type : kBodies) {
        const FramePlan plan = planOf(underBody(type), {}, {Aov::radiance, Aov::contributions});
        const std::string kind = nameOf(type);
        const PlannedPass* pass = plan.pass("light." + kind);
        ASSERT_NE(pass, nullptr) << kind;
        EXPECT_THAT(pass->writes, testing::ElementsAre("contribution." + kind));
        EXPECT_THAT(pass->reads, testing::Contains("normal"));
        ASSERT_EQ(pass->variants.size(), 1u);
        for (LightType other : kBodies)
            EXPECT_EQ(plan.pass(std::string("light.") + nameOf(other)) != nullptr, other == type);
    }
}

TEST(BodyLightPlan, ClosedFormWhereThereIsOne) {
    Quality quality;
    quality.shadows = Shadows::none;
    const FramePlan lambert = planOf(underBody(LightType::disk), quality);
    EXPECT_EQ(lambert.areaMethods.at("lambert").method, AreaMethod::analytic);
    EXPECT_TRUE(test::definesOf(lambert).contains("AREA_ANALYTIC"));
    EXPECT_FALSE(test::definesOf(lambert).contains("AREA_SAMPLED"));
    EXPECT_EQ(lambert.areaPoints, 0);
    EXPECT_EQ(reasonFor(lambert, "points on lights"), "closed forms need none, and no shadow is soft");
    EXPECT_EQ(lightDefinesOf(lambert).at("LOBE_COUNT"), "0");
    const FramePlan he = planOf(underBody(LightType::disk, "he"), quality);
    EXPECT_EQ(he.areaMethods.at("he").method, AreaMethod::sampled);
    EXPECT_EQ(he.areaMethods.at("he").reason, "by points on each: no fit serves its lobe");
    EXPECT_FALSE(test::definesOf(he).contains("AREA_ANALYTIC"));
    EXPECT_TRUE(test::definesOf(he).contains("AREA_SAMPLED"));
    EXPECT_EQ(he.areaPoints, quality.lightSamples);
    quality.areaLights = AreaLights::sampled;
    EXPECT_EQ(planOf(underBody(LightType::disk), quality).areaMethods.at("lambert").method,
              AreaMethod::sampled);
}

TEST(BodyLightPlan, FitsTakeWhatTheMaterialsLeaveOpen) {
    Quality quality;
    quality.shadows = Shadows::none;
    Scene scene = underBody(LightType::rect, "phong");
    const FramePlan plain = planOf(scene, quality);
    EXPECT_EQ(plain.areaMethods.at("phong").method, AreaMethod::analytic);
    EXPECT_EQ(lightDefinesOf(plain).at("LOBE_COUNT"), "2");
    EXPECT_EQ(lightDefinesOf(plain).at("LOBE_WEIGHTS(w)"), "vec3(1.0), vec3(1.0)")
        << "colours are in the table";
    EXPECT_FALSE(test::definesOf(plain).contains("LOBE_WIDTHS"));
    EXPECT_FALSE(test::definesOf(plain).contains("AREA_SAMPLED"));
    EXPECT_EQ(plain.areaPoints, 0);

    // A second material of another colour, then of another width, then of another form.
    scene.materials.push_back(scene.materials.front());
    scene.primitives.push_back(scene.primitives.front());
    scene.primitives.back().material = static_cast<int>(scene.materials.size()) - 1;
    scene.instances.push_back(scene.instances.front());
    scene.instances.back().primitive = static_cast<int>(scene.primitives.size()) - 1;
    const Brdf& brdf = requireBrdf("phong");
    const auto valueAt = [&](const char* name) -> double& {
        return scene.materials.back()
            .values[static_cast<size_t>(brdf.valueOffset(brdf.parameterIndex(name)))];
    };
    valueAt("specular") = 0.125;
    const FramePlan colours = planOf(scene, quality);
    EXPECT_EQ(lightDefinesOf(colours).at("LOBE_WEIGHTS(w)"), "w.first, w.second");
    EXPECT_FALSE(test::definesOf(colours).contains("LOBE_WIDTHS"));
    valueAt("shininess") = 5.0;
    EXPECT_TRUE(test::definesOf(planOf(scene, quality)).contains("LOBE_WIDTHS"));
    valueAt("normalization") = 1.0 - valueAt("normalization");
    const FramePlan forms = planOf(scene, quality);
    EXPECT_EQ(forms.areaMethods.at("phong").method, AreaMethod::sampled);
    EXPECT_EQ(forms.areaMethods.at("phong").reason, "by points on each: its normalization varies");
}

TEST(BodyLightPlan, RaysOnlyForShadows) {
    Scene scene = underBody(LightType::tube);
    Quality quality;
    quality.shadows = Shadows::none;
    const FramePlan none = planOf(scene, quality);
    EXPECT_FALSE(none.rays);
    EXPECT_EQ(none.channel("geometric_normal"), nullptr);
    for (const char* key : {"SHADOWS", "AREA_SHADOWS", "AREA_HARD_SHADOWS", "RAY_ALPHA"})
        EXPECT_FALSE(test::definesOf(none).contains(key)) << key;
    quality.shadows = Shadows::hard;
    const FramePlan hard = planOf(scene, quality);
    EXPECT_TRUE(hard.rays);
    EXPECT_TRUE(test::definesOf(hard).contains("AREA_HARD_SHADOWS"));
    EXPECT_FALSE(test::definesOf(hard).contains("AREA_SAMPLED")) << "one ray to the centre";
    quality.shadows = Shadows::soft;
    const FramePlan soft = planOf(scene, quality);
    EXPECT_TRUE(test::definesOf(soft).contains("AREA_SHADOWS"));
    EXPECT_TRUE(test::definesOf(soft).contains("AREA_ANALYTIC")) << "only the share that arrives is sampled";
    EXPECT_TRUE(test::definesOf(soft).contains("AREA_SAMPLED"));
    EXPECT_FALSE(test::definesOf(soft).contains("RAY_ALPHA"));
    EXPECT_FALSE(test::definesOf(soft).contains("AREA_SPLIT"));
    quality.lightSamples = 256;
    EXPECT_TRUE(test::definesOf(planOf(scene, quality)).contains("AREA_SPLIT"))
        << "more rays than one draw may have";
    scene.lights[0].castsShadow = false;
    const FramePlan cast = planOf(scene, quality);
    EXPECT_FALSE(cast.rays);
    EXPECT_EQ(reasonFor(cast, "tube"), "LOBE_shadow says of each of these lights that it casts none");
}

/// A mirror shows no light without extent, and shows these: the nearest of all types.
TEST(BodyLightPlan, MirrorsIntersectEveryBody) {
    Scene scene = underBody(LightType::rect, "mirror");
    scene.lights.push_back(body(LightType::sphere));
    Quality quality;
    quality.shadows = Shadows::none;
    const FramePlan plan = planOf(scene, quality);
    EXPECT_NE(plan.channel("normal"), nullptr);
    EXPECT_EQ(plan.areaPoints, 0);
    for (const char* name : {"light.rect", "light.sphere"}) {
        ASSERT_NE(plan.pass(name), nullptr) << name;
        const auto& own = plan.pass(name)->variants.front().defines;
        for (const char* key : {"MIRRORED_LIGHTS", "RECT_LIGHTS", "SPHERE_LIGHTS"})
            EXPECT_TRUE(own.contains(key)) << name << ' ' << key;
        EXPECT_FALSE(own.contains("TUBE_LIGHTS"));
    }
    EXPECT_EQ(plan.pass("light.rect")->variants.front().defines.at("MIRRORED_TYPE"), "0");
    EXPECT_EQ(plan.pass("light.sphere")->variants.front().defines.at("MIRRORED_TYPE"), "2");
}

TEST(BodyLightPlan, ForwardSurfacesKeepToOneDraw) {
    Scene scene = underBody(LightType::rect);
    scene.materials[0].alphaMode = AlphaMode::blend;
    for (int i = 0; i < 7; ++i)
        scene.lights.push_back(body(LightType::disk));
    Quality quality;
    quality.lightSamples = 64;
    const FramePlan plan = planOf(scene, quality);
    EXPECT_EQ(plan.pass("light.rect"), nullptr);
    ASSERT_NE(plan.pass("forward"), nullptr);
    const auto& own = plan.pass("forward")->variants.front().defines;
    for (const char* key : {"RECT_LIGHTS", "DISK_LIGHTS", "AREA_SHADOWS", "AREA_ANALYTIC"})
        EXPECT_TRUE(own.contains(key)) << key;
    EXPECT_EQ(plan.areaPointsForward, kRaysPerForwardDraw / 8);
    EXPECT_THAT(plan.notes, testing::Contains(testing::HasSubstr("8 points on each light of 64")));
}

TEST(BodyLightPlan, SaysWhatItDoes) {
    const std::string text = toText(planOf(underBody(LightType::sphere, "ggx")));
    EXPECT_THAT(text, testing::HasSubstr("sphere: 1 light, one loop over all; ggx by "));
    EXPECT_THAT(text, testing::HasSubstr("16 points on each, each with a ray for its shadow"));
}

}  // namespace
}  // namespace lobe
