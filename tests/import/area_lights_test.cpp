#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gltf_builder.hpp"

namespace lobe::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const float kHalf = std::sqrt(0.5f);

Gltf withLight(const char* extension, const json& light, json node = json::object()) {
    Gltf gltf = triangle();
    gltf.doc["extensionsUsed"] = {extension, "LOBE_light_shape"};
    gltf.doc["extensions"][extension]["lights"] = json::array({light});
    node["extensions"][extension]["light"] = 0;
    gltf.showNode(node);
    return gltf;
}

Gltf withArea(const json& light, const json& node = json::object()) {
    return withLight("EXT_lights_area", light, node);
}

Gltf withShape(const json& shape, const char* type = "point") {
    return withLight("KHR_lights_punctual", {{"type", type},
                                             {"intensity", 5},
                                             {"spot", json::object()},
                                             {"extensions", {{"LOBE_light_shape", shape}}}});
}

TEST(AreaLights, Defaults) {
    const Imported imported = withArea({{"type", "rect"}}).import();
    EXPECT_THAT(imported.scene.warnings, IsEmpty());
    const Light& light = imported.scene.lights.at(0);
    EXPECT_EQ(light.type, LightType::rect);
    EXPECT_EQ(radianceOf(light), glm::dvec3(1000.0));
    EXPECT_EQ(light.width, 1.0);
    EXPECT_EQ(light.height, 1.0);
    EXPECT_EQ(light.direction, glm::dvec3(0, 0, -1));
    EXPECT_EQ(light.axis, glm::dvec3(1, 0, 0));
}

TEST(AreaLights, AreSeenOnRequest) {
    const json seen = {{"extensions", {{"LOBE_visible_light", json::object()}}}, {"translation", {1, 2, 3}}};
    EXPECT_EQ(withArea({{"type", "rect"}}).import().scene.instances.size(), 1U);
    for (const char* type : {"rect", "disk"}) {
        const Imported imported =
            withArea({{"type", type}, {"size", 0.5}, {"intensity", 7}, {"color", {1, 0.5, 0}}}, seen)
                .import();
        EXPECT_THAT(imported.scene.warnings, IsEmpty());
        ASSERT_EQ(imported.scene.instances.size(), 2U);
        const Instance& instance = imported.scene.instances[1];
        EXPECT_FALSE(instance.castsShadow);
        const Primitive& body = imported.scene.primitives[static_cast<size_t>(instance.primitive)];
        const Material& material = imported.scene.materials[static_cast<size_t>(body.material)];
        EXPECT_EQ(material.brdf, "unlit");
        EXPECT_EQ(material.metallicRoughness.baseColor, glm::dvec3(7, 3.5, 0));
        // The area, and the side that the light leaves from.
        glm::dvec3 area(0.0);
        for (size_t i = 0; i < body.indices.size(); i += 3) {
            const auto at = [&](size_t k) {
                return glm::dvec3(instance.worldFromLocal *
                                  glm::dvec4(body.positions[body.indices[i + k]], 1.0));
            };
            area += glm::cross(at(1) - at(0), at(2) - at(0)) / 2.0;
        }
        const double expected = type == std::string("rect") ? 0.25 : 0.0625 * std::numbers::pi;
        EXPECT_NEAR(glm::dot(area, imported.scene.lights[0].direction), expected, 1e-3 * expected) << type;
    }
    Gltf tube = withShape({{"shape", "tube"}, {"radius", 0.1}, {"length", 2.0}});
    tube.doc["nodes"].back()["extensions"]["LOBE_visible_light"] = json::object();
    const Imported imported = tube.import();
    Bounds bounds;
    for (const glm::vec3& p : imported.scene.primitives.back().positions)
        bounds.add(glm::dvec3(p));
    EXPECT_NEAR(bounds.upper.x, 1.1, 1e-6);
    EXPECT_NEAR(bounds.lower.x, -1.1, 1e-6);
    EXPECT_NEAR(bounds.upper.z, 0.1, 1e-6);

    Gltf point = withLight("KHR_lights_punctual", {{"type", "point"}}, seen);
    EXPECT_THAT(point.refusal(), HasSubstr("LOBE_visible_light: on a light without a body"));
}

TEST(AreaLights, SizeIsScaledByTheLargestComponent) {
    const json node = {{"translation", {1, 2, 3}}, {"scale", {2, -3, 1}}, {"rotation", {0, 0, kHalf, kHalf}}};
    const Imported rect = withArea({{"type", "rect"},
                                    {"color", {1, 0.5, 0}},
                                    {"intensity", 4},
                                    {"size", 2},
                                    {"rect", {{"aspect", 1.5}}}},
                                   node)
                              .import();
    const Light& light = rect.scene.lights.at(0);
    EXPECT_EQ(light.intensity, glm::dvec3(4, 2, 0));
    EXPECT_DOUBLE_EQ(light.height, 6.0);
    EXPECT_DOUBLE_EQ(light.width, 9.0);
    EXPECT_EQ(light.position, glm::dvec3(1, 2, 3));
    const Imported disk = withArea({{"type", "disk"}, {"size", 0.5}}, node).import();
    EXPECT_EQ(disk.scene.lights.at(0).type, LightType::disk);
    EXPECT_DOUBLE_EQ(disk.scene.lights.at(0).radius, 0.75);
}

TEST(AreaLights, AxesAreOrthonormal) {
    const Imported imported =
        withArea({{"type", "rect"}}, {{"rotation", {0.5, 0.5, 0.5, 0.5}}, {"scale", {2, 2, 2}}}).import();
    const Light& light = imported.scene.lights.at(0);
    EXPECT_NEAR(glm::dot(light.axis, light.direction), 0.0, 1e-15);
    EXPECT_NEAR(glm::length(light.axis), 1.0, 1e-15);
    EXPECT_NEAR(light.direction.x, -1.0, 1e-15);  // -z turned about (1, 1, 1)
    EXPECT_NEAR(light.axis.y, 1.0, 1e-15);
}

TEST(LightShape, KeepsRadiantIntensity) {
    const Imported sphere = withShape({{"shape", "sphere"}, {"radius", 0.1}}).import();
    EXPECT_THAT(sphere.scene.warnings, IsEmpty());
    const Light& ball = sphere.scene.lights.at(0);
    EXPECT_EQ(ball.type, LightType::sphere);
    EXPECT_EQ(ball.intensity, glm::dvec3(5.0));
    EXPECT_NEAR(radianceOf(ball).x, 5.0 / (std::numbers::pi * 0.01), 1e-12);
    const Imported tube = withShape({{"shape", "tube"}, {"radius", 0.1}, {"length", 2}}).import();
    const Light& rod = tube.scene.lights.at(0);
    EXPECT_EQ(rod.type, LightType::tube);
    EXPECT_NEAR(radianceOf(rod).x, 5.0 / (0.4 + std::numbers::pi * 0.01), 1e-12);
}

TEST(LightShape, DamageIsRefused) {
    EXPECT_THAT(withShape({{"shape", "cube"}, {"radius", 1}}).refusal(), HasSubstr("shape: \"cube\""));
    EXPECT_THAT(withShape({{"shape", "sphere"}, {"radius", 0}}).refusal(), HasSubstr("radius: 0"));
    EXPECT_THAT(withShape({{"shape", "sphere"}}).refusal(), HasSubstr("radius: missing"));
    EXPECT_THAT(withShape({{"shape", "tube"}, {"radius", 1}}).refusal(), HasSubstr("length: missing"));
    EXPECT_THAT(withShape({{"shape", "tube"}, {"radius", 1}, {"length", -1}}).refusal(),
                HasSubstr("length: -1"));
    EXPECT_THAT(withShape({{"shape", "sphere"}, {"radius", 1}}, "spot").refusal(),
                HasSubstr("LOBE_light_shape: on a light of another type; expected a light of type"));
}

TEST(AreaLights, DamageIsRefused) {
    EXPECT_THAT(withArea({{"type", "ring"}}).refusal(), HasSubstr("type: \"ring\""));
    EXPECT_THAT(withArea({{"type", "rect"}, {"size", 0}}).refusal(), HasSubstr("size: 0"));
    EXPECT_THAT(withArea({{"type", "rect"}, {"rect", {{"aspect", 0}}}}).refusal(), HasSubstr("aspect: 0"));
    EXPECT_THAT(withArea({{"type", "disk"}}, {{"scale", {0, 0, 0}}}).refusal(),
                HasSubstr("lights[0].size, scaled by its node: 0; expected 1e-9 to 1e9 m"));
    Gltf foreign = withArea({{"type", "rect"}});
    foreign.doc["nodes"][1]["extensions"]["EXT_lights_area"]["light"] = 1;
    EXPECT_THAT(foreign.refusal(), HasSubstr("EXT_lights_area.light: 1; expected an index"));
}

}  // namespace
}  // namespace lobe::test
