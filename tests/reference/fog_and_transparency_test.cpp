// Pictures of fog, airlight and surfaces that are seen through, against the reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "passes/renderer.hpp"
#include "reference/pixel.hpp"
#include "scene/brdf_tables.hpp"
#include "support/scenes.hpp"

namespace lobe::reference {
namespace {

constexpr int kWidth = 64, kHeight = 48;

gl::Context& context() {
    static const std::unique_ptr<gl::Context> one = gl::Context::create({.backend = gl::Backend::egl});
    return *one;
}

/// Without reversed depth: surfaces' distances are in a channel of their own.
gl::Context& oldContext() {
    static const std::unique_ptr<gl::Context> one =
        gl::Context::create({.backend = gl::Backend::egl, .maskedExtensions = {"GL_ARB_clip_control"}});
    return *one;
}

Quality exactQuality(Transparency transparency = Transparency::sorted) {
    Quality quality;
    quality.samples = 1;
    quality.gbufferBits = 32;
    quality.textureBits = 32;
    quality.shadows = Shadows::none;
    quality.airlightNodes = 32;
    quality.transparency = transparency;
    return quality;
}

Picture drawn(const Scene& scene, const Camera& camera, const Quality& quality, bool contributions = false,
              gl::Context& on = context()) {
    RenderOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.quality = quality;
    if (contributions) options.aovs = {Aov::radiance, Aov::contributions};
    on.makeCurrent();
    Renderer renderer(on);
    renderer.setScene(std::make_shared<Scene>(scene), options);
    return renderer.render(camera);
}

/// What a picture's pixel should be, and where its neighbours show other surfaces.
struct Truth {
    std::vector<PixelTruth> pixels;
    std::vector<bool> edge;
    double mean = 0.0;
    const PixelTruth& at(int x, int y) const { return pixels[static_cast<size_t>(y * kWidth + x)]; }
};

Truth truthOf(const Scene& scene, const Camera& camera) {
    TruthOptions options;
    options.shadows = false;
    const PixelIntegrator integrator(std::make_shared<Scene>(scene), camera, kWidth, kHeight, options);
    Truth truth;
    const View& view = integrator.view();
    const RayDifferentials differentials = pixelDifferentials(view);
    const auto triangles = [&](double x, double y) {
        std::vector<SurfacePoint> points;
        integrator.tracer().surfacesAlong(pixelRay(view, x, y), &differentials, points);
        std::vector<std::pair<uint32_t, uint32_t>> list;
        for (const SurfacePoint& point : points)
            list.emplace_back(point.instance, point.triangle);
        return list;
    };
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            truth.pixels.push_back(integrator.at(x, y, {}, 1));
            const glm::dvec3 total = truth.pixels.back().total();
            truth.mean += (total.x + total.y + total.z) / (3.0 * kWidth * kHeight);
            // Rasterisers round vertices to 1/256 pixel.
            const double px = x + 0.5, py = kHeight - y - 0.5, step = 1.5 / 256.0;
            const auto here = triangles(px, py);
            truth.edge.push_back(
                triangles(px - step, py - step) != here || triangles(px + step, py - step) != here ||
                triangles(px - step, py + step) != here || triangles(px + step, py + step) != here);
        }
    return truth;
}

size_t channelOf(const Image& image, const std::string& name) {
    const auto found = std::find(image.channels.begin(), image.channels.end(), name);
    if (found == image.channels.end()) throw std::logic_error("no channel " + name);
    return static_cast<size_t>(found - image.channels.begin());
}

struct Difference {
    double largest = 0.0;
    int compared = 0;
    std::string where;
};

/// The largest difference of any channel, relative to the value and a tenth of the picture's mean.
Difference compare(const Image& image, const Truth& truth) {
    Difference difference;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float* pixel = image.pixel(x, y);
            for (int c = 0; c < 4; ++c)
                EXPECT_TRUE(std::isfinite(pixel[c]) && pixel[c] >= 0.0f) << x << ", " << y;
            if (truth.edge[static_cast<size_t>(y * kWidth + x)]) continue;
            ++difference.compared;
            const glm::dvec3 total = truth.at(x, y).total();
            for (int c = 0; c < 4; ++c) {
                const double exact = c == 3 ? truth.at(x, y).coverage : total[c];
                const double off =
                    std::abs(static_cast<double>(pixel[c]) - exact) / (exact + 0.1 * truth.mean);
                if (off <= difference.largest) continue;
                difference.largest = off;
                difference.where = "channel " + std::to_string(c) + " of " + std::to_string(x) + ", " +
                                   std::to_string(y) + ": " + std::to_string(pixel[c]) + ", reference " +
                                   std::to_string(exact);
            }
        }
    return difference;
}

/// Moving by 1/256 pixel and 24-bit numbers in lights, rays and depths change smooth pictures by less: 7e-6
/// was seen with diffuse surfaces and fog, 2.3e-5 on glossy ones.
constexpr double kAgrees = 1e-4;

void expectAgreement(const Scene& scene, const Camera& camera, const Quality& quality,
                     double allowed = kAgrees) {
    const Truth truth = truthOf(scene, camera);
    ASSERT_GT(truth.mean, 0.0);
    const Picture picture = drawn(scene, camera, quality);
    const Difference difference = compare(picture.image, truth);
    std::printf("    largest difference %.1e (%s), %d pixels\n", difference.largest, difference.where.c_str(),
                difference.compared);
    EXPECT_LT(difference.largest, allowed) << difference.where;
    EXPECT_GT(difference.compared, kWidth * kHeight * 3 / 4);
    EXPECT_TRUE(picture.warnings.empty());

    // By source: fog as the reference has it, everything else dimmed as there; the sum is the picture.
    const Image split = drawn(scene, camera, quality, true).image;
    EXPECT_LT(compare(split, truth).largest, allowed) << compare(split, truth).where;
    if (!scene.fog) return;
    const size_t fog = channelOf(split, "fog.R");
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            if (truth.edge[static_cast<size_t>(y * kWidth + x)]) continue;
            const glm::dvec3 exact = truth.at(x, y).radiance[static_cast<size_t>(Source::fog)];
            for (size_t c = 0; c < 3; ++c)
                ASSERT_NEAR(static_cast<double>(split.pixel(x, y)[fog + c]), exact[static_cast<int>(c)],
                            allowed * (exact[static_cast<int>(c)] + 0.1 * truth.mean))
                    << x << ", " << y;
        }
}

Camera camera(bool orthographic = false, double height = 1.5) {
    Camera result = lookAt({0.3, height, 6.0}, {0, 0.4, 0}, 0.8);
    result.zNear = 0.01;
    if (orthographic) {
        result.orthographic = true;
        result.xMag = 4.0;
        result.yMag = 3.0;
        result.zFar = 50.0;
    }
    return result;
}

/// A floor with a ball and a wall, lamps of all types.
Scene hall() {
    Scene scene;
    const int floor = test::addMaterial(scene, "lambert");
    const int ball = test::addMaterial(scene, "metallic_roughness");
    scene.materials[static_cast<size_t>(ball)].values = {0.8, 0.4, 0.2, 0.2, 0.6};
    const glm::dmat4 identity(1.0);
    test::addInstance(scene, test::addQuad(scene, floor, 30.0f),
                      glm::rotate(identity, -std::numbers::pi / 2, glm::dvec3(1, 0, 0)));
    test::addInstance(scene, test::addSphere(scene, ball),
                      glm::translate(identity, glm::dvec3(-1.0, 1.0, 0.0)));
    test::addInstance(scene, test::addQuad(scene, floor, 1.5f),
                      glm::translate(identity, glm::dvec3(3, 1, -6)));
    scene.lights.push_back(test::directional({0.3, -1, -0.5}, {1.0, 0.9, 0.8}));
    scene.lights.push_back(test::point({1.4, 1.2, 0.5}, {3.0, 2.0, 1.0}));
    scene.lights.push_back(test::point({-1.0, 3.0, -3.0}, {1.0, 2.0, 3.0}, 6.0));
    scene.lights.push_back(test::spot({0.5, 3.5, -1.0}, {1.0, 0.0, -1.0}, {9.0, 9.0, 8.0}, 0.2, 0.45));
    return scene;
}

Fog evenFog(double extinction) {
    Fog fog;
    fog.extinction = glm::dvec3(1.0, 0.7, 0.4) * extinction;
    fog.radiance = {0.3, 0.35, 0.4};
    return fog;
}

TEST(FogPicture, EvenFogIsTheReferences) {
    for (const double extinction : {1e-6, 0.05, 2.0, 1e6})
        for (const bool orthographic : {false, true}) {
            Scene scene = hall();
            scene.fog = evenFog(extinction);
            SCOPED_TRACE(extinction);
            expectAgreement(scene, camera(orthographic), exactQuality());
        }
}

TEST(FogPicture, FogByHeightIsTheReferences) {
    // From above, from in its floor, far below and far above it; steep and slow.
    for (const double falloff : {0.02, 0.8, 30.0})
        for (const double height : {-40.0, 0.0, 1.5, 40.0})
            for (const bool orthographic : {false, true}) {
                Scene scene = hall();
                scene.fog = evenFog(0.1);
                scene.fog->heightFalloff = falloff;
                scene.fog->height = height;
                SCOPED_TRACE(std::to_string(falloff) + " from " + std::to_string(height));
                expectAgreement(scene, camera(orthographic), exactQuality());
            }
}

TEST(FogPicture, ForwardShadingHasTheSameFog) {
    Scene scene = hall();
    scene.fog = evenFog(0.1);
    scene.fog->heightFalloff = 0.5;
    Quality quality = exactQuality();
    quality.shading = Shading::forward;
    const Truth truth = truthOf(scene, camera());
    const Difference difference = compare(drawn(scene, camera(), quality).image, truth);
    EXPECT_LT(difference.largest, kAgrees) << difference.where;
    const Difference split = compare(drawn(scene, camera(), quality, true).image, truth);
    EXPECT_LT(split.largest, kAgrees) << split.where;
}

TEST(FogPicture, FogAloneIsBackground) {
    Scene scene;
    scene.fog = evenFog(0.1);
    const Image image = drawn(scene, camera(), exactQuality()).image;
    for (int c = 0; c < 3; ++c)
        EXPECT_FLOAT_EQ(image.pixel(10, 10)[c], static_cast<float>(scene.fog->radiance[c]));
    EXPECT_EQ(image.pixel(10, 10)[3], 0.0f) << "fog covers nothing";
}

TEST(FogPicture, AirlightIsTheReferences) {
    for (const double g : {-0.5, 0.0, 0.7})
        for (const bool orthographic : {false, true}) {
            Scene scene = hall();
            scene.fog = evenFog(0.15);
            scene.fog->radiance = glm::dvec3(0.01);
            scene.fog->scattering = {0.15, 0.08, 0.0};
            scene.fog->anisotropy = g;
            SCOPED_TRACE(g);
            // 32 nodes: what is left is the kink where the cone's full light begins.
            expectAgreement(scene, camera(orthographic), exactQuality(), 5e-3);
        }
}

/// Panes that cut each other, in front of and through the ball.
Scene panes(Scene scene, bool lit) {
    const glm::dvec3 colors[] = {{0.9, 0.2, 0.1}, {0.1, 0.8, 0.2}, {0.2, 0.3, 0.9}};
    for (int i = 0; i < 3; ++i) {
        const int material = test::addMaterial(scene, lit ? "metallic_roughness" : "unlit");
        Material& pane = scene.materials[static_cast<size_t>(material)];
        pane.metallicRoughness.baseColor = colors[i];
        if (lit) pane.values = {colors[i].x, colors[i].y, colors[i].z, 0.0, 0.5};
        pane.alphaMode = AlphaMode::blend;
        pane.alpha = 0.3f + 0.2f * static_cast<float>(i);
        pane.doubleSided = true;
        glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(0.2, 1.0, 0.6));
        place = glm::rotate(place, 1.1 * i + 0.3, glm::dvec3(0.2, 1.0, 0.1));
        test::addInstance(scene, test::addQuad(scene, material, 1.6f), place);
    }
    return scene;
}

TEST(Transparency, PeeledPanesAreTheReferences) {
    for (const bool lit : {false, true}) {
        SCOPED_TRACE(lit);
        expectAgreement(panes(hall(), lit), camera(), exactQuality(Transparency::peeled));
        expectAgreement(panes(hall(), lit), camera(true), exactQuality(Transparency::peeled));
    }
    // By object they are not, or this would be no test.
    const Truth truth = truthOf(panes(hall(), false), camera());
    EXPECT_GT(compare(drawn(panes(hall(), false), camera(), exactQuality()).image, truth).largest, 0.1);
}

TEST(Transparency, PeeledInFogWithAirlight) {
    Scene scene = panes(hall(), true);
    scene.fog = evenFog(0.15);
    scene.fog->scattering = glm::dvec3(0.05);
    expectAgreement(scene, camera(), exactQuality(Transparency::peeled), 5e-3);
}

TEST(Transparency, PeeledWithForwardShadingAndWithoutOpaqueSurfaces) {
    Quality quality = exactQuality(Transparency::peeled);
    quality.shading = Shading::forward;
    const Scene scene = panes(hall(), true);
    const Difference forward = compare(drawn(scene, camera(), quality).image, truthOf(scene, camera()));
    EXPECT_LT(forward.largest, kAgrees) << forward.where;
    const Scene alone = panes(Scene{}, false);
    const Difference difference =
        compare(drawn(alone, camera(), exactQuality(Transparency::peeled)).image, truthOf(alone, camera()));
    EXPECT_LT(difference.largest, kAgrees) << difference.where;
}

TEST(Transparency, WithoutClipControl) {
    Scene scene = panes(hall(), true);
    scene.fog = evenFog(0.15);
    scene.fog->heightFalloff = 0.4;
    const Difference difference =
        compare(drawn(scene, camera(), exactQuality(Transparency::peeled), false, oldContext()).image,
                truthOf(scene, camera()));
    EXPECT_LT(difference.largest, kAgrees) << difference.where;
}

/// Jittered frames: their mean is the reference's over the pixel, and contributions' sum the picture.
TEST(Transparency, SamplesAverage) {
    Scene scene = panes(hall(), false);
    scene.fog = evenFog(0.15);
    Quality quality = exactQuality(Transparency::peeled);
    quality.samples = 16;
    const Image whole = drawn(scene, camera(), quality).image;
    const Image split = drawn(scene, camera(), quality, true).image;
    TruthOptions options;
    options.shadows = false;
    options.filter = PixelFilter::box;
    const PixelIntegrator integrator(std::make_shared<Scene>(scene), camera(), kWidth, kHeight, options);
    double off = 0.0, sum = 0.0;
    for (int y = 1; y < kHeight; y += 4)
        for (int x = 1; x < kWidth; x += 4) {
            const double exact = integrator.at(x, y, {}, 1).total().y;
            off += std::abs(static_cast<double>(whole.pixel(x, y)[1]) - exact);
            sum += exact;
            for (int c = 0; c < 4; ++c)
                EXPECT_NEAR(whole.pixel(x, y)[c], split.pixel(x, y)[c], 1e-5f) << x << ", " << y;
        }
    // Edges are met by one sixteenth of a pixel in three of the sixteen samples' rows.
    EXPECT_LT(off / sum, 0.02);
}

/// Layers that are peeled beside the tables that models read.
TEST(Transparency, PeeledSurfacesReadTheirTables) {
    Scene scene = hall();
    const int material = test::addMaterial(scene, "lafortune");
    Material& glass = scene.materials[static_cast<size_t>(material)];
    glass.alphaMode = AlphaMode::blend;
    glass.alpha = 0.4f;
    glass.doubleSided = true;
    placeTables(scene.materials);
    test::addInstance(scene, test::addSphere(scene, material, 24),
                      glm::translate(glm::dmat4(1.0), glm::dvec3(0.8, 1.0, 1.5)));
    const Difference difference =
        compare(drawn(scene, camera(), exactQuality(Transparency::peeled)).image, truthOf(scene, camera()));
    EXPECT_LT(difference.largest, 5e-3) << difference.where;
}

TEST(Transparency, ABallSeenThroughItsOwnFront) {
    Scene scene = hall();
    const int material = test::addMaterial(scene, "lambert");
    Material& glass = scene.materials[static_cast<size_t>(material)];
    glass.alphaMode = AlphaMode::blend;
    glass.alpha = 0.4f;
    glass.doubleSided = true;
    const int ball = test::addSphere(scene, material, 24);
    test::addInstance(scene, ball, glm::translate(glm::dmat4(1.0), glm::dvec3(0.8, 1.0, 1.5)));
    test::addInstance(scene, ball, glm::translate(glm::dmat4(1.0), glm::dvec3(1.5, 1.1, 1.2)));
    const Truth truth = truthOf(scene, camera());
    const Difference difference =
        compare(drawn(scene, camera(), exactQuality(Transparency::peeled)).image, truth);
    EXPECT_LT(difference.largest, 5e-3) << difference.where;
}

/// `count` panes one behind the other, in the order of the file from the front or the back, all at one place
/// if asked.
Scene stack(int count, bool fromFront, double apart) {
    Scene scene;
    for (int i = 0; i < count; ++i) {
        const int material = test::addMaterial(scene, "unlit");
        Material& pane = scene.materials[static_cast<size_t>(material)];
        pane.metallicRoughness.baseColor = {i % 3 == 0 ? 0.9 : 0.1, i % 3 == 1 ? 0.9 : 0.1,
                                            i % 3 == 2 ? 0.9 : 0.1};
        pane.alphaMode = AlphaMode::blend;
        pane.alpha = 0.2f;
        const double z = apart * (fromFront ? -i : i);
        test::addInstance(scene, test::addQuad(scene, material, 20.0f),
                          glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, z)));
    }
    return scene;
}

TEST(Transparency, TwentyLayersAndLayersAtOnePlace) {
    for (const bool fromFront : {false, true})
        for (const double apart : {0.05, 0.0}) {
            SCOPED_TRACE(apart);
            const Scene scene = stack(20, fromFront, apart);
            const Truth truth = truthOf(scene, camera());
            const Difference difference =
                compare(drawn(scene, camera(), exactQuality(Transparency::peeled)).image, truth);
            EXPECT_LT(difference.largest, 1e-5) << difference.where;
            EXPECT_GT(difference.compared, 1000);
        }
}

TEST(Transparency, WhatIsBeyondTheBoundIsDrawnSortedAndSaid) {
    // More layers than the bound of 256, each in the order that sorting gives: the picture stays right.
    const Scene scene = stack(260, true, 0.01);
    const Picture picture = drawn(scene, camera(), exactQuality(Transparency::peeled));
    ASSERT_EQ(picture.warnings.size(), 1u);
    EXPECT_NE(picture.warnings[0].find("256 layers"), std::string::npos) << picture.warnings[0];
    const Difference difference = compare(picture.image, truthOf(scene, camera()));
    EXPECT_LT(difference.largest, 1e-5) << difference.where;
}

/// Panes of coloured glass: KHR_materials_transmission.
Scene glass(Scene scene, float alpha) {
    const glm::dvec3 colors[] = {{0.9, 0.3, 0.2}, {0.3, 0.9, 0.4}};
    for (int i = 0; i < 2; ++i) {
        const int material = test::addMaterial(scene, "thin_transmission");
        Material& pane = scene.materials[static_cast<size_t>(material)];
        pane.values = {colors[i].x, colors[i].y, colors[i].z, 0.1, 0.4, 0.8};
        pane.doubleSided = true;
        pane.alpha = alpha;
        if (alpha < 1.0f) pane.alphaMode = AlphaMode::blend;
        glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(0.2, 1.0, 0.8));
        place = glm::rotate(place, 1.2 * i + 0.3, glm::dvec3(0.2, 1.0, 0.1));
        test::addInstance(scene, test::addQuad(scene, material, 1.4f), place);
    }
    return scene;
}

TEST(Transparency, ColouredGlassIsTheReferences) {
    for (const float alpha : {1.0f, 0.6f}) {
        SCOPED_TRACE(alpha);
        Scene scene = glass(hall(), alpha);
        expectAgreement(scene, camera(), exactQuality(Transparency::peeled));
        scene.fog = evenFog(0.1);
        expectAgreement(scene, camera(), exactQuality(Transparency::peeled));
    }
    // One pane needs no peeling.
    Scene scene = glass(hall(), 1.0f);
    scene.instances.pop_back();
    expectAgreement(scene, camera(), exactQuality());
    Quality forward = exactQuality(Transparency::peeled);
    forward.shading = Shading::forward;
    const Scene both = glass(hall(), 1.0f);
    const Difference difference = compare(drawn(both, camera(), forward).image, truthOf(both, camera()));
    EXPECT_LT(difference.largest, kAgrees) << difference.where;
}

}  // namespace
}  // namespace lobe::reference
