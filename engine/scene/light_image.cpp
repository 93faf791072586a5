#include "scene/light_image.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "scene/environment_picture.hpp"

namespace lobe {
namespace {

/// Which share of each source texel a texel of a coarser level covers, of those from `first` on.
struct Cover {
    int first = 0;
    std::vector<double> shares;  ///< add up to 1
};

Cover coverOf(int texel, int size, int from) {
    const double begin = static_cast<double>(texel) * from / size,
                 end = static_cast<double>(texel + 1) * from / size;
    Cover cover{static_cast<int>(begin), {}};
    for (int i = cover.first; i < from && i < end; ++i)
        cover.shares.push_back((std::min(end, i + 1.0) - std::max(begin, static_cast<double>(i))) /
                               (end - begin));
    return cover;
}

}  // namespace

LightImage::LightImage(int width, int height)
    : width_(width), height_(height), values_(3 * static_cast<size_t>(width) * static_cast<size_t>(height)) {}

LightImage::LightImage(const Bitmap& bitmap) : LightImage(bitmap.width, bitmap.height) {
    const auto channels = static_cast<size_t>(bitmap.channels);
    for (size_t i = 0; i < values_.size() / 3; ++i)
        for (size_t c = 0; c < 3; ++c) {
            const double value = linearComponent(bitmap, i * channels + (channels >= 3 ? c : 0));
            values_[3 * i + c] = std::isfinite(value) ? static_cast<float>(std::max(value, 0.0)) : 0.0F;
        }
}

glm::dvec3 LightImage::texel(int x, int y) const {
    const float* rgb =
        values_.data() + 3 * (static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x));
    return {rgb[0], rgb[1], rgb[2]};
}

glm::dvec3 LightImage::at(const glm::dvec2& place) const {
    const double u = std::clamp(place.x * width_ - 0.5, 0.0, width_ - 1.0);
    const double v = std::clamp(place.y * height_ - 0.5, 0.0, height_ - 1.0);
    const int x = static_cast<int>(u), y = static_cast<int>(v);
    const int right = std::min(x + 1, width_ - 1), below = std::min(y + 1, height_ - 1);
    return glm::mix(glm::mix(texel(x, y), texel(right, y), u - x),
                    glm::mix(texel(x, below), texel(right, below), u - x), v - y);
}

LightImage LightImage::reduced(int width, int height) const {
    LightImage result(std::min(width, width_), std::min(height, height_));
    std::vector<Cover> columns;
    for (int x = 0; x < result.width_; ++x)
        columns.push_back(coverOf(x, result.width_, width_));
    size_t next = 0;
    for (int y = 0; y < result.height_; ++y) {
        const Cover rows = coverOf(y, result.height_, height_);
        for (const Cover& column : columns) {
            glm::dvec3 mean(0.0);
            for (size_t j = 0; j < rows.shares.size(); ++j)
                for (size_t i = 0; i < column.shares.size(); ++i)
                    mean += rows.shares[j] * column.shares[i] *
                            texel(column.first + static_cast<int>(i), rows.first + static_cast<int>(j));
            for (int c = 0; c < 3; ++c)
                result.values_[next++] = static_cast<float>(mean[c]);
        }
    }
    return result;
}

glm::dvec2 placeOnImage(const Light& light, const glm::dvec3& offset) {
    // Seen from the side that emits, the light's axis points to the left and cross(direction, axis) down.
    return {0.5 - glm::dot(offset, light.axis) / light.width,
            0.5 + glm::dot(offset, glm::cross(light.direction, light.axis)) / light.height};
}

std::optional<std::string> clearBadTexels(Bitmap& bitmap) {
    if (bitmap.type != ComponentType::f32) return {};
    const auto channels = static_cast<size_t>(bitmap.channels);
    const size_t colors = channels >= 3 ? 3 : 1;
    size_t negative = 0, infinite = 0;
    std::vector<float> texel(channels);
    for (size_t at = 0; at + channels * sizeof(float) <= bitmap.data.size(); at += channels * sizeof(float)) {
        std::memcpy(texel.data(), bitmap.data.data() + at, channels * sizeof(float));
        bool beyond = false, below = false;
        for (size_t c = 0; c < colors; ++c) {
            beyond |= !std::isfinite(texel[c]);
            below |= texel[c] < 0.0F;
            if (!std::isfinite(texel[c]) || texel[c] < 0.0F) texel[c] = 0.0F;
        }
        infinite += beyond ? 1 : 0;
        negative += below && !beyond ? 1 : 0;
        if (beyond || below) std::memcpy(bitmap.data.data() + at, texel.data(), channels * sizeof(float));
    }
    if (negative + infinite == 0) return {};
    return "has " + std::to_string(infinite) + " texels that are not finite and " + std::to_string(negative) +
           " that are negative; taken as 0";
}

}  // namespace lobe
