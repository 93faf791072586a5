/// Materials, textures, samplers, images.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gltf_builder.hpp"
#include "scene/brdf_tables.hpp"

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

/// The material that a LOBE_materials_brdf object makes, beside files that it names.
Material namedModel(const json& brdf) {
    return triangle({{"extensions", {{"LOBE_materials_brdf", brdf}}}}).import().scene.materials.at(0);
}

TEST(Materials, FresnelIsAnObjectOfItsOwn) {
    const Material exact =
        namedModel({{"model", "cook_torrance"},
                    {"m", 0.2},
                    {"fresnel", {{"type", "conductor"}, {"eta", {0.1, 0.2, 0.3}}, {"k", 3.5}}}});
    EXPECT_THAT(valueOf(exact, "fresnel"), ElementsAre(2));
    EXPECT_THAT(valueOf(exact, "eta"), ElementsAre(0.1, 0.2, 0.3));
    EXPECT_THAT(valueOf(exact, "k"), ElementsAre(3.5, 3.5, 3.5));
    const Material glass =
        namedModel({{"model", "mirror"}, {"fresnel", {{"type", "dielectric"}, {"eta", 1.33}}}});
    EXPECT_THAT(valueOf(glass, "fresnel"), ElementsAre(1));
    EXPECT_THAT(valueOf(glass, "eta"), ElementsAre(1.33, 1.33, 1.33));
    const Material gold = namedModel({{"model", "he"}, {"fresnel", {{"type", "metal"}, {"name", "gold"}}}});
    EXPECT_THAT(valueOf(gold, "fresnel"), ElementsAre(2));
    EXPECT_THAT(valueOf(gold, "eta"), ElementsAre(0.1837, 0.4573, 1.3724));
    const Material iron =
        namedModel({{"model", "ggx"}, {"fresnel", {{"type", "schlick"}, {"name", "iron"}}}});
    EXPECT_THAT(valueOf(iron, "f0"), ElementsAre(0.56, 0.57, 0.58));
}

TEST(Materials, FresnelIsRefusedWithReason) {
    const auto refused = [](const json& fresnel) {
        return triangle(
                   {{"extensions", {{"LOBE_materials_brdf", {{"model", "mirror"}, {"fresnel", fresnel}}}}}})
            .refusal();
    };
    const std::string where = "materials[0].extensions.LOBE_materials_brdf.fresnel";
    EXPECT_THAT(refused(1.5), HasSubstr(where + ": 1.5; expected an object with a type"));
    EXPECT_THAT(refused({{"eta", 1.5}}), HasSubstr(where + ".type: missing; expected one of schlick, "));
    EXPECT_THAT(refused({{"type", "conducter"}}), HasSubstr("did you mean 'conductor'?"));
    EXPECT_THAT(
        refused({{"type", "metal"}, {"name", "glod"}}),
        AllOf(HasSubstr(where + ".name: \"glod\"; expected one of "), HasSubstr("did you mean 'gold'?")));
    EXPECT_THAT(refused({{"type", "metal"}}), HasSubstr(where + ".name: missing"));
    EXPECT_THAT(refused({{"type", "dielectric"}, {"ior", 1.5}}),
                HasSubstr(where + ".ior: 1.5; expected one of"));
    EXPECT_THAT(refused({{"type", "dielectric"}, {"eta", 0}}), HasSubstr("eta[0]: 0; expected 0.01..20"));
    EXPECT_THAT(
        triangle({{"extensions", {{"LOBE_materials_brdf", {{"model", "mirror"}, {"eta", 1.5}}}}}}).refusal(),
        HasSubstr("LOBE_materials_brdf.eta: 1.5; expected one of fresnel"));
}

TEST(Materials, PresetsAreOverriddenByTheParametersBesideThem) {
    const Material brass = namedModel({{"model", "ward_anisotropic"}, {"preset", "rolled brass"}});
    EXPECT_THAT(valueOf(brass, "diffuse"), ElementsAre(0.10, 0.10, 0.10));
    EXPECT_THAT(valueOf(brass, "specular"), ElementsAre(0.33, 0.33, 0.33));
    EXPECT_THAT(valueOf(brass, "alphaX"), ElementsAre(0.05));
    EXPECT_THAT(valueOf(brass, "alphaY"), ElementsAre(0.16));
    // "alphaX" is read before "preset", which it still replaces.
    const Material wider = namedModel(
        {{"model", "ward_anisotropic"}, {"preset", "rolled brass"}, {"alphaX", 0.1}, {"variant", "bounded"}});
    EXPECT_THAT(valueOf(wider, "alphaX"), ElementsAre(0.1));
    EXPECT_THAT(valueOf(wider, "alphaY"), ElementsAre(0.16));
    EXPECT_THAT(valueOf(wider, "variant"), ElementsAre(2));

    const Brdf& lafortune = requireBrdf("lafortune");
    const Material paint = namedModel({{"model", "lafortune"}, {"preset", "bluepaint"}});
    EXPECT_THAT(valueOf(paint, "diffuse"), ElementsAre(0.3094, 0.39667, 0.70837));
    EXPECT_EQ(lafortune.tableOf(paint.values)[0], 3.0);
    const Material ownLobe = namedModel({{"model", "lafortune"},
                                         {"preset", "bluepaint"},
                                         {"lobes", {{{"cx", -1}, {"cy", -1}, {"cz", 1}, {"n", 20}}}}});
    EXPECT_THAT(valueOf(ownLobe, "diffuse"), ElementsAre(0.3094, 0.39667, 0.70837));
    EXPECT_EQ(lafortune.tableOf(ownLobe.values)[0], 1.0);

    const Material aluminium =
        namedModel({{"model", "he"}, {"preset", "rough aluminium"}, {"fresnel", {{"type", "schlick"}}}});
    EXPECT_THAT(valueOf(aluminium, "tau"), ElementsAre(1.77e-6));
    EXPECT_THAT(valueOf(aluminium, "fresnel"), ElementsAre(0));
}

TEST(Materials, UnknownPresetsAreRefusedWithTheList) {
    const auto refused = [](const json& extension) {
        return triangle({{"extensions", {{"LOBE_materials_brdf", extension}}}}).refusal();
    };
    EXPECT_THAT(
        refused({{"model", "ward_anisotropic"}, {"preset", "roled brass"}}),
        AllOf(HasSubstr("LOBE_materials_brdf.preset: \"roled brass\"; expected one of rolled brass, "),
              HasSubstr("did you mean 'rolled brass'?")));
    EXPECT_THAT(refused({{"model", "ward_anisotropic"}, {"preset", 3}}),
                HasSubstr("LOBE_materials_brdf.preset: 3; expected one of"));
    EXPECT_THAT(refused({{"model", "ward_anisotropic"}, {"presets", "rolled brass"}}),
                HasSubstr("did you mean 'preset'?"));
    EXPECT_THAT(refused({{"model", "lambert"}, {"preset", "rolled brass"}}),
                HasSubstr("LOBE_materials_brdf.preset: \"rolled brass\"; expected one of diffuse"));
}

TEST(Materials, LafortunesLobes) {
    const Brdf& brdf = requireBrdf("lafortune");
    const Material own = namedModel({{"model", "lafortune"},
                                     {"diffuse", {0.1, 0.1, 0.1}},
                                     {"lobes",
                                      {{{"cx", -1}, {"cy", {-1, -0.9, -0.8}}, {"cz", 1}, {"n", 20}},
                                       {{"cx", 0}, {"cy", 0}, {"cz", 0.9}, {"n", {1, 2, 3}}}}}});
    EXPECT_THAT(std::vector<double>(brdf.tableOf(own.values).begin(), brdf.tableOf(own.values).end()),
                ElementsAre(2, 0, 0, 0,                                                   //
                            -1, -1, -1, 0, -1, -0.9, -0.8, 0, 1, 1, 1, 0, 20, 20, 20, 0,  //
                            0, 0, 0, 0, 0, 0, 0, 0, 0.9, 0.9, 0.9, 0, 1, 2, 3, 0));
    EXPECT_EQ(brdf.tableOf(namedModel({{"model", "lafortune"}, {"lobes", "brushedmetal"}}).values)[0], 3.0);
    const auto refused = [](const json& lobes) {
        return triangle(
                   {{"extensions", {{"LOBE_materials_brdf", {{"model", "lafortune"}, {"lobes", lobes}}}}}})
            .refusal();
    };
    const json sound = {{"cx", -1}, {"cy", -1}, {"cz", 1}, {"n", 20}};
    EXPECT_EQ(refused(json::array({sound})), "");
    EXPECT_THAT(refused(json::array()), HasSubstr("lobes: []; expected an array of 1 to"));
    EXPECT_THAT(refused("brushedmetl"), HasSubstr("did you mean"));
    json broken = sound;
    broken["n"] = -2;
    EXPECT_THAT(refused(json::array({sound, broken})),
                HasSubstr("LOBE_materials_brdf.lobes[1].n: -2; expected above 0"));
    broken["n"] = 1e5;
    broken["cz"] = 1.2;
    EXPECT_THAT(refused(json::array({broken})),
                HasSubstr("lobes[0]: 1.2 to the power 100000; expected at most 1e30"));
    broken.erase("cx");
    EXPECT_THAT(refused(json::array({broken})), HasSubstr("lobes[0].cx: missing"));
    broken = sound;
    broken["exponent"] = 3;
    EXPECT_THAT(refused(json::array({broken})),
                HasSubstr("lobes[0].exponent: 3; expected one of cx, cy, cz, n"));
}

/// A table of the MERL database's layout, all of whose cells hold one value.
std::string merlFile(int32_t thetaH, int32_t thetaD, int32_t phiD, double value) {
    std::string bytes;
    const auto add = [&bytes](const auto& number) {
        bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    };
    for (const int32_t size : {thetaH, thetaD, phiD}) {
        add(size);
    }
    for (int32_t i = 0; i < 3 * thetaH * thetaD * phiD; ++i) {
        add(value);
    }
    return bytes;
}

TEST(Materials, MeasuredTables) {
    const TemporaryFolder folder;
    const Brdf& brdf = requireBrdf("measured");
    const auto scene = [&](const char* file) {
        return folder.write(
            "s.gltf",
            triangle({{"extensions", {{"LOBE_materials_brdf", {{"model", "measured"}, {"file", file}}}}}})
                .text());
    };
    folder.write("grey.binary", merlFile(4, 3, 2, 150.0));
    const Imported imported = importGltf(scene("grey.binary"), {});
    const Material& material = imported.scene.materials.at(0);
    const auto table = brdf.tableOf(material.values);
    ASSERT_EQ(table.size(), 4U * (2 + 4 * 3 * 2));
    EXPECT_EQ(table[0], 4.0);
    EXPECT_NEAR(table[8], 150.0 / 1500.0, 1e-15);
    EXPECT_NEAR(table[9], 1.15 * 150.0 / 1500.0, 1e-15);
    EXPECT_NEAR(table[10], 1.66 * 150.0 / 1500.0, 1e-15);
    // The albedo of f = 0.1 is 0.1 pi.
    EXPECT_NEAR(table[4], 0.1 * std::numbers::pi, 1e-5);
    const auto refusal = [&](const std::string& bytes) -> std::string {
        folder.write("bad.binary", bytes);
        try {
            importGltf(scene("bad.binary"), {});
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(refusal("short"),
                HasSubstr("LOBE_materials_brdf.file: bad.binary: 5 bytes; expected a MERL table"));
    EXPECT_THAT(refusal(merlFile(4, 3, 2, 1.0).substr(0, 100)),
                HasSubstr("100 bytes; expected 588 for 4 x 3 x 2 cells"));
    EXPECT_THAT(refusal(merlFile(4, 3, 2, 1.0) + "x"), HasSubstr("589 bytes; expected 588"));
    EXPECT_THAT(refusal(merlFile(4, 3, 2, std::nan(""))),
                HasSubstr("value 0 of channel 0: NaN; expected a finite"));
    EXPECT_THAT(refusal(std::string(12, '\xff')),
                HasSubstr("size -1 in the first 12 bytes; expected 1..4096"));
    EXPECT_EQ(refusal(merlFile(4, 3, 2, -1.0)), "") << "cells that were not measured";
    EXPECT_THROW(importGltf(scene("../grey.binary"), {}), InputError);
    EXPECT_THROW(importGltf(scene("missing.binary"), {}), InputError);
}

TEST(Materials, EqualTablesShareTheirPlace) {
    const auto lobes = [](double n) {
        return json{
            {"extensions",
             {{"LOBE_materials_brdf",
               {{"model", "lafortune"}, {"lobes", {{{"cx", -1}, {"cy", -1}, {"cz", 1}, {"n", n}}}}}}}}};
    };
    std::vector<Material> materials;
    for (const double n : {20.0, 30.0, 20.0}) {
        materials.push_back(triangle(lobes(n)).import().scene.materials.at(0));
    }
    placeTables(materials);
    EXPECT_THAT(valueOf(materials[0], "lobes"), ElementsAre(0));
    EXPECT_THAT(valueOf(materials[1], "lobes"), ElementsAre(5));
    EXPECT_THAT(valueOf(materials[2], "lobes"), ElementsAre(0));
    EXPECT_EQ(tableRows(materials), 10U);
    const std::vector<float> rows = gatherTables(materials);
    ASSERT_EQ(rows.size(), 40U);
    EXPECT_EQ(rows[16], 20.0f);
    EXPECT_EQ(rows[36], 30.0f);
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

/// Materials are numbered as they are used, and know which of the file's they are.
TEST(Materials, KnowTheirPlaceInTheFile) {
    Gltf gltf = triangle();
    gltf.doc["materials"] = {{{"name", "first"}}, {{"name", "second"}}};
    gltf.doc["meshes"][0]["primitives"][0]["material"] = 1;
    const Scene scene = gltf.import().scene;
    ASSERT_EQ(scene.materials.size(), 1U);
    EXPECT_EQ(scene.materials[0].name, "second");
    EXPECT_EQ(scene.materials[0].fileIndex, 1);
    gltf.doc["meshes"][0]["primitives"][0].erase("material");
    EXPECT_EQ(gltf.import().scene.materials.at(0).fileIndex, -1);
}

}  // namespace
}  // namespace lobe::test
