// KHR_materials_transmission: a thin pane's model, and the shadow that it does not throw.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gltf_builder.hpp"

namespace lobe::test {
namespace {

using testing::HasSubstr;

Gltf pane(const json& extension, double roughness = 0.0) {
    return triangle({{"pbrMetallicRoughness",
                      {{"baseColorFactor", {0.2, 0.4, 0.6, 1}},
                       {"metallicFactor", 0.25},
                       {"roughnessFactor", roughness}}},
                     {"extensions", {{"KHR_materials_transmission", extension}}}});
}

TEST(Transmission, IsAModelOfItsOwn) {
    const Imported imported = pane({{"transmissionFactor", 0.5}}).import();
    const Material& material = imported.scene.materials.at(0);
    EXPECT_EQ(material.brdf, "thin_transmission");
    EXPECT_EQ(material.values, (ParameterValues{0.2, 0.4, 0.6, 0.25, 0.0, 0.5}));
    EXPECT_EQ(material.alphaMode, AlphaMode::opaque);
    EXPECT_TRUE(seesThrough(material));
    EXPECT_FALSE(imported.scene.instances.at(0).castsShadow);
    EXPECT_TRUE(imported.scene.warnings.empty());
    // (1 - F) of a dielectric seen from straight above is 0.96.
    const glm::dvec3 through = requireBrdf(material.brdf).transmittance(1.0, material.values);
    EXPECT_NEAR(through.y, 0.4 * 0.75 * 0.5 * 0.96, 1e-15);
    EXPECT_EQ(requireBrdf(material.brdf).transmittance(0.0, material.values), glm::dvec3(0.0));
}

TEST(Transmission, RoughPanesAreSaidNotToBlur) {
    const Imported imported = pane({{"transmissionFactor", 1.0}}, 0.5).import();
    ASSERT_EQ(imported.scene.warnings.size(), 1U);
    EXPECT_THAT(imported.scene.warnings[0],
                HasSubstr("KHR_materials_transmission: what shows through the surface is "
                          "not blurred by its roughness"));
}

TEST(Transmission, OfNoneIsTheOrdinaryModel) {
    for (const json& extension : {json::object(), json{{"transmissionFactor", 0}}}) {
        const Imported imported = pane(extension).import();
        EXPECT_EQ(imported.scene.materials.at(0).brdf, "metallic_roughness");
        EXPECT_TRUE(imported.scene.instances.at(0).castsShadow);
    }
}

TEST(Transmission, ATextureIsItsRedChannel) {
    Gltf gltf = pane({{"transmissionFactor", 1.0}, {"transmissionTexture", {{"index", 0}}}});
    gltf.push("images", {{"uri", "data:image/png;base64,iVBORw0KGgo="}});
    gltf.push("textures", {{"source", 0}});
    const Imported imported = gltf.import();
    const Material& material = imported.scene.materials.at(0);
    const auto index = static_cast<size_t>(requireBrdf(material.brdf).parameterIndex("transmission"));
    EXPECT_GE(material.textures[index].texture, 0);
    EXPECT_EQ(material.textureChannels[index], 0);
}

TEST(Transmission, DamageIsRefused) {
    EXPECT_THAT(
        pane({{"transmissionFactor", 1.5}}).refusal(),
        HasSubstr("materials[0].extensions.KHR_materials_transmission.transmissionFactor: 1.5; expected"));
}

}  // namespace
}  // namespace lobe::test
