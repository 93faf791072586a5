// The edited scene as glTF, read back.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "base/error.hpp"
#include "gltf_export.hpp"
#include "plan/plan.hpp"
#include "scene/load.hpp"

namespace lobe::view {
namespace {

namespace fs = std::filesystem;

class Export : public testing::Test {
protected:
    Export() { fs::create_directories(folder_); }
    ~Export() override { fs::remove_all(folder_); }

    /// Exports what was edited of a scene that comes with Lobe, and loads the result.
    Scene exported(const fs::path& source, const Edits& edits) {
        Scene facts = loader_.load(source);
        applyEdits(facts, edits);
        const EditedGltf made = editedGltf(source, facts, edits, "x_files");
        for (const auto& [from, to] : made.files) {
            fs::create_directories((folder_ / to).parent_path());
            fs::copy_file(from, folder_ / to, fs::copy_options::overwrite_existing);
        }
        std::ofstream(folder_ / "x.gltf") << made.gltf.dump();
        return loader_.load(folder_ / "x.gltf");
    }

    SceneLoader loader_;
    fs::path folder_ = fs::temp_directory_path() / ("lobe_export_" + std::to_string(getpid()));
    const fs::path scenes_ = fs::path(LOBE_SOURCE_DIR) / "scenes";
};

TEST_F(Export, EveryModelComesBackWithItsParameters) {
    const fs::path source = scenes_ / "textured.gltf";
    const Scene scene = loader_.load(source);
    for (const Brdf& brdf : allBrdfs()) {
        if (brdf.tableParameter() >= 0) continue;
        Material material = withModel(scene, scene.materials[0], brdf);
        for (TextureSlot& slot : material.textures)
            slot = {};
        material.emission = {0.5F, 3.0F, 1.0F};
        Edits edits;
        edits.materials[0] = std::make_shared<const Material>(material);
        const Scene back = exported(source, edits);
        EXPECT_EQ(back.materials[0].brdf, brdf.name);
        ASSERT_EQ(back.materials[0].values.size(), material.values.size()) << brdf.name;
        for (size_t i = 0; i < brdf.parameters.size(); ++i) {
            const Parameter& parameter = brdf.parameters[i];
            // What the interface's type does not read need not come back.
            if (parameter.group == "fresnel" && parameter.name != "fresnel" && parameter.name != "f0")
                continue;
            const auto at = static_cast<size_t>(brdf.valueOffset(static_cast<int>(i)));
            for (size_t c = 0; c < static_cast<size_t>(parameter.components()); ++c)
                EXPECT_FLOAT_EQ(static_cast<float>(back.materials[0].values[at + c]),
                                static_cast<float>(material.values[at + c]))
                    << brdf.name << " " << parameter.name;
        }
        for (int c = 0; c < 3; ++c)
            EXPECT_FLOAT_EQ(back.materials[0].emission[c], material.emission[c]);
        EXPECT_EQ(back.materials.size(), scene.materials.size());
        EXPECT_EQ(back.images.size(), scene.images.size());
    }
}

TEST_F(Export, EveryTypeOfLightComesBack) {
    std::vector<Light> lights;
    for (const LightType type : {LightType::directional, LightType::point, LightType::spot, LightType::rect,
                                 LightType::disk, LightType::sphere, LightType::tube}) {
        Light light;
        light.type = type;
        light.name = std::string("a ") + lobe::nameOf(type);
        light.intensity = {1.0, 2.0, 0.5};
        light.direction = glm::normalize(glm::dvec3(0.3, -1.0, 0.2));
        light.axis = glm::normalize(glm::cross(light.direction, glm::dvec3(0, 0, 1)));
        light.position = {1.0, 2.0, -3.0};
        light.innerConeAngle = 0.2;
        light.outerConeAngle = 0.6;
        light.width = 0.8;
        light.height = 0.4;
        light.radius = 0.3;
        light.length = 1.2;
        if (type == LightType::point) light.range = 7.0;
        light.castsShadow = type != LightType::spot;
        lights.push_back(light);
    }
    Edits edits;
    edits.lights = std::make_shared<const std::vector<Light>>(lights);
    const Scene back = exported(scenes_ / "lights.gltf", edits);
    ASSERT_EQ(back.lights.size(), lights.size());
    for (const Light& light : lights) {
        const auto found = std::find_if(back.lights.begin(), back.lights.end(),
                                        [&](const Light& other) { return other.name == light.name; });
        ASSERT_NE(found, back.lights.end()) << light.name;
        EXPECT_EQ(found->type, light.type);
        EXPECT_EQ(found->castsShadow, light.castsShadow) << light.name;
        EXPECT_EQ(found->range.has_value(), light.range.has_value()) << light.name;
        EXPECT_LT(glm::length(found->intensity - light.intensity), 1e-6) << light.name;
        const bool placed = light.type != LightType::directional;
        if (placed) {
            EXPECT_LT(glm::length(found->position - light.position), 1e-6) << light.name;
        }
        const bool aimed = light.type == LightType::directional || light.type == LightType::spot ||
                           light.type == LightType::rect || light.type == LightType::disk;
        if (aimed) {
            EXPECT_LT(glm::length(found->direction - light.direction), 1e-6) << light.name;
        }
        if (light.type == LightType::rect) {
            EXPECT_LT(glm::length(found->axis - light.axis), 1e-6);
            EXPECT_NEAR(found->width, light.width, 1e-6);
            EXPECT_NEAR(found->height, light.height, 1e-6);
        }
        if (light.type == LightType::tube) {
            EXPECT_LT(glm::length(found->axis - light.axis), 1e-6);
            EXPECT_NEAR(found->length, light.length, 1e-6);
        }
        if (light.type >= LightType::disk) {
            EXPECT_NEAR(found->radius, light.radius, 1e-6) << light.name;
        }
        if (light.type == LightType::spot) {
            EXPECT_NEAR(found->outerConeAngle, light.outerConeAngle, 1e-6);
        }
    }
}

TEST_F(Export, WhatCannotBeWrittenIsRefused) {
    const fs::path source = scenes_ / "textured.gltf";
    const Scene scene = loader_.load(source);
    EXPECT_THROW(editedGltf("x.glb", scene, {}, "x"), InputError);
    Edits edits;
    Material material = scene.materials[0];
    material.brdf = "measured";
    edits.materials[0] = std::make_shared<const Material>(material);
    EXPECT_THROW(editedGltf(source, scene, edits, "x"), UsageError);
}

}  // namespace
}  // namespace lobe::view
