#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "gltf_builder.hpp"

namespace lobe::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const float kHalf = std::sqrt(0.5f);

Gltf withLight(const json& light, json node = json::object()) {
    Gltf gltf = triangle();
    gltf.doc["extensions"]["KHR_lights_punctual"]["lights"] = json::array({light});
    node["extensions"]["KHR_lights_punctual"]["light"] = 0;
    gltf.showNode(node);
    return gltf;
}

TEST(Lights, Defaults) {
    const Imported imported = withLight({{"type", "point"}}).import();
    ASSERT_EQ(imported.scene.lights.size(), 1U);
    const Light& light = imported.scene.lights[0];
    EXPECT_EQ(light.type, LightType::point);
    EXPECT_EQ(light.intensity, glm::dvec3(1.0));
    EXPECT_FALSE(light.range.has_value());
    EXPECT_EQ(light.position, glm::dvec3(0.0));
}

TEST(Lights, PlacedWithoutScale) {
    const Imported imported =
        withLight({{"type", "spot"},
                   {"name", "lamp"},
                   {"color", {1, 0.5, 0.25}},
                   {"intensity", 8},
                   {"range", 20},
                   {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}},
                  {{"translation", {1, 2, 3}}, {"scale", {5, 5, -9}}, {"rotation", {0, kHalf, 0, kHalf}}})
            .import();
    const Light& light = imported.scene.lights.at(0);
    EXPECT_EQ(light.name, "lamp");
    EXPECT_EQ(light.type, LightType::spot);
    EXPECT_EQ(light.intensity, glm::dvec3(8, 4, 2));
    EXPECT_EQ(light.range, 20.0);
    EXPECT_EQ(light.innerConeAngle, 0.1);
    EXPECT_EQ(light.outerConeAngle, 0.2);
    EXPECT_EQ(light.position, glm::dvec3(1, 2, 3));
    // -z turned a quarter about y.
    EXPECT_NEAR(light.direction.x, -1.0, 1e-7);
    EXPECT_NEAR(light.direction.y, 0.0, 1e-7);
    EXPECT_NEAR(light.direction.z, 0.0, 1e-7);
}

TEST(Lights, DirectionalHasNoRange) {
    const Imported imported = withLight({{"type", "directional"}, {"range", 3}}).import();
    EXPECT_FALSE(imported.scene.lights.at(0).range.has_value());
    EXPECT_EQ(imported.scene.lights.at(0).direction, glm::dvec3(0, 0, -1));
}

TEST(Lights, DamageIsRefused) {
    Gltf foreign = withLight({{"type", "point"}});
    foreign.doc["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 1;
    EXPECT_THAT(foreign.refusal(),
                HasSubstr("nodes[1].extensions.KHR_lights_punctual.light: 1; expected an index"));
    EXPECT_THAT(withLight({{"type", "laser"}}).refusal(),
                HasSubstr("extensions.KHR_lights_punctual.lights[0].type: \"laser\"; expected one of"));
    EXPECT_THAT(withLight({{"type", "point"}, {"intensity", -1}}).refusal(), HasSubstr("intensity: -1"));
    EXPECT_THAT(withLight({{"type", "point"}, {"range", 0}}).refusal(), HasSubstr("range: 0"));
    EXPECT_THAT(withLight({{"type", "spot"}, {"spot", {{"innerConeAngle", 1}}}}).refusal(),
                HasSubstr("spot.innerConeAngle: 1; expected at most outerConeAngle"));
    EXPECT_THAT(withLight({{"type", "spot"}}).refusal(), HasSubstr("lights[0].spot: missing; expected"));
    EXPECT_THAT(withLight({{"type", "spot"}, {"spot", {{"outerConeAngle", 2}}}}).refusal(),
                HasSubstr("outerConeAngle: 2"));
}

Gltf withCamera(const json& camera, json node = json::object()) {
    Gltf gltf = triangle();
    gltf.push("cameras", camera);
    node["camera"] = 0;
    gltf.showNode(node);
    return gltf;
}

TEST(Cameras, Perspective) {
    const Imported imported =
        withCamera({{"type", "perspective"},
                    {"perspective", {{"yfov", 0.75}, {"znear", 0.5}, {"aspectRatio", 1.5}}}},
                   {{"name", "front"}, {"translation", {0, 0, 9}}, {"rotation", {0, 0, kHalf, kHalf}}})
            .import();
    ASSERT_EQ(imported.scene.cameras.size(), 1U);
    const Camera& camera = imported.scene.cameras[0];
    EXPECT_EQ(camera.name, "front");
    EXPECT_FALSE(camera.orthographic);
    EXPECT_EQ(camera.verticalFov, 0.75);
    EXPECT_EQ(camera.aspect, 1.5);
    EXPECT_EQ(camera.zNear, 0.5);
    EXPECT_FALSE(camera.zFar.has_value());
    EXPECT_EQ(glm::dvec3(camera.worldFromCamera[3]), glm::dvec3(0, 0, 9));
    EXPECT_NEAR(camera.worldFromCamera[0][1], 1.0, 1e-7);
    EXPECT_THAT(imported.scene.warnings, IsEmpty());
}

TEST(Cameras, Orthographic) {
    const Imported imported =
        withCamera({{"type", "orthographic"},
                    {"name", "plan"},
                    {"orthographic", {{"xmag", 4}, {"ymag", 2}, {"znear", 0}, {"zfar", 10}}}})
            .import();
    const Camera& camera = imported.scene.cameras.at(0);
    EXPECT_TRUE(camera.orthographic);
    EXPECT_EQ(camera.name, "plan");
    EXPECT_EQ(camera.xMag, 4.0);
    EXPECT_EQ(camera.yMag, 2.0);
    EXPECT_EQ(camera.zFar, 10.0);
}

TEST(Cameras, AreRigidUnderScaledNodes) {
    const json lens = {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}};
    for (const json& node :
         {json{{"scale", {2, 2, 2}}, {"rotation", {0, kHalf, 0, kHalf}}, {"translation", {1, 2, 3}}},
          json{{"matrix", {0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 1, 2, 3, 1}}}}) {
        const Imported imported = withCamera(lens, node).import();
        const glm::dmat4& m = imported.scene.cameras.at(0).worldFromCamera;
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) {
                EXPECT_NEAR(glm::dot(m[a], m[b]), a == b ? 1.0 : 0.0, 1e-12);
            }
        }
        EXPECT_NEAR(m[2].x, 1.0, 1e-7);
        EXPECT_EQ(glm::dvec3(m[3]), glm::dvec3(1, 2, 3));
        EXPECT_THAT(imported.scene.warnings, ElementsAre(HasSubstr("nodes[1]: its scale does not apply")));
    }
}

TEST(Cameras, DamageIsRefused) {
    const auto perspective = [](json lens) {
        return withCamera({{"type", "perspective"}, {"perspective", std::move(lens)}}).refusal();
    };
    EXPECT_THAT(perspective({{"yfov", 0}, {"znear", 1}}),
                HasSubstr("cameras[0].perspective.yfov: 0; expected"));
    EXPECT_THAT(perspective({{"yfov", 4}, {"znear", 1}}), HasSubstr("yfov: 4"));
    EXPECT_THAT(perspective({{"yfov", 1}, {"znear", 0}}), HasSubstr("znear: 0"));
    EXPECT_THAT(perspective({{"yfov", 1}, {"znear", 2}, {"zfar", 1}}),
                HasSubstr("zfar: 1; expected more than znear 2"));
    EXPECT_THAT(withCamera({{"type", "perspective"}}).refusal(),
                HasSubstr("cameras[0].perspective: missing"));
    EXPECT_THAT(withCamera({{"type", "orthographic"},
                            {"orthographic", {{"xmag", 0}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}}}})
                    .refusal(),
                HasSubstr("cameras[0].orthographic.xmag: 0; expected a number other than 0"));
}

TEST(Lights, ANodeMayCastNoShadows) {
    Gltf gltf = triangle();
    gltf.doc["extensionsUsed"] = {"KHR_lights_punctual", "LOBE_shadow"};
    gltf.doc["extensions"]["KHR_lights_punctual"]["lights"] = json::array({{{"type", "point"}}});
    for (const json& shadow : {json(nullptr), json::object(), json{{"cast", true}}, json{{"cast", false}}}) {
        json node = {{"mesh", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}};
        if (!shadow.is_null()) node["extensions"]["LOBE_shadow"] = shadow;
        Gltf with = gltf;
        with.showNode(node);
        const bool casts = !shadow.is_object() || shadow.value("cast", true);
        const Imported imported = with.import();
        EXPECT_THAT(imported.scene.warnings, IsEmpty());
        EXPECT_EQ(imported.scene.lights.at(0).castsShadow, casts) << shadow;
        EXPECT_EQ(imported.scene.instances.at(1).castsShadow, casts) << shadow;
    }
    json wrong = {{"extensions", {{"LOBE_shadow", {{"cast", 1}}}}}};
    gltf.showNode(wrong);
    EXPECT_THAT(gltf.refusal(), HasSubstr("LOBE_shadow.cast"));
}

}  // namespace
}  // namespace lobe::test
