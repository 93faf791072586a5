// EXT_lights_image_based: faces by the table of OpenGL's cube maps, turned as the extension says; RGBD;
// coefficients.
#include "scene/image_based_light.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "base/error.hpp"
#include "scene/environment_picture.hpp"
#include "scene/made_environment.hpp"

namespace lobe {
namespace {

constexpr double kPi = std::numbers::pi;

/// Where face i shows s, t in [-1, 1], s to the right and t down, by table 3.19 of OpenGL 3.3 (sc, tc, ma).
glm::dvec3 cubeDirection(int face, double s, double t) {
    switch (face) {
        case 0:
            return {1, -t, -s};
        case 1:
            return {-1, -t, s};
        case 2:
            return {s, 1, t};
        case 3:
            return {s, -1, -t};
        case 4:
            return {s, -t, 1};
        default:
            return {-s, -t, -1};
    }
}

Bitmap bitmapOf(int size, int channels, ComponentType type, std::vector<std::byte> data) {
    Bitmap bitmap;
    bitmap.width = bitmap.height = size;
    bitmap.channels = channels;
    bitmap.type = type;
    bitmap.data = std::move(data);
    return bitmap;
}

/// Faces whose colour is 2 + the direction that they show.
Bitmap directionFace(int face, int size) {
    std::vector<float> values;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double s = 2.0 * (x + 0.5) / size - 1.0, t = 2.0 * (y + 0.5) / size - 1.0;
            const glm::dvec3 d = glm::normalize(cubeDirection(face, -s, t));  // saved mirrored left to right
            for (int c = 0; c < 3; ++c)
                values.push_back(static_cast<float>(2.0 + d[c]));
        }
    std::vector<std::byte> data(values.size() * sizeof(float));
    std::memcpy(data.data(), values.data(), data.size());
    return bitmapOf(size, 3, ComponentType::f32, std::move(data));
}

float texel(const Bitmap& bitmap, int x, int y, int c) {
    float value;
    std::memcpy(&value,
                bitmap.data.data() + sizeof value * static_cast<size_t>((y * bitmap.width + x) * 3 + c),
                sizeof value);
    return value;
}

Scene sceneOf(std::vector<Bitmap> faces, std::vector<glm::dvec3> harmonics = {}) {
    Scene scene;
    scene.file = "scene.gltf";
    scene.images.push_back(bitmapOf(1, 3, ComponentType::u8, std::vector<std::byte>(3)));  // of a material
    scene.imageNames.emplace_back("albedo");
    scene.environment = Environment{};
    ImageBasedLight light;
    light.harmonics = std::move(harmonics);
    for (Bitmap& face : faces) {
        light.faces.push_back(static_cast<int>(scene.images.size()));
        scene.images.push_back(std::move(face));
        scene.imageNames.emplace_back("face");
    }
    scene.environment->source.imageBased = light;
    return scene;
}

std::vector<Bitmap> directionFaces(int size) {
    std::vector<Bitmap> faces;
    for (int i = 0; i < 6; ++i)
        faces.push_back(directionFace(i, size));
    return faces;
}

TEST(ImageBasedLight, FacesAreSeenWhereTheExtensionHasThem) {
    Scene scene = sceneOf(directionFaces(32));
    makeEnvironment(scene);
    ASSERT_EQ(scene.images.size(), 2U);  // the faces are gone
    ASSERT_EQ(scene.environment->image, 1);
    const Bitmap& picture = scene.images[1];
    ASSERT_EQ(picture.width, 128);
    double worst = 0.0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const double theta = kPi * (y + 0.5) / picture.height,
                         phi = 2.0 * kPi * (x + 0.5) / picture.width;
            const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta),
                               -std::sin(theta) * std::cos(phi));
            for (int c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(double{texel(picture, x, y, c)} - 2.0 - d[c]));
        }
    EXPECT_LT(worst, 0.04);  // a texel of a face is 0.0625 wide, and ends half of that inside its edge
}

TEST(ImageBasedLight, FourChannelsAreRgbd) {
    const auto byte = [](int value) { return static_cast<std::byte>(value); };
    const Bitmap face = bitmapOf(1, 4, ComponentType::u8, {byte(255), byte(188), byte(0), byte(51)});
    const Bitmap plain = unpackedFace(face);
    EXPECT_NEAR(texel(plain, 0, 0, 0), 5.0, 1e-6);
    EXPECT_NEAR(texel(plain, 0, 0, 1), 5.0 * linearComponent(face, 1), 1e-6);
    EXPECT_EQ(texel(plain, 0, 0, 2), 0.0F);
    const Bitmap opaque =
        unpackedFace(bitmapOf(1, 4, ComponentType::u8, {byte(255), byte(255), byte(0), byte(0)}));
    EXPECT_EQ(texel(opaque, 0, 0, 0), 0.0F);  // nothing to divide by
    const Bitmap low = unpackedFace(bitmapOf(1, 3, ComponentType::u8, {byte(255), byte(0), byte(0)}));
    EXPECT_EQ(texel(low, 0, 0, 0), 1.0F);
}

TEST(ImageBasedLight, CoefficientsAloneGiveTheirIrradiance) {
    // Of 1 + 0.5 y + 0.3 (3 z^2 - 1): all positive, and what harmonics up to band 2 hold.
    std::vector<glm::dvec3> harmonics(9, glm::dvec3(0.0));
    harmonics[0] = glm::dvec3(kPi * std::sqrt(4.0 * kPi));
    harmonics[1] = glm::dvec3(2.0 * kPi / 3.0 * 0.5 / std::sqrt(3.0 / (4.0 * kPi)));
    harmonics[6] = glm::dvec3(kPi / 4.0 * 0.3 / std::sqrt(5.0 / (16.0 * kPi)));
    Scene scene = sceneOf({}, harmonics);
    makeEnvironment(scene);
    const Bitmap& picture = scene.images.at(static_cast<size_t>(scene.environment->image));
    for (const glm::dvec3 n :
         {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1), glm::normalize(glm::dvec3(1, -2, 3))}) {
        double sum = 0.0;
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x) {
                const double theta = kPi * (y + 0.5) / picture.height;
                const double phi = 2.0 * kPi * (x + 0.5) / picture.width;
                const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta),
                                   -std::sin(theta) * std::cos(phi));
                const double radiance = 1.0 + 0.5 * d.y + 0.3 * (3.0 * d.z * d.z - 1.0);
                EXPECT_NEAR(texel(picture, x, y, 0), radiance, 1e-5);
                sum += radiance * std::max(glm::dot(n, d), 0.0) * std::sin(theta) * (kPi / picture.height) *
                       (2.0 * kPi / picture.width);
            }
        EXPECT_NEAR(irradianceOf(harmonics, n).r, sum, 2e-3 * sum);
    }
    EXPECT_THAT(scene.environment->notes, testing::ElementsAre(testing::HasSubstr("without images")));
}

TEST(ImageBasedLight, CoefficientsThatDoNotBelongToTheImagesAreNamed) {
    std::vector<glm::dvec3> right(9, glm::dvec3(0.0));
    right[0] = glm::dvec3(2.0 * kPi * std::sqrt(4.0 * kPi));  // the faces' mean is 2
    Scene same = sceneOf(directionFaces(8), right);
    makeEnvironment(same);
    EXPECT_TRUE(same.warnings.empty());
    right[0] *= 3.0;
    Scene other = sceneOf(directionFaces(8), right);
    makeEnvironment(other);
    ASSERT_EQ(other.warnings.size(), 1U);
    EXPECT_THAT(other.warnings[0], testing::HasSubstr("mean irradiance 18.8"));
}

TEST(ImageBasedLight, FacesOfDifferentSizesAreRefused) {
    std::vector<Bitmap> faces = directionFaces(8);
    faces[3] = directionFace(3, 4);
    Scene scene = sceneOf(std::move(faces));
    try {
        makeEnvironment(scene);
        FAIL() << "not refused";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("specularImages[0]: faces of 8 and 4 x 4"));
    }
}

}  // namespace
}  // namespace lobe
