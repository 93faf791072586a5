// Schlick's approximation for a whole scene: which materials it reaches, and with which reflectance.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plan/plan.hpp"
#include "support/scenes.hpp"

namespace lobe {
namespace {

Scene litQuad() {
    Scene scene;
    test::addInstance(scene, test::addQuad(scene, test::addMaterial(scene, "cook_torrance"), 1.0f));
    scene.lights.push_back(test::directional({0, 0, -1}, glm::dvec3(1.0)));
    return scene;
}

TEST(FresnelOverride, SchlickReplacesExactFresnelWhereOneF0CanStandForIt) {
    Scene scene = litQuad();
    const auto use = [&](const char* metal) {
        scene = litQuad();
        scene = withParameters(scene, {{"metal", metal, {}}});
    };
    EXPECT_EQ(summarise(scene).exactFresnel, 0) << "Schlick's already";
    use("gold");
    EXPECT_EQ(summarise(scene).exactFresnel, 1);
    const Scene replaced = withSchlick(scene);
    EXPECT_EQ(summarise(replaced).exactFresnel, 0);
    EXPECT_TRUE(summarise(replaced).keptFresnel.empty());
    // Head on, light comes straight back: both are F0.
    const Brdf& brdf = requireBrdf("cook_torrance");
    const Directions headOn(glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 1));
    const glm::dvec3 before = brdf.fCos(headOn, scene.materials[0].values);
    const glm::dvec3 after = brdf.fCos(headOn, replaced.materials[0].values);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(after[c], before[c], 1e-14 * before[c]);

    const Scene banded = withBands(scene, 8);
    EXPECT_EQ(summarise(banded).exactFresnel, 0);
    EXPECT_EQ(withSchlick(banded).materials[0].values, banded.materials[0].values);
    EXPECT_THAT(
        planFrame(summarise(banded), {.fresnel = FresnelEquations::schlick}, {}, {Aov::radiance}).notes,
        testing::Contains(testing::HasSubstr("exact in 1 material, since the metal is evaluated in bands")));

    scene.materials[0].textures[static_cast<size_t>(brdf.parameterIndex("k"))].texture = 0;
    EXPECT_EQ(whyFresnelStays(scene.materials[0]), "the index is textured");
    EXPECT_EQ(withSchlick(scene).materials[0].values, scene.materials[0].values);
}

}  // namespace
}  // namespace lobe
