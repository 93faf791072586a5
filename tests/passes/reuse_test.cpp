// One renderer for many pictures: other sizes, edited scenes, pictures that are given up.
#include <gmock/gmock.h>

#include <glm/gtc/matrix_transform.hpp>

#include "passes/rendering.hpp"
#include "plan/knobs.hpp"

namespace lobe {
namespace {

using namespace test;

/// Deferred and blended surfaces, a texture, a light that casts shadows.
std::shared_ptr<Scene> busyScene() {
    auto scene = std::make_shared<Scene>();
    Bitmap checks{2, 2, 3, ComponentType::u8, {}};
    for (const int code : {255, 40, 40, 40, 255, 40, 40, 40, 255, 200, 200, 40})
        checks.data.push_back(static_cast<std::byte>(code));
    scene->images = {checks};
    scene->textures = {{0, {}}};
    const int textured = addMaterial(*scene, "lambert");
    scene->materials[0].textures[0] = {0};
    addInstance(*scene, addSphere(*scene, textured, 24));
    const int glass = addMaterial(*scene, "lambert");
    scene->materials[1].alphaMode = AlphaMode::blend;
    scene->materials[1].alpha = 0.4F;
    addInstance(*scene, addQuad(*scene, glass, 0.7F),
                glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 0.2, 1.3)));
    for (Primitive& primitive : scene->primitives)
        if (primitive.uvs[0].empty()) {
            primitive.uvs[0].reserve(primitive.positions.size());
            for (const glm::vec3& p : primitive.positions)
                primitive.uvs[0].emplace_back(p.x, p.y);
        }
    scene->lights.push_back(point({1, 2, 3}, glm::dvec3(20.0)));
    scene->ambientRadiance = glm::dvec3(0.1);
    return scene;
}

RenderOptions optionsOf(int width, int height, int samples) {
    RenderOptions options = smallPicture({.samples = samples}, {Aov::radiance, Aov::depth}, Shadows::soft);
    options.width = width;
    options.height = height;
    return options;
}

TEST(Reuse, AnotherSizeGivesThePictureOfThatSize) {
    const auto scene = busyScene();
    for (const int samples : {1, 4}) {
        Renderer renderer(eglContext());
        renderer.setScene(scene, optionsOf(96, 64, samples));
        const Image large = renderer.render(frontCamera()).image;
        renderer.resize(37, 29);
        const Image small = renderer.render(frontCamera()).image;
        renderer.resize(96, 64);
        const Image again = renderer.render(frontCamera()).image;
        Renderer fresh(eglContext());
        fresh.setScene(scene, optionsOf(37, 29, samples));
        EXPECT_EQ(small.values, fresh.render(frontCamera()).image.values) << samples;
        EXPECT_EQ(large.values, again.values) << samples;
        EXPECT_NE(large.values.size(), small.values.size());
    }
}

TEST(Reuse, EditedScenesKeepTheirTexturesAndAreDrawnAsFreshOnes) {
    const auto scene = busyScene();
    Renderer renderer(eglContext());
    renderer.setScene(scene, optionsOf(96, 64, 4));
    const Image before = renderer.render(frontCamera()).image;
    setParameter(scene->materials[0], "diffuse", {0.2, 0.9, 0.5});
    scene->lights[0].position = {-2, 1, 2};
    renderer.setScene(scene, optionsOf(96, 64, 4));
    const Image edited = renderer.render(frontCamera()).image;
    EXPECT_NE(before.values, edited.values);
    EXPECT_EQ(edited.values, render(*scene, frontCamera(), optionsOf(96, 64, 4)).values);
    // Other texels of the same size are not the same image.
    auto repainted = std::make_shared<Scene>(*scene);
    repainted->images[0].data[0] = std::byte{0};
    renderer.setScene(repainted, optionsOf(96, 64, 4));
    EXPECT_EQ(renderer.render(frontCamera()).image.values,
              render(*repainted, frontCamera(), optionsOf(96, 64, 4)).values);
}

TEST(Reuse, TurnedEnvironmentsKeepTheirMapsAndAreDrawnAsFreshOnes) {
    for (const char* lighting : {"prefiltered", "sampled"})
        for (const char* diffuse : {"map", "sh2"}) {
            const auto scene = busyScene();
            Bitmap sky{8, 4, 3, ComponentType::f32, {}};
            for (int i = 0; i < 8 * 4 * 3; ++i) {
                const float value = static_cast<float>((i * 37) % 11) * 0.1F;
                const auto* bytes = reinterpret_cast<const std::byte*>(&value);
                sky.data.insert(sky.data.end(), bytes, bytes + sizeof value);
            }
            scene->images.push_back(sky);
            scene->environment = Environment{};
            scene->environment->image = 1;
            RenderOptions options = optionsOf(64, 48, 1);
            setKnob(options.quality, "env_lighting", lighting);
            setKnob(options.quality, "env_diffuse", diffuse);
            Renderer renderer(eglContext());
            renderer.setScene(scene, options);
            const Image before = renderer.render(frontCamera()).image;
            scene->environment->worldFromMap =
                glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.7, glm::dvec3(0.0, 1.0, 0.0)));
            scene->environment->intensity = 1.7;
            renderer.setScene(scene, options);
            const Image turned = renderer.render(frontCamera()).image;
            EXPECT_NE(before.values, turned.values);
            EXPECT_EQ(turned.values, render(*scene, frontCamera(), options).values)
                << lighting << " " << diffuse;
        }
}

TEST(Reuse, BorrowedMapsAreCloseAndGiveWayToTheirOwn) {
    const auto scene = busyScene();
    scene->materials[0].brdf = "metallic_roughness";
    scene->materials[0].values = requireBrdf("metallic_roughness").defaults();
    scene->materials[0].textures.assign(requireBrdf("metallic_roughness").parameters.size(), {});
    scene->materials[0].textureChannels.assign(requireBrdf("metallic_roughness").parameters.size(), 0);
    setParameter(scene->materials[0], "roughness", glm::dvec3(0.5));
    scene->environment = Environment{};
    const RenderOptions options = optionsOf(64, 48, 1);
    Renderer renderer(eglContext());
    renderer.setScene(scene, options);
    renderer.render(frontCamera());
    EXPECT_FALSE(renderer.borrowed());
    setParameter(scene->materials[0], "roughness", glm::dvec3(0.55));
    renderer.setScene(scene, options, true);
    const Image near = renderer.render(frontCamera()).image;
    EXPECT_TRUE(renderer.borrowed());
    renderer.setScene(scene, options);
    EXPECT_FALSE(renderer.borrowed());
    const Image own = renderer.render(frontCamera()).image;
    EXPECT_EQ(own.values, render(*scene, frontCamera(), options).values);
    double worst = 0.0;
    for (size_t i = 0; i < own.values.size(); ++i)
        worst = std::max(worst, double{std::abs(own.values[i] - near.values[i])});
    EXPECT_LT(worst, 0.2);
}

TEST(Reuse, FewerSamplesAreThePictureOfThatPlan) {
    const auto scene = busyScene();
    Renderer renderer(eglContext());
    renderer.setScene(scene, optionsOf(96, 64, 4));
    const Image whole = renderer.render(frontCamera()).image;
    const Image preview = renderer.render(frontCamera(), {.samples = 1}).image;
    EXPECT_EQ(preview.values, render(*scene, frontCamera(), optionsOf(96, 64, 1)).values);
    EXPECT_EQ(whole.values, renderer.render(frontCamera()).image.values);
}

TEST(Reuse, AStoppedPictureIsEmptyAndTheNextOneWhole) {
    const auto scene = busyScene();
    Renderer renderer(eglContext());
    renderer.setScene(scene, optionsOf(96, 64, 4));
    const Image whole = renderer.render(frontCamera()).image;
    const std::atomic<bool> stop = true;
    EXPECT_THAT(renderer.render(frontCamera(), {.stop = &stop}).image.values, testing::IsEmpty());
    EXPECT_EQ(whole.values, renderer.render(frontCamera()).image.values);
}

TEST(Reuse, ProgramsAreAnnouncedBeforeTheyAreCompiledAndOnlyThen) {
    std::vector<std::string> names;
    Renderer renderer(eglContext());
    renderer.onCompile([&](const std::string& name) { names.push_back(name); });
    const auto scene = busyScene();
    renderer.setScene(scene, optionsOf(96, 64, 1));
    EXPECT_THAT(names, testing::Contains(testing::HasSubstr("pass/gbuffer.frag")));
    names.clear();
    setParameter(scene->materials[0], "diffuse", glm::dvec3(0.1));
    renderer.setScene(scene, optionsOf(64, 64, 1));
    renderer.render(frontCamera());
    EXPECT_THAT(names, testing::IsEmpty());
}

}  // namespace
}  // namespace lobe
