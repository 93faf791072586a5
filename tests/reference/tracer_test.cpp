// Rays against shapes whose intersections are known.
#include "reference/tracer.hpp"

#include <gtest/gtest.h>
#include <xmmintrin.h>

#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"
#include "support/scenes.hpp"

namespace lobe::reference {
namespace {

using namespace lobe::test;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

glm::dvec3 randomDirection(Pcg32& random) {
    const double u = random.uniform();
    return uniformSphere({u, random.uniform()});
}

Tracer tracerOf(const Scene& scene, const glm::dvec3& eye = glm::dvec3(0.0)) {
    return {std::make_shared<const Scene>(scene), eye};
}

std::vector<SurfacePoint> layersOf(const Tracer& tracer, const Ray& ray) {
    std::vector<SurfacePoint> layers;
    tracer.surfacesAlong(ray, nullptr, layers);
    return layers;
}

TEST(Tracer, PlanesAreMetWhereTheyAre) {
    Scene scene;
    const int quad = addQuad(scene, addMaterial(scene, "lambert"), 1000.0f);
    scene.materials[0].doubleSided = true;
    const glm::dvec3 place(12.5, -3.25, 40.0);
    const glm::dmat4 pose =
        glm::rotate(glm::translate(glm::dmat4(1.0), place), 0.7, glm::dvec3(0.3, 0.8, -0.2));
    addInstance(scene, quad, pose);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(pose[2]));
    const glm::dvec3 eye(1.0, 2.0, 3.0);
    const Tracer tracer = tracerOf(scene, eye);
    Pcg32 random(1, 1);
    int met = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 direction = randomDirection(random);
        const double slope = glm::dot(direction, normal);
        const double t = glm::dot(place - eye, normal) / slope;
        const auto layers = layersOf(tracer, {eye, direction});
        if (std::abs(slope) < 0.1) continue;  // the quad ends, and t is ill-conditioned
        ASSERT_EQ(layers.size(), t > 0.0 ? 1u : 0u);
        if (layers.empty()) continue;
        ++met;
        EXPECT_NEAR(layers[0].t, t, 1e-12 * t / std::abs(slope));
        EXPECT_LT(glm::length(layers[0].position - (eye + t * direction)), 1e-12 * t / std::abs(slope));
        EXPECT_NEAR(glm::dot(layers[0].geometricNormal, direction), -std::abs(slope), 1e-13);
        EXPECT_LT(glm::length(layers[0].normal - layers[0].geometricNormal), 1e-13);
    }
    EXPECT_GT(met, 5000);
}

TEST(Tracer, SpheresAreMetWithinTheirTessellation) {
    Scene scene;
    constexpr int kRings = 64;
    addInstance(scene, addSphere(scene, addMaterial(scene, "lambert"), kRings));
    const glm::dvec3 eye(0.0, 0.0, 4.0);
    const Tracer tracer = tracerOf(scene, eye);
    Pcg32 random(2, 1);
    // A chord's middle is 1 - cos(half its angle) inside the sphere, on two axes; the file's floats round
    // too.
    const double sagitta = 2.0 * (1.0 - std::cos(std::numbers::pi / (2 * kRings))) + 1e-6;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 target = 0.9 * randomDirection(random);
        const auto layers = layersOf(tracer, {eye, target - eye});
        ASSERT_EQ(layers.size(), 1u) << "a hole at " << target.x << ' ' << target.y << ' ' << target.z;
        const double radius = glm::length(layers[0].position);
        EXPECT_LE(radius, 1.0 + 1e-6);
        EXPECT_GE(radius, 1.0 - sagitta);
        EXPECT_GT(glm::dot(layers[0].normal, glm::normalize(layers[0].position)), 1.0 - 1e-3);
    }
}

/// Six walls, each an instance of one quad, that see each other from inside.
Scene room(const glm::dvec3& place, double half) {
    Scene scene;
    const int quad = addQuad(scene, addMaterial(scene, "lambert"), 1.0f);
    const glm::dmat4 pose = glm::scale(glm::translate(glm::dmat4(1.0), place), glm::dvec3(half));
    for (int side = 0; side < 4; ++side) {
        const glm::dmat4 turn =
            glm::rotate(glm::dmat4(1.0), side * std::numbers::pi / 2, glm::dvec3(0, 1, 0));
        addInstance(scene, quad, pose * turn * glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -1)));
    }
    for (const double up : {-1.0, 1.0}) {
        const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), up * std::numbers::pi / 2, glm::dvec3(1, 0, 0));
        addInstance(scene, quad, pose * turn * glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -1)));
    }
    return scene;
}

TEST(Tracer, NothingLeaksOutOfARoom) {
    for (const glm::dvec3& place : {glm::dvec3(0.0), glm::dvec3(1e6, -2e6, 3e6)})
        for (const double half : {1e-3, 1.0, 1e4}) {
            const Tracer tracer = tracerOf(room(place, half), place);
            Pcg32 random(3, 1);
            int seen = 0;
            for (int i = 0; i < 20000; ++i) {
                const glm::dvec3 direction = randomDirection(random);
                const auto layers = layersOf(tracer, {place, direction});
                ASSERT_EQ(layers.size(), 1u);
                const glm::dvec3 on = randomDirection(random);
                const double inward = glm::dot(on, layers[0].geometricNormal);
                ASSERT_EQ(tracer.visibility(layers[0], on, kInfinity), 0.0) << inward;
                // Nearer than the nearest wall in that direction there is nothing. Points of this size are
                // known to `shift`; away from corners a wall's distance changes by at most 400 times that.
                const glm::dvec3 inRoom = glm::abs(layers[0].position - place) / half;
                const int corner = (inRoom.x > 0.99) + (inRoom.y > 0.99) + (inRoom.z > 0.99);
                if (inward <= 0.0 || corner > 1) continue;
                const double shift = 64.0 * 0x1p-53 * (2.0 * 3e6 + half);
                const auto across =
                    layersOf(tracer, {layers[0].position + shift * layers[0].geometricNormal, on});
                ASSERT_EQ(across.size(), 1u);
                const double free = across[0].distance - 400.0 * shift;
                if (free <= 0.0) continue;
                ASSERT_EQ(tracer.visibility(layers[0], on, free), 1.0);
                ++seen;
            }
            EXPECT_GT(seen, 5000);
        }
}

TEST(Tracer, RaysThroughSharedEdgesAndVerticesMeetOneTriangle) {
    Scene scene;
    const int material = addMaterial(scene, "lambert");
    scene.materials[0].alphaMode = AlphaMode::blend;
    scene.materials[0].alpha = 0.25f;
    // A fan of four triangles about a vertex, met along the axis of symmetry.
    Primitive fan;
    fan.material = material;
    fan.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    fan.normals.assign(5, glm::vec3(0, 0, 1));
    fan.indices = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1};
    scene.primitives.push_back(fan);
    addInstance(scene, 0);
    const Tracer tracer = tracerOf(scene, {0, 0, 2});
    for (const glm::dvec2& at : {glm::dvec2(0.0), glm::dvec2(0.5, 0.0), glm::dvec2(-0.25, 0.0),
                                 glm::dvec2(0.0, 0.5), glm::dvec2(0.0, -0.125)}) {
        const auto layers = layersOf(tracer, {{at, 2.0}, {0, 0, -1}});
        EXPECT_EQ(layers.size(), 1u) << at.x << ' ' << at.y;
    }
}

TEST(Tracer, BlendedLayersComeFrontToBackDownToTheFirstOpaque) {
    Scene scene;
    const int opaque = addMaterial(scene, "lambert");
    const int pane = addMaterial(scene, "lambert");
    scene.materials[static_cast<size_t>(pane)].alphaMode = AlphaMode::blend;
    scene.materials[static_cast<size_t>(pane)].alpha = 0.25f;
    const int wall = addQuad(scene, opaque, 2.0f);
    const int glass = addQuad(scene, pane, 2.0f);
    const auto at = [](double z) { return glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, z)); };
    for (const auto& [quad, z] :
         {std::pair(glass, 1.0), {wall, 0.0}, {glass, 2.0}, {wall, -1.0}, {glass, -2.0}})
        addInstance(scene, quad, at(z));
    const Tracer tracer = tracerOf(scene, {0, 0, 5});
    const auto layers = layersOf(tracer, {{0.3, 0.1, 5}, {0, 0, -2}});
    ASSERT_EQ(layers.size(), 3u);
    EXPECT_EQ(layers[0].instance, 2u);
    EXPECT_EQ(layers[1].instance, 0u);
    EXPECT_EQ(layers[2].instance, 1u);
    EXPECT_EQ(layers[0].alpha, 0.25);
    EXPECT_EQ(layers[2].alpha, 1.0);
    EXPECT_DOUBLE_EQ(layers[0].t, 1.5);
    EXPECT_DOUBLE_EQ(layers[0].distance, 3.0);

    // From the wall to the eye: two panes; up to between them: one.
    EXPECT_DOUBLE_EQ(tracer.visibility(layers[2], {0, 0, 1}, kInfinity), 0.75 * 0.75);
    EXPECT_DOUBLE_EQ(tracer.visibility(layers[2], {0, 0, 1}, 1.5), 0.75);
    EXPECT_DOUBLE_EQ(tracer.visibility(layers[2], {0, 0, 2}, 0.25), 1.0);
    EXPECT_EQ(tracer.visibility(layers[2], {0, 0, -1}, kInfinity), 0.0) << "behind it is itself";
    // From a pane backwards: through itself, the next pane, and no further than the wall.
    EXPECT_DOUBLE_EQ(tracer.visibility(layers[0], {0, 0, -1}, 1.5), 0.75 * 0.75);
    EXPECT_EQ(tracer.visibility(layers[0], {0, 0, -1}, kInfinity), 0.0);
}

TEST(Tracer, MasksCutHolesForEyesAndShadows) {
    Scene scene;
    const int material = addMaterial(scene, "lambert");
    const int texture =
        addImage(scene, 2, 2, 4, [](int x, int y, int c) { return c == 3 && x == y ? 0 : 255; });
    Sampler& sampler = scene.textures[static_cast<size_t>(texture)].sampler;
    sampler = {Wrap::repeat, Wrap::repeat, Filter::nearest, Filter::nearest, MipFilter::none};
    Material& masked = scene.materials[static_cast<size_t>(material)];
    masked.alphaMode = AlphaMode::mask;
    masked.baseColorTexture.texture = texture;
    addInstance(scene, addQuad(scene, material, 1.0f));
    addInstance(scene, addQuad(scene, addMaterial(scene, "lambert"), 1.0f),
                glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -1)));
    const Tracer tracer = tracerOf(scene, {0, 0, 3});
    for (const double x : {-0.5, 0.5})
        for (const double y : {-0.5, 0.5}) {
            // Row 0 is at the top, v = 0 there.
            const bool hole = (x > 0.0) == (y < 0.0);
            const auto layers = layersOf(tracer, {{x, y, 3}, {0, 0, -1}});
            ASSERT_EQ(layers.size(), 1u);
            EXPECT_EQ(layers[0].instance, hole ? 1u : 0u) << x << ' ' << y;
            SurfacePoint behind = layers[0];
            behind.instance = 1;
            behind.position.z = -1.0;
            EXPECT_EQ(tracer.visibility(behind, {0, 0, 1}, kInfinity), hole ? 1.0 : 0.0);
        }
}

TEST(Tracer, BackFacesAreCulledForEyesAndBlockLight) {
    for (const double mirror : {1.0, -1.0})
        for (const bool doubleSided : {false, true}) {
            Scene scene;
            const int quad = addQuad(scene, addMaterial(scene, "lambert"), 1.0f);
            scene.materials[0].doubleSided = doubleSided;
            addInstance(scene, quad, glm::scale(glm::dmat4(1.0), glm::dvec3(mirror, 1.0, 1.0)));
            const Tracer tracer = tracerOf(scene);
            EXPECT_EQ(layersOf(tracer, {{0.1, 0.2, 1}, {0, 0, -1}}).size(), 1u);
            const auto behind = layersOf(tracer, {{0.1, 0.2, -1}, {0, 0, 1}});
            ASSERT_EQ(behind.size(), doubleSided ? 1u : 0u);
            if (doubleSided) {
                EXPECT_EQ(behind[0].normal, glm::dvec3(0, 0, -1));
                EXPECT_EQ(behind[0].geometricNormal, glm::dvec3(0, 0, -1));
            }
            SurfacePoint below;
            below.position = {0.1, 0.2, -1};
            below.geometricNormal = {0, 0, 1};
            below.instance = 7;
            EXPECT_EQ(tracer.visibility(below, {0, 0, 1}, kInfinity), 0.0);
            EXPECT_EQ(tracer.visibility(below, {0, 0, 1}, 0.5), 1.0);
        }
}

TEST(Tracer, NoSurfaceShadowsItself) {
    for (const glm::dvec3& place : {glm::dvec3(0.0), glm::dvec3(1e6, 0.0, -1e6)}) {
        Scene scene;
        const int material = addMaterial(scene, "lambert");
        addInstance(scene, addSphere(scene, material), glm::translate(glm::dmat4(1.0), place));
        const Tracer tracer = tracerOf(scene, place + glm::dvec3(0, 0, 3));
        Pcg32 random(4, 1);
        for (int i = 0; i < 50000; ++i) {
            const glm::dvec3 target = place + 0.99 * randomDirection(random);
            const glm::dvec3 eye = place + 3.0 * randomDirection(random);
            const auto layers = layersOf(tracer, {eye, target - eye});
            ASSERT_FALSE(layers.empty());
            const glm::dvec3 on = randomDirection(random);
            // The tessellated ball is convex: what leaves a facet never meets it again.
            const double above = glm::dot(on, layers[0].geometricNormal);
            ASSERT_EQ(tracer.visibility(layers[0], on, kInfinity), above < 0.0 ? 0.0 : 1.0)
                << i << ", cosine " << above;
        }
    }
}

TEST(Tracer, AHugePlaneFarFromTheOriginShowsNoAcne) {
    Scene scene;
    addInstance(scene, addQuad(scene, addMaterial(scene, "lambert"), 1e6f),
                glm::translate(glm::dmat4(1.0), glm::dvec3(1e6, 1e6, 1e6)));
    const glm::dvec3 eye(1e6 + 3.0, 1e6 - 5.0, 1e6 + 1.7);
    const Tracer tracer = tracerOf(scene, eye);
    Pcg32 random(5, 1);
    for (int i = 0; i < 50000; ++i) {
        glm::dvec3 down = randomDirection(random), up = randomDirection(random);
        down.z = -std::abs(down.z) - 1e-5;
        up.z = std::abs(up.z) * (i % 2 == 0 ? 1.0 : 1e-6) + 1e-9;  // grazing, too
        if (i % 3 == 0) down.y = down.x;  // above the diagonal that two triangles share
        const auto layers = layersOf(tracer, {eye, down});
        if (layers.empty()) continue;
        EXPECT_NEAR(layers[0].position.z, 1e6, 1e-9);
        ASSERT_EQ(tracer.visibility(layers[0], up, kInfinity), 1.0) << i;
    }
}

TEST(Tracer, PixelRaysRunFromTheNearToTheFarPlane) {
    Scene scene;
    const int quad = addQuad(scene, addMaterial(scene, "lambert"), 10.0f);
    for (const double z : {-1.0, -2.0, -3.0})
        addInstance(scene, quad, glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, z)));
    for (const bool orthographic : {false, true}) {
        Camera camera = lookAt({0, 0, 0}, {0, 0, -1}, 1.0);
        camera.orthographic = orthographic;
        camera.zNear = 1.5;
        camera.zFar = 2.5;
        const View view = makeView(camera, 8, 6);
        const Tracer tracer = tracerOf(scene, view.eye);
        for (const double x : {0.5, 3.5, 7.5}) {
            const auto layers = layersOf(tracer, pixelRay(view, x, 1.5));
            ASSERT_EQ(layers.size(), 1u);
            EXPECT_EQ(layers[0].instance, 1u);
            EXPECT_DOUBLE_EQ(layers[0].t, 2.0) << "the distance along the axis";
        }
        camera.zNear = 3.1;
        camera.zFar = 4.0;
        EXPECT_TRUE(layersOf(tracer, pixelRay(makeView(camera, 8, 6), 4.5, 1.5)).empty());
    }
}

TEST(Tracer, EmptyAndDegenerateScenesAreSeenThrough) {
    Scene scene;
    EXPECT_TRUE(layersOf(tracerOf(scene), {{0, 0, 1}, {0, 0, -1}}).empty());
    Primitive degenerate;
    degenerate.material = addMaterial(scene, "lambert");
    degenerate.positions = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
    degenerate.normals.assign(3, glm::vec3(0.0f));
    degenerate.indices = {0, 1, 2, 0, 0, 0};
    scene.primitives.push_back(degenerate);
    addInstance(scene, 0);
    addInstance(scene, 0, glm::scale(glm::dmat4(1.0), glm::dvec3(0.0)));
    EXPECT_TRUE(layersOf(tracerOf(scene, {0, 0, 1}), {{0, 0, 1}, {0, 0, -1}}).empty());
}

TEST(Tracer, DenormalNumbersStay) {
    const unsigned before = _mm_getcsr();
    Scene scene;
    addInstance(scene, addSphere(scene, addMaterial(scene, "lambert")));
    const Tracer tracer = tracerOf(scene);
    layersOf(tracer, {{0, 0, 3}, {0, 0, -1}});
    EXPECT_EQ(_mm_getcsr() & 0x8040u, before & 0x8040u) << "flush to zero, denormals are zero";
    EXPECT_EQ(before & 0x8040u, 0u);
}

TEST(Tracer, WhatFloatsCannotHoldIsRefused) {
    Scene scene;
    addInstance(scene, addQuad(scene, addMaterial(scene, "lambert"), 1.0f),
                glm::translate(glm::dmat4(1.0), glm::dvec3(1e30, 0, 0)));
    EXPECT_THROW(tracerOf(scene), Error);
}

}  // namespace
}  // namespace lobe::reference
