// Cameras: what a pixel sees, and how depth turns into distance.
#include "scene/camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"

namespace lobe {
namespace {

Camera perspective(std::optional<double> zFar) {
    Camera camera = lookAt({1, 2, 3}, {-2, 1, -5}, 0.8);
    camera.zNear = 0.1;
    camera.zFar = zFar;
    return camera;
}

Camera orthographic() {
    Camera camera = perspective(50.0);
    camera.orthographic = true;
    camera.xMag = 4.0;
    camera.yMag = 3.0;
    return camera;
}

class Views : public testing::TestWithParam<Camera> {};

TEST_P(Views, RayOfAPixelProjectsToThatPixelAndDepthGivesItsDistance) {
    const View view = makeView(GetParam(), 320, 200, {0.25, -0.125});
    for (const double x : {0.5, 100.0, 319.5})
        for (const double y : {0.5, 77.0, 199.5})
            for (const double z : {0.11, 1.0, 49.0}) {
                const glm::dvec3 p =
                    view.rayOrigin + x * view.rayOriginDx + y * view.rayOriginDy +
                    z * (view.rayDirection + x * view.rayDirectionDx + y * view.rayDirectionDy);
                EXPECT_NEAR(glm::dot(p, view.forward), z, 1e-12 * z);
                const glm::dvec4 clip = view.clipFromRelative * glm::dvec4(p, 1.0);
                EXPECT_NEAR((clip.x / clip.w * 0.5 + 0.5) * 320, x, 1e-9);
                EXPECT_NEAR((clip.y / clip.w * 0.5 + 0.5) * 200, y, 1e-9);
                const double d = clip.z / clip.w;
                EXPECT_GT(d, 0.0);
                EXPECT_LT(d, 1.0);
                const glm::dvec4& k = view.depthToZ;
                EXPECT_NEAR((k.x + k.y * d) / (k.z + k.w * d), z, 1e-11 * z);
            }
}

TEST_P(Views, DepthIsOneAtTheNearPlane) {
    const View view = makeView(GetParam(), 10, 10);
    const glm::dvec4 clip = view.clipFromRelative * glm::dvec4(view.forward * 0.1, 1.0);
    EXPECT_NEAR(clip.z / clip.w, 1.0, 1e-12);
}
INSTANTIATE_TEST_SUITE_P(Kinds, Views, testing::Values(perspective({}), perspective(50.0), orthographic()));

TEST(Camera, WindowOfTheFileStaysVisibleInPicturesOfOtherShapes) {
    Camera camera = perspective({});
    camera.aspect = 2.0;
    const double t = std::tan(0.4);
    for (const auto& [width, height] : {std::pair(400, 100), std::pair(400, 200), std::pair(100, 400)}) {
        const View view = makeView(camera, width, height);
        const double halfWidth = glm::length(view.rayDirectionDx) * width / 2;
        const double halfHeight = glm::length(view.rayDirectionDy) * height / 2;
        EXPECT_GE(halfWidth, 2.0 * t * (1 - 1e-12));
        EXPECT_GE(halfHeight, t * (1 - 1e-12));
        EXPECT_TRUE(std::abs(halfWidth - 2.0 * t) < 1e-12 || std::abs(halfHeight - t) < 1e-12)
            << "and no more than needed";
        EXPECT_NEAR(halfWidth / width, halfHeight / height, 1e-12) << "square pixels";
    }
}

TEST(Camera, FramingHoldsTheBoundsWholeAndTight) {
    Bounds bounds;
    bounds.add({10, 20, 30});
    bounds.add({14, 21, 28});
    for (const double aspect : {0.4, 1.0, 2.5}) {
        const Camera camera = framingCamera(bounds, aspect);
        const View view = makeView(camera, static_cast<int>(1000 * aspect), 1000);
        double largest = 0.0;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 p(corner & 1 ? bounds.upper.x : bounds.lower.x,
                               corner & 2 ? bounds.upper.y : bounds.lower.y,
                               corner & 4 ? bounds.upper.z : bounds.lower.z);
            const glm::dvec4 clip = view.clipFromRelative * glm::dvec4(p - view.eye, 1.0);
            EXPECT_LT(std::abs(clip.x), clip.w);
            EXPECT_LT(std::abs(clip.y), clip.w);
            EXPECT_LT(clip.z, clip.w) << "beyond the near plane";
            largest = std::max({largest, std::abs(clip.x) / clip.w, std::abs(clip.y) / clip.w});
        }
        EXPECT_GT(largest, 0.9) << "no larger than needed";
        const Camera orbiting = framingCamera(bounds, aspect, {.fit = Fit::sphere});
        const double distance = glm::length(glm::dvec3(orbiting.worldFromCamera[3]) - bounds.center());
        const double halfAngle = std::atan(std::tan(orbiting.verticalFov / 2) * std::min(1.0, aspect));
        EXPECT_NEAR(distance * std::sin(halfAngle), bounds.radius(), 1e-9);
    }
}

TEST(Camera, OrbitKeepsDistanceAndComesBack) {
    const Camera camera = perspective({});
    const glm::dvec3 pivot(0.5, 0.25, -1.0);
    const glm::dvec3 eye(camera.worldFromCamera[3]);
    const glm::dvec3 turned(orbited(camera, pivot, 77.0).worldFromCamera[3]);
    EXPECT_NEAR(glm::length(turned - pivot), glm::length(eye - pivot), 1e-12);
    EXPECT_NEAR(turned.y, eye.y, 1e-12);
    EXPECT_GT(glm::length(turned - eye), 1.0);
    const glm::dvec3 back(orbited(camera, pivot, 360.0).worldFromCamera[3]);
    EXPECT_NEAR(glm::length(back - eye), 0.0, 1e-9);
}

TEST(Camera, StraightDownHasAnUpDirection) {
    const Camera camera = lookAt({0, 5, 0}, {0, 0, 0}, 0.8);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            EXPECT_TRUE(std::isfinite(camera.worldFromCamera[c][r]));
    EXPECT_THROW(lookAt({1, 1, 1}, {1, 1, 1}, 0.8), UsageError);
}

TEST(Camera, FoundByNameThenIndexElseTheListIsShown) {
    Scene scene;
    scene.file = "hall.gltf";
    scene.cameras = {perspective({}), perspective({})};
    scene.cameras[0].name = "1";
    scene.cameras[1].name = "Balcony";
    EXPECT_EQ(findCamera(scene, "Balcony").name, "Balcony");
    EXPECT_EQ(findCamera(scene, "1").name, "1") << "a name comes before an index";
    EXPECT_EQ(findCamera(scene, "0").name, "1");
    try {
        findCamera(scene, "Balcny");
        FAIL() << "expected a refusal";
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("hall.gltf"));
        EXPECT_THAT(error.what(), testing::HasSubstr("did you mean 'Balcony'"));
    }
    EXPECT_THROW(findCamera(scene, "2"), UsageError);
}

}  // namespace
}  // namespace lobe
