#include "scene/serialize.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"

namespace lobe::test {
namespace {

/// Every member differs from its default.
Scene fullScene() {
    Scene scene;
    scene.name = "name";
    scene.file = "folder/name.gltf";
    scene.contentHash = "0123456789abcdef";
    scene.images = {{2, 1, 1, ComponentType::u16, std::vector<std::byte>(4, std::byte{7})}};
    scene.imageNames = {"images[0] (a.png)"};
    scene.textures = {
        {0, {Wrap::clampToEdge, Wrap::mirroredRepeat, Filter::nearest, Filter::nearest, MipFilter::none}}};
    Material material;
    material.name = "m";
    material.brdf = "phong";
    material.values = {0.1, 0.2, 0.3};
    material.textures = {{}, {0, 1, {1, 2}, 3, {4, 5}}};
    material.textureChannels = {0, 3};
    material.metallicRoughness = {{0.1, 0.2, 0.3}, 0.4, 0.5};
    material.baseColorTexture = {0, 1, {1, 2}, 3, {4, 5}};
    material.metallicRoughnessTexture = {0, 0, {1, 2}, 3, {4, 5}};
    material.alpha = 0.25f;
    material.alphaMode = AlphaMode::blend;
    material.alphaCutoff = 0.75f;
    material.doubleSided = true;
    material.normalTexture = {0, 1, {9, 2}, 3, {4, 5}};
    material.normalScale = -1;
    material.occlusionTexture = {0, 1, {8, 2}, 3, {4, 5}};
    material.occlusionStrength = 0.5f;
    material.emission = {1, 2, 3};
    material.emissionTexture = {0, 1, {7, 2}, 3, {4, 5}};
    scene.materials = {material, Material{}};
    Primitive primitive;
    primitive.name = "p";
    primitive.material = 1;
    primitive.positions = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
    primitive.normals = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
    primitive.tangents = {{1, 0, 0, 1}, {1, 0, 0, -1}, {0, 1, 0, 1}};
    primitive.uvs = {std::vector<glm::vec2>{{1, 2}, {3, 4}, {5, 6}},
                     std::vector<glm::vec2>{{6, 5}, {4, 3}, {2, 1}}};
    primitive.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 0.5f}};
    primitive.indices = {0, 2, 1};
    scene.primitives = {primitive, Primitive{}};
    scene.instances = {{0, glm::dmat4(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16), "node"}};
    scene.lights = {{"l", LightType::spot, {1, 2, 3}, {0, 1, 0}, {4, 5, 6}, 7.0, 0.1, 0.2}, Light{}};
    scene.lights.push_back({"t", LightType::tube, {}, {}, {}, {}, 0, 0, {0, 0, 1}, 1, 2, 3, 4});
    scene.environment = Environment{
        1, {1, 2, 3}, 4, glm::dmat3(1, 2, 3, 4, 5, 6, 7, 8, 9), false, 3, false, 7, {}, {"a note"}};
    scene.environment->source.sky =
        Sky{SkyModel::gradient, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 2.5, 0.1, 0.2, 0.3};
    scene.environment->source.imageBased = ImageBasedLight{{1, 2, 3, 4, 5, 6}, {{1, 2, 3}, {4, 5, 6}}};
    scene.fog = Fog{{1, 2, 3}, {4, 5, 6}, 7, 8, {0.1, 0.2, 0.3}, 0.9};
    scene.cameras = {{"c", glm::dmat4(2), true, 0.5, 1.5, 2, 3, 4, 5.0}, Camera{}};
    scene.ambientRadiance = glm::dvec3(1, 2, 3);
    scene.warnings = {"careful"};
    scene.animationDurations = {1, 2};
    return scene;
}

TEST(Serialize, KeepsEverything) {
    const Scene scene = fullScene();
    const std::vector<std::byte> bytes = toBytes(scene);
    const Scene copy = sceneFromBytes(bytes);
    EXPECT_EQ(toBytes(copy), bytes);
    EXPECT_EQ(copy.name, scene.name);
    EXPECT_EQ(copy.file, scene.file);
    EXPECT_EQ(copy.contentHash, scene.contentHash);
    EXPECT_EQ(copy.images.at(0).data, scene.images[0].data);
    EXPECT_EQ(copy.images.at(0).width, 2);
    EXPECT_EQ(copy.images.at(0).height, 1);
    EXPECT_EQ(copy.images.at(0).channels, 1);
    EXPECT_EQ(copy.images.at(0).type, ComponentType::u16);
    EXPECT_EQ(copy.imageNames, scene.imageNames);
    EXPECT_EQ(copy.textures.at(0).image, 0);
    EXPECT_EQ(copy.textures.at(0).sampler, scene.textures[0].sampler);
    EXPECT_EQ(copy.ambientRadiance, scene.ambientRadiance);
    EXPECT_EQ(copy.warnings, scene.warnings);
    EXPECT_EQ(copy.animationDurations, scene.animationDurations);
    EXPECT_EQ(copy.instances.at(0).primitive, 0);
    EXPECT_EQ(copy.instances.at(0).worldFromLocal, scene.instances[0].worldFromLocal);
    EXPECT_EQ(copy.instances.at(0).node, "node");
}

TEST(Serialize, KeepsMaterials) {
    const Scene scene = fullScene();
    const Scene copy = sceneFromBytes(toBytes(scene));
    ASSERT_EQ(copy.materials.size(), 2U);
    const Material& a = scene.materials[0];
    const Material& b = copy.materials[0];
    EXPECT_EQ(b.name, a.name);
    EXPECT_EQ(b.brdf, a.brdf);
    EXPECT_EQ(b.values, a.values);
    EXPECT_EQ(b.textures, a.textures);
    EXPECT_EQ(b.textureChannels, a.textureChannels);
    EXPECT_EQ(b.metallicRoughness.baseColor, a.metallicRoughness.baseColor);
    EXPECT_EQ(b.metallicRoughness.metallic, a.metallicRoughness.metallic);
    EXPECT_EQ(b.metallicRoughness.roughness, a.metallicRoughness.roughness);
    EXPECT_EQ(b.baseColorTexture, a.baseColorTexture);
    EXPECT_EQ(b.metallicRoughnessTexture, a.metallicRoughnessTexture);
    EXPECT_EQ(b.alpha, a.alpha);
    EXPECT_EQ(b.alphaMode, a.alphaMode);
    EXPECT_EQ(b.alphaCutoff, a.alphaCutoff);
    EXPECT_EQ(b.doubleSided, a.doubleSided);
    EXPECT_EQ(b.normalTexture, a.normalTexture);
    EXPECT_EQ(b.normalScale, a.normalScale);
    EXPECT_EQ(b.occlusionTexture, a.occlusionTexture);
    EXPECT_EQ(b.occlusionStrength, a.occlusionStrength);
    EXPECT_EQ(b.emission, a.emission);
    EXPECT_EQ(b.emissionTexture, a.emissionTexture);
}

TEST(Serialize, KeepsGeometryLightsAndCameras) {
    const Scene scene = fullScene();
    const Scene copy = sceneFromBytes(toBytes(scene));
    ASSERT_EQ(copy.primitives.size(), 2U);
    EXPECT_EQ(copy.primitives[0].name, "p");
    EXPECT_EQ(copy.primitives[0].material, 1);
    EXPECT_EQ(copy.primitives[0].positions, scene.primitives[0].positions);
    EXPECT_EQ(copy.primitives[0].normals, scene.primitives[0].normals);
    EXPECT_EQ(copy.primitives[0].tangents, scene.primitives[0].tangents);
    EXPECT_EQ(copy.primitives[0].uvs, scene.primitives[0].uvs);
    EXPECT_EQ(copy.primitives[0].colors, scene.primitives[0].colors);
    EXPECT_EQ(copy.primitives[0].indices, scene.primitives[0].indices);
    ASSERT_EQ(copy.lights.size(), 3U);
    EXPECT_EQ(copy.lights[0].name, "l");
    EXPECT_EQ(copy.lights[0].type, LightType::spot);
    EXPECT_EQ(copy.lights[0].position, scene.lights[0].position);
    EXPECT_EQ(copy.lights[0].direction, scene.lights[0].direction);
    EXPECT_EQ(copy.lights[0].intensity, scene.lights[0].intensity);
    EXPECT_EQ(copy.lights[0].range, 7.0);
    EXPECT_EQ(copy.lights[0].innerConeAngle, 0.1);
    EXPECT_EQ(copy.lights[0].outerConeAngle, 0.2);
    EXPECT_FALSE(copy.lights[1].range.has_value());
    EXPECT_EQ(copy.lights[2].axis, scene.lights[2].axis);
    EXPECT_EQ(copy.lights[2].width, 1.0);
    EXPECT_EQ(copy.lights[2].height, 2.0);
    EXPECT_EQ(copy.lights[2].radius, 3.0);
    EXPECT_EQ(copy.lights[2].length, 4.0);
    ASSERT_TRUE(copy.environment.has_value());
    EXPECT_EQ(copy.environment->image, 1);
    EXPECT_EQ(copy.environment->radiance, scene.environment->radiance);
    EXPECT_EQ(copy.environment->intensity, 4.0);
    EXPECT_EQ(copy.environment->worldFromMap, scene.environment->worldFromMap);
    EXPECT_FALSE(copy.environment->background);
    ASSERT_TRUE(copy.fog.has_value());
    EXPECT_EQ(copy.fog->extinction, scene.fog->extinction);
    EXPECT_EQ(copy.fog->radiance, scene.fog->radiance);
    EXPECT_EQ(copy.fog->heightFalloff, 7.0);
    EXPECT_EQ(copy.fog->height, 8.0);
    EXPECT_EQ(copy.fog->scattering, scene.fog->scattering);
    EXPECT_EQ(copy.fog->anisotropy, 0.9);
    ASSERT_EQ(copy.cameras.size(), 2U);
    EXPECT_EQ(copy.cameras[0].name, "c");
    EXPECT_EQ(copy.cameras[0].worldFromCamera, scene.cameras[0].worldFromCamera);
    EXPECT_TRUE(copy.cameras[0].orthographic);
    EXPECT_EQ(copy.cameras[0].verticalFov, 0.5);
    EXPECT_EQ(copy.cameras[0].aspect, 1.5);
    EXPECT_EQ(copy.cameras[0].xMag, 2.0);
    EXPECT_EQ(copy.cameras[0].yMag, 3.0);
    EXPECT_EQ(copy.cameras[0].zNear, 4.0);
    EXPECT_EQ(copy.cameras[0].zFar, 5.0);
    EXPECT_FALSE(copy.cameras[1].zFar.has_value());
}

TEST(Serialize, RefusesWhatIsCutOffOrTooLong) {
    std::vector<std::byte> bytes = toBytes(fullScene());
    for (size_t length = 0; length < bytes.size(); ++length) {
        EXPECT_THROW((void)sceneFromBytes(std::span(bytes).first(length)), InputError) << length;
    }
    bytes.push_back(std::byte{0});
    EXPECT_THROW((void)sceneFromBytes(bytes), InputError);
}

TEST(Serialize, HugeSizesTakeNoMemory) {
    const std::vector<std::byte> bytes(64, std::byte{0x7f});
    EXPECT_THROW((void)sceneFromBytes(bytes), InputError);
}

}  // namespace
}  // namespace lobe::test
