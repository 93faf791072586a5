// Images on lights in the plan: nothing of them without one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planning.hpp"

namespace lobe {
namespace {

using test::planOf;
using test::reasonFor;

Scene lit(const std::string& model, bool image, LightType type = LightType::rect) {
    Scene scene;
    test::addInstance(scene, test::addQuad(scene, test::addMaterial(scene, model), 1.0F));
    Light light;
    light.type = type;
    light.width = light.height = light.radius = 1.0;
    light.position = {0, 0, 2};
    if (image) {
        test::addImage(scene, 6, 4, 3, [](int, int, int) { return 128; });
        light.image = 0;
    }
    scene.lights.push_back(light);
    return scene;
}

TEST(LightImagePlan, AbsentWithoutThem) {
    for (const Shading shading : {Shading::deferred, Shading::forward}) {
        Quality quality;
        quality.shading = shading;
        const FramePlan plan = planOf(lit("lambert", false), quality);
        EXPECT_FALSE(plan.lightImages);
        EXPECT_FALSE(test::definesOf(plan).contains("RECT_IMAGES"));
        EXPECT_EQ(reasonFor(plan, "images on lights"), "no light shows an image");
    }
}

TEST(LightImagePlan, OneDefineAndANote) {
    for (const char* model : {"lambert", "ggx", "he", "mirror"})
        for (const Shading shading : {Shading::deferred, Shading::forward}) {
            Quality quality;
            quality.shading = shading;
            const FramePlan plan = planOf(lit(model, true), quality);
            EXPECT_TRUE(plan.lightImages) << model;
            EXPECT_TRUE(test::definesOf(plan).contains("RECT_IMAGES")) << model;
            EXPECT_THAT(plan.notes,
                        testing::Contains(testing::HasSubstr("images on lights: 1 rect (6 x 4 texels)")));
        }
}

TEST(LightImagePlan, NotInProgramsOfOtherLights) {
    Scene scene = lit("lambert", true);
    Light ball;
    ball.type = LightType::sphere;
    ball.radius = 0.1;
    scene.lights.push_back(ball);
    const FramePlan plan = planOf(scene);
    for (const Variant& variant : plan.pass("light.sphere")->variants)
        EXPECT_FALSE(variant.defines.contains("RECT_IMAGES"));
    for (const Variant& variant : plan.pass("light.rect")->variants)
        EXPECT_TRUE(variant.defines.contains("RECT_IMAGES"));
}

TEST(LightImagePlan, LeftOutWhereNothingShowsLight) {
    const FramePlan plan = planOf(lit("unlit", true));
    EXPECT_FALSE(plan.lightImages);
    EXPECT_EQ(reasonFor(plan, "images on lights"), "no surface shows light of a body");
}

}  // namespace
}  // namespace lobe
