#include "scene/environment_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "base/error.hpp"
#include "image/tone.hpp"

namespace lobe {
namespace {

constexpr double kPi = std::numbers::pi;

/// A picture's radiance, with 0 for texels that are negative or not finite, so that they spoil none beside
/// them.
class Linear {
public:
    explicit Linear(const Bitmap& bitmap) : width_(static_cast<size_t>(bitmap.width)) {
        const auto channels = static_cast<size_t>(bitmap.channels);
        texels_.reserve(width_ * static_cast<size_t>(bitmap.height));
        for (size_t i = 0; i < width_ * static_cast<size_t>(bitmap.height); ++i) {
            glm::vec3 rgb;
            for (int c = 0; c < 3; ++c)
                rgb[c] = static_cast<float>(
                    linearComponent(bitmap, i * channels + (channels >= 3 ? static_cast<size_t>(c) : 0)));
            const bool good = std::isfinite(rgb.r + rgb.g + rgb.b) && rgb.r >= 0 && rgb.g >= 0 && rgb.b >= 0;
            texels_.push_back(good ? rgb : glm::vec3(0.0F));
        }
    }

    glm::dvec3 at(int x, int y) const {
        return texels_[static_cast<size_t>(y) * width_ + static_cast<size_t>(x)];
    }

private:
    size_t width_;
    std::vector<glm::vec3> texels_;
};

/// A square of a picture as a face of the cube: `right` and `up` as the square shows them.
struct Face {
    glm::dvec3 forward, right, up;
    const Linear* picture;
    int x, y;
};

/// Bilinear within the face.
glm::dvec3 seen(const Face& face, int side, const glm::dvec3& d) {
    const double depth = glm::dot(d, face.forward);
    const double u = (glm::dot(d, face.right) / depth + 1.0) / 2.0 * side - 0.5;
    const double v = (1.0 - glm::dot(d, face.up) / depth) / 2.0 * side - 0.5;
    const int x = static_cast<int>(std::floor(u)), y = static_cast<int>(std::floor(v));
    const auto at = [&](int i, int j) {
        return face.picture->at(face.x + std::clamp(i, 0, side - 1), face.y + std::clamp(j, 0, side - 1));
    };
    return glm::mix(glm::mix(at(x, y), at(x + 1, y), u - x), glm::mix(at(x, y + 1), at(x + 1, y + 1), u - x),
                    v - y);
}

Bitmap equirectangular(const std::array<Face, 6>& faces, int side) {
    constexpr int kSub = 2;  ///< points along each side of a texel
    Bitmap result;
    result.width = 4 * side;
    result.height = 2 * side;
    result.channels = 3;
    result.type = ComponentType::f32;
    std::vector<float> values;
    values.reserve(static_cast<size_t>(result.width) * static_cast<size_t>(result.height) * 3);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            glm::dvec3 sum(0.0);
            for (int j = 0; j < kSub; ++j)
                for (int i = 0; i < kSub; ++i) {
                    const double phi = 2.0 * kPi * (x + (i + 0.5) / kSub) / result.width;
                    const double theta = kPi * (y + (j + 0.5) / kSub) / result.height;
                    const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta),
                                       -std::sin(theta) * std::cos(phi));
                    const auto face =
                        std::max_element(faces.begin(), faces.end(), [&](const Face& a, const Face& b) {
                            return glm::dot(a.forward, d) < glm::dot(b.forward, d);
                        });
                    sum += seen(*face, side, d);
                }
            for (int c = 0; c < 3; ++c)
                values.push_back(static_cast<float>(sum[c] / (kSub * kSub)));
        }
    result.data.resize(values.size() * sizeof(float));
    std::memcpy(result.data.data(), values.data(), result.data.size());
    return result;
}

constexpr glm::dvec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

}  // namespace

double linearComponent(const Bitmap& bitmap, size_t index) {
    switch (bitmap.type) {
        case ComponentType::u8:
            return decodeSrgb(static_cast<float>(std::to_integer<int>(bitmap.data[index])) / 255.0F);
        case ComponentType::u16: {
            uint16_t value;
            std::memcpy(&value, bitmap.data.data() + index * sizeof value, sizeof value);
            return decodeSrgb(static_cast<float>(value) / 65535.0F);
        }
        default: {
            float value;
            std::memcpy(&value, bitmap.data.data() + index * sizeof value, sizeof value);
            return value;
        }
    }
}

std::optional<std::string> badTexelWarning(const Bitmap& bitmap) {
    if (bitmap.type != ComponentType::f32) return {};
    const auto channels = static_cast<size_t>(bitmap.channels);
    const size_t colors = channels >= 3 ? 3 : 1;
    size_t negative = 0, infinite = 0;
    for (size_t i = 0; i < bitmap.data.size() / sizeof(float); i += channels) {
        bool below = false, beyond = false;
        for (size_t c = 0; c < colors; ++c) {
            const double value = linearComponent(bitmap, i + c);
            beyond |= !std::isfinite(value);
            below |= value < 0.0;
        }
        infinite += beyond ? 1 : 0;
        negative += below && !beyond ? 1 : 0;
    }
    if (negative + infinite == 0) return {};
    return "the environment has " + std::to_string(infinite) + " texels that are not finite and " +
           std::to_string(negative) + " that are negative; taken as 0";
}

bool isCubeCross(const Bitmap& bitmap) {
    return (bitmap.width * 3 == bitmap.height * 4 && bitmap.width % 4 == 0) ||
           (bitmap.width * 4 == bitmap.height * 3 && bitmap.width % 3 == 0);
}

Bitmap fromCubeCross(const Bitmap& cross) {
    const bool lying = cross.width > cross.height;
    const int side = cross.width / (lying ? 4 : 3);
    const Linear picture(cross);
    const auto at = [&](const glm::dvec3& forward, const glm::dvec3& right, const glm::dvec3& up, int x,
                        int y) { return Face{forward, right, up, &picture, x * side, y * side}; };
    return equirectangular(
        {at(kX, kZ, kY, 0, 1), at(-kX, -kZ, kY, 2, 1), at(kY, -kX, -kZ, 1, 0), at(-kY, -kX, kZ, 1, 2),
         at(kZ, -kX, kY, 1, 1), lying ? at(-kZ, kX, kY, 3, 1) : at(-kZ, -kX, -kY, 1, 3)},
        side);
}

Bitmap fromCubeFaces(const std::array<Bitmap, 6>& faces, const std::string& what) {
    const int side = faces[0].width;
    for (const Bitmap& face : faces)
        if (face.width != side || face.height != side)
            throw InputError(what + ": faces of " + std::to_string(side) + " and " +
                             std::to_string(face.width) + " x " + std::to_string(face.height) +
                             "; expected six squares of one size");
    const std::vector<Linear> pictures(faces.begin(), faces.end());
    const auto at = [&](size_t i, const glm::dvec3& forward, const glm::dvec3& right, const glm::dvec3& up) {
        return Face{forward, right, up, &pictures[i], 0, 0};
    };
    return equirectangular({at(0, kX, -kZ, kY), at(1, -kX, kZ, kY), at(2, kY, kX, -kZ), at(3, -kY, kX, kZ),
                            at(4, kZ, kX, kY), at(5, -kZ, -kX, kY)},
                           side);
}

}  // namespace lobe
