/// Materials, textures, samplers, images.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gltf_builder.hpp"

namespace lobe::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Material importMaterial(const Gltf& gltf) {
    const Imported imported = gltf.import();
    EXPECT_EQ(imported.scene.materials.size(), 1U);
    return imported.scene.materials.at(0);
}

/// The value of a parameter by its name.
std::vector<double> valueOf(const Material& material, const std::string& parameter) {
    const Brdf& brdf = requireBrdf(material.brdf);
    const int index = brdf.parameterIndex(parameter);
    const auto first = material.values.begin() + brdf.valueOffset(index);
    return {first, first + brdf.parameters.at(static_cast<size_t>(index)).components()};
}

const TextureSlot& slotOf(const Material& material, const std::string& parameter) {
    return material.textures.at(static_cast<size_t>(requireBrdf(material.brdf).parameterIndex(parameter)));
}

uint8_t channelOf(const Material& material, const std::string& parameter) {
    return material.textureChannels.at(
        static_cast<size_t>(requireBrdf(material.brdf).parameterIndex(parameter)));
}

TEST(Materials, DefaultsAreThoseOfGltf) {
    for (const Gltf& gltf : {triangle(), triangle(json::object())}) {
        const Material material = importMaterial(gltf);
        EXPECT_EQ(material.brdf, "metallic_roughness");
        EXPECT_THAT(valueOf(material, "baseColor"), ElementsAre(1.0, 1.0, 1.0));
        EXPECT_THAT(valueOf(material, "metallic"), ElementsAre(1.0));
        EXPECT_THAT(valueOf(material, "roughness"), ElementsAre(1.0));
        EXPECT_EQ(material.emission, glm::vec3(0.0f));
        EXPECT_EQ(material.alphaMode, AlphaMode::opaque);
        EXPECT_EQ(material.alphaCutoff, 0.5f);
        EXPECT_FALSE(material.doubleSided);
    }
}

TEST(Materials, ReadsAllOfMetallicRoughness) {
    Gltf gltf = triangle({{"name", "brass"},
                          {"pbrMetallicRoughness",
                           {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                            {"metallicFactor", 0.5},
                            {"roughnessFactor", 0.6},
                            {"baseColorTexture", {{"index", 0}}},
                            {"metallicRoughnessTexture", {{"index", 1}}}}},
                          {"normalTexture", {{"index", 2}, {"scale", -2}}},
                          {"occlusionTexture", {{"index", 1}, {"strength", 0.25}}},
                          {"emissiveTexture", {{"index", 0}}},
                          {"emissiveFactor", {1, 0.5, 0}},
                          {"alphaMode", "MASK"},
                          {"alphaCutoff", 0.75},
                          {"doubleSided", true}});
    for (int i = 0; i < 3; ++i) {
        addTexture(gltf);
    }
    const Imported imported = gltf.import();
    const Material& material = imported.scene.materials.at(0);
    EXPECT_EQ(material.name, "brass");
    EXPECT_THAT(valueOf(material, "baseColor"), ElementsAre(0.1, 0.2, 0.3));
    EXPECT_THAT(valueOf(material, "metallic"), ElementsAre(0.5));
    EXPECT_THAT(valueOf(material, "roughness"), ElementsAre(0.6));
    EXPECT_FLOAT_EQ(material.alpha, 0.4f);
    EXPECT_EQ(material.alphaMode, AlphaMode::mask);
    EXPECT_EQ(material.alphaCutoff, 0.75f);
    EXPECT_TRUE(material.doubleSided);
    EXPECT_EQ(slotOf(material, "baseColor"), material.baseColorTexture);
    EXPECT_EQ(slotOf(material, "metallic"), material.metallicRoughnessTexture);
    EXPECT_EQ(channelOf(material, "metallic"), 2);
    EXPECT_EQ(slotOf(material, "roughness"), material.metallicRoughnessTexture);
    EXPECT_EQ(channelOf(material, "roughness"), 1);
    EXPECT_EQ(material.normalScale, -2.0f);
    EXPECT_EQ(material.occlusionStrength, 0.25f);
    EXPECT_EQ(material.occlusionTexture.texture, material.metallicRoughnessTexture.texture);
    EXPECT_EQ(material.emissionTexture.texture, material.baseColorTexture.texture);
    EXPECT_EQ(material.emission, glm::vec3(1.0f, 0.5f, 0.0f));
    EXPECT_EQ(imported.scene.textures.size(), 3U);
    EXPECT_EQ(imported.images.size(), 3U);
    EXPECT_EQ(imported.scene.primitives.at(0).tangents.size(), 3U);
}

TEST(Materials, OnlyTexturesInUseAreRead) {
    Gltf gltf = triangle({{"emissiveTexture", {{"index", 1}}},
                          {"emissiveFactor", {0, 0, 0}},
                          {"occlusionTexture", {{"index", 2}}}});
    for (int i = 0; i < 3; ++i) {
        addTexture(gltf);
    }
    gltf.doc["images"][0] = {{"uri", "is-not-there.png"}};
    gltf.doc["images"][1] = {{"uri", "is-not-there-either.png"}};
    const Imported imported = gltf.import();
    EXPECT_THAT(imported.scene.imageNames, ElementsAre("images[2]"));
    EXPECT_EQ(imported.scene.materials.at(0).occlusionTexture.texture, 0);
    EXPECT_FALSE(imported.scene.materials.at(0).emissionTexture);
}

TEST(Materials, EmissiveStrengthMultiplies) {
    const Material material = importMaterial(
        triangle({{"emissiveFactor", {1, 0.5, 0.25}},
                  {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}}}));
    EXPECT_EQ(material.emission, glm::vec3(8, 4, 2));
}

TEST(Materials, UnlitKeepsItsBaseColorAlone) {
    Gltf gltf = triangle({{"pbrMetallicRoughness",
                           {{"baseColorFactor", {0.1, 0.2, 0.3, 1}}, {"baseColorTexture", {{"index", 0}}}}},
                          {"normalTexture", {{"index", 1}}},
                          {"extensions", {{"KHR_materials_unlit", json::object()}}}});
    addTexture(gltf);
    addTexture(gltf);
    const Imported imported = gltf.import();
    const Material& material = imported.scene.materials.at(0);
    EXPECT_EQ(material.brdf, "unlit");
    EXPECT_EQ(material.metallicRoughness.baseColor, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_TRUE(material.baseColorTexture);
    EXPECT_FALSE(material.normalTexture);
    EXPECT_EQ(imported.images.size(), 1U);
    EXPECT_THAT(imported.scene.primitives.at(0).tangents, IsEmpty());
}

TEST(Materials, TextureTransformAndItsTexCoord) {
    Gltf gltf =
        triangle({{"occlusionTexture",
                   {{"index", 0},
                    {"texCoord", 0},
                    {"extensions",
                     {{"KHR_texture_transform",
                       {{"offset", {0.5, -1}}, {"rotation", 0.25}, {"scale", {2, 3}}, {"texCoord", 1}}}}}}}});
    addTexture(gltf);
    const Imported imported = gltf.import();
    const TextureSlot& slot = imported.scene.materials.at(0).occlusionTexture;
    EXPECT_EQ(slot.offset, glm::vec2(0.5f, -1.0f));
    EXPECT_EQ(slot.rotation, 0.25f);
    EXPECT_EQ(slot.scale, glm::vec2(2.0f, 3.0f));
    EXPECT_EQ(slot.uvSet, 1);
    // The mesh has no second set.
    EXPECT_EQ(imported.scene.primitives.at(0).uvs[1].size(), 3U);
    EXPECT_THAT(imported.scene.warnings, ElementsAre(HasSubstr("has no TEXCOORD_1")));
}

TEST(Materials, ThirdUvSetIsLeftOut) {
    Gltf gltf = triangle({{"occlusionTexture", {{"index", 0}, {"texCoord", 2}}}});
    addTexture(gltf);
    const Imported imported = gltf.import();
    EXPECT_FALSE(imported.scene.materials.at(0).occlusionTexture);
    EXPECT_THAT(imported.scene.warnings, ElementsAre(HasSubstr("TEXCOORD_2")));
    EXPECT_THAT(imported.images, IsEmpty());
}

TEST(Materials, SamplersOfAllKinds) {
    struct Case {
        int gltf;
        Filter minify;
        MipFilter mip;
    };
    for (const Case& c :
         {Case{9728, Filter::nearest, MipFilter::none}, Case{9729, Filter::linear, MipFilter::none},
          Case{9984, Filter::nearest, MipFilter::nearest}, Case{9985, Filter::linear, MipFilter::nearest},
          Case{9986, Filter::nearest, MipFilter::linear}, Case{9987, Filter::linear, MipFilter::linear}}) {
        Gltf gltf = triangle({{"occlusionTexture", {{"index", 0}}}});
        addTexture(gltf, {{"minFilter", c.gltf}, {"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33648}});
        const Sampler sampler = gltf.import().scene.textures.at(0).sampler;
        EXPECT_EQ(sampler.minify, c.minify) << c.gltf;
        EXPECT_EQ(sampler.mip, c.mip) << c.gltf;
        EXPECT_EQ(sampler.magnify, Filter::nearest);
        EXPECT_EQ(sampler.wrapS, Wrap::clampToEdge);
        EXPECT_EQ(sampler.wrapT, Wrap::mirroredRepeat);
    }
    Gltf gltf = triangle({{"occlusionTexture", {{"index", 0}}}});
    addTexture(gltf);
    EXPECT_EQ(gltf.import().scene.textures.at(0).sampler, Sampler{});
}

TEST(Materials, WebpWithFallback) {
    Gltf gltf = triangle({{"occlusionTexture", {{"index", 0}}}});
    addTexture(gltf);
    gltf.push("images", {{"uri", "data:image/webp;base64," + base64("webp")}, {"name", "bark"}});
    gltf.doc["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
    const Imported imported = gltf.import();
    ASSERT_EQ(imported.images.size(), 2U);
    const EncodedImage& used = imported.images.at(static_cast<size_t>(imported.scene.textures.at(0).image));
    EXPECT_EQ(used.name, "images[1] (bark)");
    ASSERT_GE(used.fallback, 0);
    EXPECT_EQ(imported.images.at(static_cast<size_t>(used.fallback)).name, "images[0]");
    // Without a fallback, and with a file that is not there.
    gltf.doc["textures"][0].erase("source");
    EXPECT_EQ(gltf.import().images.at(0).fallback, -1);
    gltf.doc["textures"][0]["source"] = 0;
    gltf.doc["images"][1] = {{"uri", "is-not-there.webp"}};
    const Imported fallen = gltf.import();
    EXPECT_EQ(fallen.images.size(), 1U);
    EXPECT_THAT(fallen.scene.warnings, ElementsAre(HasSubstr("taken from images[0]")));
}

TEST(Materials, ImagesInBufferViewsAndFiles) {
    Gltf gltf = triangle({{"occlusionTexture", {{"index", 0}}}});
    const int view = gltf.view(std::vector<char>{'p', 'i', 'c'});
    gltf.push("images", {{"bufferView", view}, {"mimeType", "image/png"}, {"name", "inside"}});
    gltf.push("textures", {{"source", 0}});
    EncodedImage image = gltf.import().images.at(0);
    EXPECT_EQ(image.name, "images[0] (inside)");
    EXPECT_EQ(image.bytes, (std::vector{std::byte{'p'}, std::byte{'i'}, std::byte{'c'}}));
    const TemporaryFolder folder;
    gltf.doc["images"][0] = {{"uri", "maps/occlusion.png"}};
    folder.write("maps/occlusion.png", "content");
    image = importGltf(folder.write("s.gltf", gltf.text()), {}).images.at(0);
    EXPECT_EQ(image.name, "images[0] (maps/occlusion.png)");
    EXPECT_EQ(image.bytes.size(), 7U);
}

TEST(Materials, NamedModels) {
    Gltf gltf = triangle({{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, 0.25}}}},
                          {"extensions",
                           {{"LOBE_materials_brdf",
                             {{"model", "phong"},
                              {"diffuse", {0.1, 0.2, 0.3}},
                              {"shininess", 77},
                              {"normalization", "energy"},
                              {"diffuseTexture", {{"index", 0}}},
                              {"shininessTexture",
                               {{"index", 1},
                                {"channel", 3},
                                {"extensions", {{"KHR_texture_transform", {{"rotation", 1.5}}}}}}}}}}}});
    addTexture(gltf);
    addTexture(gltf);
    const Imported imported = gltf.import();
    const Material& material = imported.scene.materials.at(0);
    EXPECT_EQ(material.brdf, "phong");
    EXPECT_THAT(valueOf(material, "diffuse"), ElementsAre(0.1, 0.2, 0.3));
    EXPECT_THAT(valueOf(material, "specular"), ElementsAre(0.5, 0.5, 0.5));
    EXPECT_THAT(valueOf(material, "shininess"), ElementsAre(77));
    EXPECT_THAT(valueOf(material, "normalization"), ElementsAre(1));
    EXPECT_TRUE(slotOf(material, "diffuse"));
    EXPECT_FALSE(slotOf(material, "specular"));
    EXPECT_EQ(channelOf(material, "shininess"), 3);
    EXPECT_EQ(slotOf(material, "shininess").rotation, 1.5f);
    EXPECT_EQ(material.alpha, 0.25f);
    EXPECT_EQ(imported.scene.textures.size(), 2U);
}

TEST(Materials, NamedModelsAreRefusedWithReason) {
    const auto refused = [](const json& brdf) {
        Gltf gltf = triangle({{"extensions", {{"LOBE_materials_brdf", brdf}}}});
        addTexture(gltf);
        return gltf.refusal();
    };
    const std::string where = "materials[0].extensions.LOBE_materials_brdf";
    EXPECT_EQ(refused({{"model", "lambert"}, {"diffuse", {0.1, 0.2, 0.3}}}), "");
    EXPECT_THAT(refused({{"model", "pong"}}), AllOf(HasSubstr(where + ".model: \"pong\"; expected one of "),
                                                    HasSubstr("did you mean 'phong'?")));
    EXPECT_THAT(
        refused({{"model", "phong"}, {"shinines", 3}}),
        AllOf(HasSubstr(where + ".shinines: 3; expected one of "), HasSubstr("did you mean 'shininess'?")));
    EXPECT_THAT(refused({{"model", "lambert"}, {"diffuse", 0.5}}),
                HasSubstr(where + ".diffuse: 0.5; expected three"));
    EXPECT_THAT(refused({{"model", "lambert"}, {"diffuse", {0.5, 2, 0.5}}}), HasSubstr("diffuse"));
    EXPECT_THAT(refused({{"model", "phong"}, {"shininess", -1}}), HasSubstr("shininess"));
    EXPECT_THAT(refused({{"model", "phong"}, {"shininess", "high"}}), HasSubstr("expected a number"));
    EXPECT_THAT(refused({{"model", "phong"}, {"normalization", "enregy"}}),
                HasSubstr("did you mean 'energy'?"));
    EXPECT_THAT(refused({{"model", "lambert"}, {"diffuseTexture", {{"index", 7}}}}),
                HasSubstr("one of 1 textures"));
    EXPECT_THAT(refused({{"model", "lambert"}, {"diffuseTexture", {{"index", 0}, {"channel", 1}}}}),
                HasSubstr(".channel"));
    EXPECT_THAT(refused({{"model", "phong"}, {"shininessTexture", {{"index", 0}, {"channel", 4}}}}),
                HasSubstr("0 to 3"));
    EXPECT_THAT(refused({{"diffuse", {1, 1, 1}}}), HasSubstr(where + ".model: missing"));
}

TEST(Materials, UnsupportedExtensionsAreNamedOnce) {
    Gltf gltf = triangle({{"extensions", {{"KHR_materials_sheen", json::object()}}}});
    gltf.push(
        "materials",
        {{"extensions", {{"KHR_materials_sheen", json::object()}, {"KHR_materials_ior", json::object()}}}});
    gltf.doc["extensionsUsed"] = {"KHR_materials_sheen", "KHR_materials_ior", "EXT_mesh_gpu_instancing"};
    EXPECT_THAT(gltf.import().scene.warnings, ElementsAre(HasSubstr("EXT_mesh_gpu_instancing"),
                                                          HasSubstr("KHR_materials_ior of 1 material "),
                                                          HasSubstr("KHR_materials_sheen of 2 materials ")));
    gltf.doc["extensionsRequired"] = {"KHR_materials_sheen"};
    EXPECT_THAT(gltf.refusal(), HasSubstr("extensionsRequired[0]: KHR_materials_sheen; expected"));
}

}  // namespace
}  // namespace lobe::test
