#include "scene/image_based_light.hpp"

#include <algorithm>
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

std::array<double, 9> functionsAt(const glm::dvec3& n) {
    return {0.28209479177387814,
            0.4886025119029199 * n.y,
            0.4886025119029199 * n.z,
            0.4886025119029199 * n.x,
            1.0925484305920792 * n.x * n.y,
            1.0925484305920792 * n.y * n.z,
            0.31539156525252005 * (3.0 * n.z * n.z - 1.0),
            1.0925484305920792 * n.x * n.z,
            0.5462742152960396 * (n.x * n.x - n.y * n.y)};
}

/// Of the clamped cosine, by band.
double cosineFactor(size_t function) {
    return function == 0 ? kPi : function < 4 ? 2.0 * kPi / 3.0 : kPi / 4.0;
}

Bitmap floats(int width, int height, const std::vector<float>& values) {
    Bitmap bitmap;
    bitmap.width = width;
    bitmap.height = height;
    bitmap.channels = 3;
    bitmap.type = ComponentType::f32;
    bitmap.data.resize(values.size() * sizeof(float));
    std::memcpy(bitmap.data.data(), values.data(), bitmap.data.size());
    return bitmap;
}

/// Channel by channel, of an equirectangular picture.
glm::dvec3 meanOf(const Bitmap& bitmap) {
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (int y = 0; y < bitmap.height; ++y) {
        const double weight = std::sin(kPi * (y + 0.5) / bitmap.height);
        for (int x = 0; x < bitmap.width; ++x) {
            const size_t first =
                (static_cast<size_t>(y) * static_cast<size_t>(bitmap.width) + static_cast<size_t>(x)) *
                static_cast<size_t>(bitmap.channels);
            for (int c = 0; c < 3; ++c)
                sum[c] += weight * linearComponent(bitmap, first + static_cast<size_t>(c));
        }
        weights += weight * bitmap.width;
    }
    return sum / weights;
}

/// Says so where the coefficients that are not used have another mean than the faces.
void compareMeans(Scene& scene, const std::vector<glm::dvec3>& harmonics, const Bitmap& picture) {
    constexpr double kTolerance = 0.1;
    if (harmonics.empty()) return;
    const glm::dvec3 given = harmonics[0] * functionsAt({0, 0, 1})[0], made = kPi * meanOf(picture);
    const auto grey = [](const glm::dvec3& rgb) { return (rgb.r + rgb.g + rgb.b) / 3.0; };
    if (std::abs(grey(given) - grey(made)) <= kTolerance * std::max(grey(made), grey(given))) return;
    scene.warnings.push_back("EXT_lights_image_based: mean irradiance " + std::to_string(grey(given)) +
                             " by irradianceCoefficients, " + std::to_string(grey(made)) +
                             " by specularImages; the images are used");
}

}  // namespace

Bitmap unpackedFace(const Bitmap& face) {
    const auto channels = static_cast<size_t>(face.channels), width = static_cast<size_t>(face.width);
    std::vector<float> values;
    values.reserve(width * static_cast<size_t>(face.height) * 3);
    for (size_t y = 0; y < static_cast<size_t>(face.height); ++y)
        for (size_t x = width; x-- > 0;) {
            const size_t first = (y * width + x) * channels;
            double divisor = 1.0;
            if (channels == 4 && face.type == ComponentType::u8)
                divisor = std::to_integer<int>(face.data[first + 3]) / 255.0;
            for (size_t c = 0; c < 3; ++c) {
                const double value = linearComponent(face, first + (channels >= 3 ? c : 0));
                values.push_back(static_cast<float>(divisor > 0.0 ? value / divisor : 0.0));
            }
        }
    return floats(face.width, face.height, values);
}

glm::dvec3 irradianceOf(std::span<const glm::dvec3> harmonics, const glm::dvec3& normal) {
    const auto functions = functionsAt(normal);
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < functions.size(); ++i)
        sum += harmonics[i] * functions[i];
    return sum;
}

Bitmap pictureOf(std::span<const glm::dvec3> harmonics) {
    constexpr int kHeight = 64;
    std::array<glm::dvec3, 9> radiance;
    for (size_t i = 0; i < radiance.size(); ++i)
        radiance[i] = harmonics[i] / cosineFactor(i);
    std::vector<float> values;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < 2 * kHeight; ++x) {
            const double theta = kPi * (y + 0.5) / kHeight, phi = kPi * (x + 0.5) / kHeight;
            const glm::dvec3 light = irradianceOf(radiance, {std::sin(theta) * std::sin(phi), std::cos(theta),
                                                             -std::sin(theta) * std::cos(phi)});
            for (int c = 0; c < 3; ++c)
                values.push_back(static_cast<float>(std::max(light[c], 0.0)));
        }
    return floats(2 * kHeight, kHeight, values);
}

void makeImageBased(Scene& scene) {
    Environment& environment = *scene.environment;
    const ImageBasedLight light = *environment.source.imageBased;
    environment.source.imageBased.reset();
    if (light.faces.empty()) {
        environment.image = addPicture(scene, pictureOf(light.harmonics), "EXT_lights_image_based");
        environment.notes.emplace_back(
            "EXT_lights_image_based without images: made of its coefficients of irradiance");
        return;
    }
    std::array<Bitmap, 6> faces;
    for (size_t i = 0; i < faces.size(); ++i)
        faces[i] = unpackedFace(scene.images[static_cast<size_t>(light.faces[i])]);
    const auto first = static_cast<size_t>(light.faces[0]);
    scene.images.resize(first);
    scene.imageNames.resize(first);
    Bitmap picture = fromCubeFaces(faces, scene.file + ": EXT_lights_image_based: specularImages[0]");
    compareMeans(scene, light.harmonics, picture);
    environment.image = addPicture(scene, std::move(picture), "EXT_lights_image_based");
    environment.notes.emplace_back(
        "EXT_lights_image_based: of the largest of its images; blurred maps and irradiance are our own");
}

}  // namespace lobe
