#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gltf_builder.hpp"

namespace lobe::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

Gltf withImage(const json& extension, const char* type = "rect", const json& node = json::object()) {
    Gltf gltf = triangle();
    gltf.doc["extensionsUsed"] = {"EXT_lights_area", "LOBE_light_image", "LOBE_visible_light"};
    gltf.doc["extensions"]["EXT_lights_area"]["lights"] =
        json::array({{{"type", type}, {"extensions", {{"LOBE_light_image", extension}}}}});
    json placed = node;
    placed["extensions"]["EXT_lights_area"]["light"] = 0;
    gltf.showNode(placed);
    return gltf;
}

TEST(LightImageExtension, IsReadBesideTheScene) {
    const TemporaryFolder folder;
    folder.write("panes.png", "bytes");
    const Gltf gltf = withImage({{"image", "panes.png"}});
    const Imported imported = importGltf(folder.write("scene.gltf", gltf.text()), {});
    EXPECT_THAT(imported.scene.warnings, IsEmpty());
    EXPECT_EQ(imported.scene.lights.at(0).image, 0);
    ASSERT_EQ(imported.images.size(), 1U);
    EXPECT_EQ(imported.images[0].bytes.size(), 5U);
    EXPECT_THAT(imported.images[0].name,
                AllOf(HasSubstr("EXT_lights_area.lights[0].extensions.LOBE_light_image.image"),
                      HasSubstr("panes.png")));
    EXPECT_THAT(imported.scene.textures, IsEmpty());

    folder.write("panes.png", "other");
    EXPECT_NE(importGltf(folder.path() / "scene.gltf", {}).scene.contentHash, imported.scene.contentHash);
}

TEST(LightImageExtension, LightsShareOne) {
    const TemporaryFolder folder;
    folder.write("panes.png", "bytes");
    Gltf gltf = withImage({{"image", "panes.png"}});
    gltf.showNode({{"extensions", {{"EXT_lights_area", {{"light", 0}}}}}, {"translation", {1, 0, 0}}});
    const Imported imported = importGltf(folder.write("scene.gltf", gltf.text()), {});
    ASSERT_EQ(imported.scene.lights.size(), 2U);
    EXPECT_EQ(imported.scene.lights[0].image, 0);
    EXPECT_EQ(imported.scene.lights[1].image, 0);
    EXPECT_EQ(imported.images.size(), 1U);
}

TEST(LightImageExtension, TheVisibleBodyShowsIt) {
    const TemporaryFolder folder;
    folder.write("panes.png", "bytes");
    const Gltf gltf = withImage({{"image", "panes.png"}}, "rect",
                                {{"extensions", {{"LOBE_visible_light", json::object()}}}});
    const Scene scene = importGltf(folder.write("scene.gltf", gltf.text()), {}).scene;
    ASSERT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.textures[0].image, scene.lights.at(0).image);
    EXPECT_EQ(scene.textures[0].sampler.wrapS, Wrap::clampToEdge);
    ASSERT_EQ(scene.instances.size(), 2U);
    const Primitive& body = scene.primitives[static_cast<size_t>(scene.instances[1].primitive)];
    EXPECT_EQ(scene.materials[static_cast<size_t>(body.material)].baseColorTexture.texture, 0);
    // The corner at local +X, +Y is the picture's first texel.
    ASSERT_EQ(body.uvs[0].size(), 4U);
    for (size_t i = 0; i < 4; ++i) {
        const glm::dvec3 world(scene.instances[1].worldFromLocal *
                               glm::dvec4(glm::dvec3(body.positions[i]), 1.0));
        EXPECT_EQ(body.uvs[0][i], glm::vec2(world.x > 0.0 ? 0.0F : 1.0F, world.y > 0.0 ? 0.0F : 1.0F));
    }
}

/// An environment's faces are taken off the end once they are one picture.
TEST(LightImageExtension, ComesBeforeTheFacesOfAnEnvironment) {
    const TemporaryFolder folder;
    folder.write("panes.png", "bytes");
    Gltf gltf = withImage({{"image", "panes.png"}});
    gltf.doc["extensionsUsed"].push_back("EXT_lights_image_based");
    gltf.doc["scenes"][0]["extensions"]["EXT_lights_image_based"] = {{"light", 0}};
    gltf.doc["extensions"]["EXT_lights_image_based"]["lights"] = {
        {{"specularImages", {{0, 1, 2, 3, 4, 5}}},
         {"irradianceCoefficients", json(std::vector<std::vector<double>>(9, {0.1, 0.2, 0.3}))}}};
    for (int i = 0; i < 6; ++i)
        gltf.doc["images"].push_back({{"uri", "data:image/png;base64,eA=="}});
    const Scene scene = importGltf(folder.write("scene.gltf", gltf.text()), {}).scene;
    ASSERT_TRUE(scene.environment && scene.environment->source.imageBased);
    EXPECT_EQ(scene.lights.at(0).image, 0);
    EXPECT_EQ(scene.environment->source.imageBased->faces, (std::vector<int>{1, 2, 3, 4, 5, 6}));
}

TEST(LightImageExtension, DamageIsRefused) {
    EXPECT_THAT(withImage({{"image", "missing.png"}}).refusal(), HasSubstr("missing.png"));
    EXPECT_THAT(withImage({{"image", "../a.png"}}).refusal(), HasSubstr("../a.png"));
    EXPECT_THAT(withImage({{"image", 3}}).refusal(), HasSubstr("LOBE_light_image.image: 3; expected"));
    EXPECT_THAT(withImage(json::object()).refusal(), HasSubstr("LOBE_light_image.image: missing"));
    EXPECT_THAT(withImage({{"image", "a.png"}}, "disk").refusal(),
                AllOf(HasSubstr("lights[0].extensions.LOBE_light_image"), HasSubstr("\"disk\""),
                      HasSubstr("\"rect\"")));
}

TEST(LightImageExtension, IsRefusedOnPunctualLights) {
    Gltf gltf = triangle();
    gltf.doc["extensionsUsed"] = {"KHR_lights_punctual", "LOBE_light_image"};
    gltf.doc["extensions"]["KHR_lights_punctual"]["lights"] =
        json::array({{{"type", "point"}, {"extensions", {{"LOBE_light_image", {{"image", "a.png"}}}}}}});
    gltf.showNode({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    EXPECT_THAT(gltf.refusal(), AllOf(HasSubstr("KHR_lights_punctual.lights[0]"), HasSubstr("\"point\"")));
}

}  // namespace
}  // namespace lobe::test
