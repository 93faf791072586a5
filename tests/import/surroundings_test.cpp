#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gltf_builder.hpp"

namespace lobe::test {
namespace {

using testing::HasSubstr;

Gltf with(const char* extension, const json& value) {
    Gltf gltf = triangle();
    gltf.doc["extensionsUsed"] = {extension};
    gltf.doc["scenes"][0]["extensions"][extension] = value;
    return gltf;
}

TEST(Ambient, IsReadFromTheShownScene) {
    EXPECT_FALSE(triangle().import().scene.ambientRadiance.has_value());
    EXPECT_EQ(with("LOBE_ambient", {{"radiance", {0.1, 0.2, 0.3}}}).import().scene.ambientRadiance,
              glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_THAT(with("LOBE_ambient", {{"radiance", {0.1, -0.2, 0.3}}}).refusal(),
                HasSubstr("scenes[0].extensions.LOBE_ambient.radiance[1]: -0.2; expected"));
}

TEST(EnvironmentExtension, ConstantRadiance) {
    const Scene scene =
        with("LOBE_environment", {{"radiance", {1, 2, 3}}, {"background", false}}).import().scene;
    ASSERT_TRUE(scene.environment.has_value());
    EXPECT_EQ(scene.environment->image, -1);
    EXPECT_EQ(scene.environment->radiance, glm::dvec3(1, 2, 3));
    EXPECT_FALSE(scene.environment->background);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST(EnvironmentExtension, ImageBesideTheScene) {
    const TemporaryFolder folder;
    folder.write("sky.hdr", "bytes");
    Gltf gltf =
        with("LOBE_environment", {{"image", "sky.hdr"}, {"intensity", 2}, {"rotation", {0, 1, 0, 0}}});
    const Imported imported = importGltf(folder.write("scene.gltf", gltf.text()), {});
    ASSERT_TRUE(imported.scene.environment.has_value());
    const Environment& environment = *imported.scene.environment;
    ASSERT_EQ(environment.image, 0);
    EXPECT_EQ(imported.images.at(0).bytes.size(), 5U);
    EXPECT_THAT(imported.images[0].name, HasSubstr("sky.hdr"));
    EXPECT_EQ(environment.intensity, 2.0);
    EXPECT_EQ(environment.worldFromMap * glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1));
    EXPECT_TRUE(environment.background);

    folder.write("sky.hdr", "other");
    EXPECT_NE(importGltf(folder.path() / "scene.gltf", {}).scene.contentHash, imported.scene.contentHash);
}

TEST(EnvironmentExtension, DamageIsRefused) {
    EXPECT_THAT(with("LOBE_environment", json::object()).refusal(),
                HasSubstr("neither image, radiance nor sky"));
    EXPECT_THAT(with("LOBE_environment", {{"radiance", {1, 1, 1}}, {"image", "a.hdr"}}).refusal(),
                HasSubstr("more than one of image, radiance and sky"));
    EXPECT_THAT(with("LOBE_environment", {{"image", "../a.hdr"}}).refusal(), HasSubstr("../a.hdr"));
    EXPECT_THAT(with("LOBE_environment", {{"image", "missing.hdr"}}).refusal(), HasSubstr("missing.hdr"));
    EXPECT_THAT(with("LOBE_environment", {{"image", "data:,x"}, {"rotation", {0, 0, 0, 2}}}).refusal(),
                HasSubstr("rotation: [0,0,0,2]; expected a unit quaternion"));
}

TEST(EnvironmentExtension, Sky) {
    const Scene scene = with("LOBE_environment", {{"sky",
                                                   {{"model", "preetham"},
                                                    {"turbidity", 2.5},
                                                    {"sunElevation", 0.5},
                                                    {"sunAzimuth", -1.0},
                                                    {"sunDiameter", 0.0},
                                                    {"ground", {0.1, 0.2, 0.3}}}},
                                                  {"intensity", 0.01},
                                                  {"rotation", {0, 1, 0, 0}}})
                            .import()
                            .scene;
    ASSERT_TRUE(scene.environment && scene.environment->source.sky);
    const Sky& sky = *scene.environment->source.sky;
    EXPECT_EQ(sky.model, SkyModel::preetham);
    EXPECT_EQ(sky.turbidity, 2.5);
    EXPECT_EQ(sky.sunElevation, 0.5);
    EXPECT_EQ(sky.sunAzimuth, -1.0);
    EXPECT_EQ(sky.sunDiameter, 0.0);
    EXPECT_EQ(sky.ground, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(scene.environment->intensity, 0.01);
    EXPECT_EQ(scene.environment->worldFromMap * glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1));
    const auto refusal = [](const json& value) {
        return with("LOBE_environment", {{"sky", value}}).refusal();
    };
    EXPECT_THAT(refusal({{"turbidity", 3}}), HasSubstr("sky.model"));
    EXPECT_THAT(refusal({{"model", "hosek"}}), HasSubstr("preetham"));
    EXPECT_THAT(refusal({{"model", "preetham"}, {"turbidity", 1.5}}), HasSubstr("turbidity: 1.5; expected"));
    EXPECT_THAT(refusal({{"model", "preetham"}, {"sunElevation", -0.1}}),
                HasSubstr("sunElevation: -0.1; expected"));
    EXPECT_THAT(refusal({{"model", "preetham"}, {"sunElevation", 1.6}}),
                HasSubstr("sunElevation: 1.6; expected"));
}

json nineCoefficients() {
    return json(std::vector<std::vector<double>>(9, {0.1, 0.2, 0.3}));
}

Gltf imageBased(const json& light, const json& index = 0) {
    Gltf gltf = with("EXT_lights_image_based", {{"light", index}});
    gltf.doc["extensions"]["EXT_lights_image_based"]["lights"] = {light};
    for (int i = 0; i < 6; ++i)
        gltf.doc["images"].push_back({{"uri", "data:image/png;base64,eA=="}, {"name", std::to_string(i)}});
    return gltf;
}

TEST(ImageBasedExtension, FacesOfTheFirstLevel) {
    const Imported imported = imageBased({{"specularImages", {{5, 4, 3, 2, 1, 0}, {0, 0, 0, 0, 0, 0}}},
                                          {"specularImageSize", 8},
                                          {"irradianceCoefficients", nineCoefficients()},
                                          {"intensity", 3},
                                          {"rotation", {0, 1, 0, 0}}})
                                  .import();
    ASSERT_TRUE(imported.scene.environment && imported.scene.environment->source.imageBased);
    const Environment& environment = *imported.scene.environment;
    EXPECT_EQ(environment.source.imageBased->faces, (std::vector<int>{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(environment.source.imageBased->harmonics.at(8), glm::dvec3(0.1, 0.2, 0.3));
    ASSERT_EQ(imported.images.size(), 6U);
    EXPECT_THAT(imported.images[0].name, HasSubstr("images[5]"));
    EXPECT_EQ(environment.intensity, 3.0);
    EXPECT_EQ(environment.worldFromMap * glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1));
    EXPECT_TRUE(imported.scene.warnings.empty());
}

TEST(ImageBasedExtension, WhatIsMissingOrWrongIsNamed) {
    const Scene bare = imageBased({{"irradianceCoefficients", nineCoefficients()}}).import().scene;
    EXPECT_TRUE(bare.environment->source.imageBased->faces.empty());
    ASSERT_EQ(bare.warnings.size(), 1U);
    EXPECT_THAT(bare.warnings[0], HasSubstr("lights[0]: has no specularImages"));
    EXPECT_THAT(imageBased(json::object()).refusal(), HasSubstr("neither specularImages nor"));
    EXPECT_THAT(imageBased({{"specularImages", {{0, 1, 2, 3, 4, 9}}}}).refusal(),
                HasSubstr("specularImages[0][5]: 9"));
    EXPECT_THAT(imageBased({{"specularImages", {{0, 1, 2}}}}).refusal(), HasSubstr("specularImages[0]"));
    EXPECT_THAT(imageBased({{"irradianceCoefficients", {{1, 2, 3}}}}).refusal(),
                HasSubstr("irradianceCoefficients"));
    EXPECT_THAT(imageBased({{"irradianceCoefficients", nineCoefficients()}}, 3).refusal(),
                HasSubstr("light: 3; expected the index of one of the 1 lights"));
    EXPECT_THAT(
        imageBased({{"irradianceCoefficients", nineCoefficients()}, {"rotation", {0, 0, 0, 2}}}).refusal(),
        HasSubstr("rotation: [0,0,0,2]; expected a unit quaternion"));
}

TEST(ImageBasedExtension, OurOwnEnvironmentWins) {
    Gltf gltf = imageBased({{"irradianceCoefficients", nineCoefficients()}});
    gltf.doc["scenes"][0]["extensions"]["LOBE_environment"] = {{"radiance", {1, 2, 3}}};
    const Scene scene = gltf.import().scene;
    EXPECT_EQ(scene.environment->radiance, glm::dvec3(1, 2, 3));
    ASSERT_FALSE(scene.warnings.empty());
    EXPECT_THAT(scene.warnings.back(), HasSubstr("left out: the scene has a LOBE_environment too"));
}

TEST(FogExtension, IsReadAndMayBeNone) {
    const Scene scene =
        with("LOBE_fog",
             {{"extinction", {1, 2, 3}}, {"radiance", {4, 5, 6}}, {"heightFalloff", 7}, {"height", -8}})
            .import()
            .scene;
    ASSERT_TRUE(scene.fog.has_value());
    EXPECT_EQ(scene.fog->extinction, glm::dvec3(1, 2, 3));
    EXPECT_EQ(scene.fog->radiance, glm::dvec3(4, 5, 6));
    EXPECT_EQ(scene.fog->heightFalloff, 7.0);
    EXPECT_EQ(scene.fog->height, -8.0);
    EXPECT_FALSE(with("LOBE_fog", {{"radiance", {1, 1, 1}}}).import().scene.fog.has_value());
    EXPECT_THAT(with("LOBE_fog", {{"extinction", {-1, 0, 0}}}).refusal(), HasSubstr("extinction[0]: -1"));
    EXPECT_THAT(with("LOBE_fog", {{"heightFalloff", -1}}).refusal(), HasSubstr("heightFalloff: -1"));
}

TEST(FogExtension, ScatteringIsAPartOfExtinctionAndOfEvenFog) {
    const Scene scene =
        with("LOBE_fog", {{"extinction", {1, 2, 3}}, {"scattering", {1, 0.5, 0}}, {"anisotropy", -0.25}})
            .import()
            .scene;
    ASSERT_TRUE(scene.fog.has_value());
    EXPECT_EQ(scene.fog->scattering, glm::dvec3(1, 0.5, 0));
    EXPECT_EQ(scene.fog->anisotropy, -0.25);
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_THAT(with("LOBE_fog", {{"extinction", {1, 1, 1}}, {"scattering", {1, 2, 1}}}).refusal(),
                HasSubstr("extensions.LOBE_fog.scattering[1]: 2; expected at most the extinction"));
    EXPECT_THAT(with("LOBE_fog", {{"extinction", {1, 1, 1}}, {"anisotropy", 1}}).refusal(),
                HasSubstr("anisotropy: 1; expected"));
    const Scene high =
        with("LOBE_fog", {{"extinction", {1, 1, 1}}, {"scattering", {1, 1, 1}}, {"heightFalloff", 1}})
            .import()
            .scene;
    EXPECT_EQ(high.fog->scattering, glm::dvec3(0.0));
    ASSERT_EQ(high.warnings.size(), 1U);
    EXPECT_THAT(high.warnings[0],
                HasSubstr("LOBE_fog: scattering is supported in fog without heightFalloff only"));
}

}  // namespace
}  // namespace lobe::test
