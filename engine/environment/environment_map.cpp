#include "environment/environment_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>

#include "base/content_hash.hpp"
#include "math/sphere.hpp"
#include "scene/environment_picture.hpp"

namespace lobe {
namespace {

constexpr double kPi = std::numbers::pi;

double brightness(const glm::dvec3& rgb) {
    return (rgb.r + rgb.g + rgb.b) / 3.0;
}

/// Index of the interval of a cumulative sum in which `target` lies, and how far into it.
std::pair<size_t, double> pick(const double* sums, size_t count, double u) {
    const double target = u * sums[count];
    auto i = static_cast<size_t>(std::upper_bound(sums, sums + count + 1, target) - sums);
    i = std::clamp<size_t>(i, 1, count) - 1;
    while (i > 0 && sums[i + 1] == sums[i])
        --i;  // rounded past the last interval that has any
    const double width = sums[i + 1] - sums[i];
    return {i, width > 0.0 ? std::clamp((target - sums[i]) / width, 0.0, 1.0) : 0.5};
}

}  // namespace

EnvironmentMap::EnvironmentMap(const Environment& environment, const Bitmap* bitmap)
    : scale_(bitmap == nullptr ? environment.radiance * environment.intensity
                               : glm::dvec3(environment.intensity)),
      worldFromMap_(environment.worldFromMap) {
    if (bitmap == nullptr) return;
    width_ = bitmap->width;
    height_ = bitmap->height;
    const auto channels = static_cast<size_t>(bitmap->channels);
    texels_.resize(static_cast<size_t>(width_) * static_cast<size_t>(height_));
    for (size_t i = 0; i < texels_.size(); ++i) {
        glm::dvec3 rgb;
        bool bad = false;
        for (size_t c = 0; c < 3; ++c) {
            const double value = linearComponent(*bitmap, i * channels + (channels >= 3 ? c : 0));
            const bool usable = std::isfinite(value) && value >= 0.0;
            bad |= !usable;
            rgb[static_cast<int>(c)] = usable ? value : 0.0;
        }
        badTexels_ += bad ? 1 : 0;
        texels_[i] = rgb;
    }
    rowSums_.assign(static_cast<size_t>(height_) + 1, 0.0);
    sums_.assign((static_cast<size_t>(width_) + 1) * static_cast<size_t>(height_), 0.0);
    for (int y = 0; y < height_; ++y) {
        double* row = &sums_[static_cast<size_t>(y) * (static_cast<size_t>(width_) + 1)];
        for (int x = 0; x < width_; ++x) {
            // Between texels their neighbours shine in.
            double sum = 0.0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    sum += (2 - std::abs(dx)) * (2 - std::abs(dy)) / 16.0 * brightness(texel(x + dx, y + dy));
            row[x + 1] = row[x] + sum;
        }
        const double top = std::cos(kPi * y / height_), bottom = std::cos(kPi * (y + 1) / height_);
        rowSums_[static_cast<size_t>(y) + 1] =
            rowSums_[static_cast<size_t>(y)] + row[width_] * (top - bottom);
    }
}

/// Around the seam, and over the poles to the other side.
const glm::dvec3& EnvironmentMap::texel(int x, int y) const {
    if (y < 0 || y >= height_) {
        y = y < 0 ? -1 - y : 2 * height_ - 1 - y;
        x += width_ / 2;
    }
    y = std::clamp(y, 0, height_ - 1);
    x = ((x % width_) + width_) % width_;
    return texels_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
}

EnvironmentMap EnvironmentMap::of(const Scene& scene) {
    const int image = scene.environment->image;
    return {*scene.environment, image < 0 ? nullptr : &scene.images[static_cast<size_t>(image)]};
}

EnvironmentMap EnvironmentMap::ofBackground(const Scene& scene) {
    const int image = scene.environment->backgroundImage;
    if (image < 0) return of(scene);
    return {*scene.environment, &scene.images[static_cast<size_t>(image)]};
}

glm::dvec3 EnvironmentMap::radiance(const glm::dvec3& direction) const {
    return scale_ * relative(glm::transpose(worldFromMap_) * direction);
}

glm::dvec3 EnvironmentMap::relative(const glm::dvec3& d) const {
    if (constant()) return glm::dvec3(1.0);
    const double polar = std::atan2(std::hypot(d.x, d.z), d.y);
    const double azimuth = std::atan2(d.x, -d.z) / (2.0 * kPi);
    const double x = (azimuth - std::floor(azimuth)) * width_ - 0.5, y = polar / kPi * height_ - 0.5;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const double fx = x - x0, fy = y - y0;
    return glm::mix(glm::mix(texel(x0, y0), texel(x0 + 1, y0), fx),
                    glm::mix(texel(x0, y0 + 1), texel(x0 + 1, y0 + 1), fx), fy);
}

glm::dvec3 EnvironmentMap::draw(double u, double v) const {
    if (constant() || rowSums_.back() == 0.0) return uniformSphere({u, v});
    const auto [row, down] = pick(rowSums_.data(), static_cast<size_t>(height_), v);
    const auto [column, right] =
        pick(&sums_[row * (static_cast<size_t>(width_) + 1)], static_cast<size_t>(width_), u);
    const double top = std::cos(kPi * static_cast<double>(row) / height_);
    const double bottom = std::cos(kPi * static_cast<double>(row + 1) / height_);
    const double y = top + down * (bottom - top);
    const double s = std::sqrt(std::max(0.0, (1.0 - y) * (1.0 + y)));
    const double phi = 2.0 * kPi * (static_cast<double>(column) + right) / width_;
    return worldFromMap_ * glm::dvec3(s * std::sin(phi), y, -s * std::cos(phi));
}

double EnvironmentMap::density(const glm::dvec3& direction) const {
    if (constant() || rowSums_.back() == 0.0) return 1.0 / (4.0 * kPi);
    const glm::dvec3 d = glm::transpose(worldFromMap_) * direction;
    const double polar = std::atan2(std::hypot(d.x, d.z), d.y);
    const double azimuth = std::atan2(d.x, -d.z) / (2.0 * kPi);
    return densityAt(
        static_cast<int>(std::clamp((azimuth - std::floor(azimuth)) * width_, 0.0, width_ - 1.0)),
        static_cast<int>(std::clamp(polar / kPi * height_, 0.0, height_ - 1.0)));
}

std::string EnvironmentMap::contentHash() const {
    ContentHash hash;
    const std::array<int, 2> size{width(), height()};
    hash.add(std::as_bytes(std::span(size)));
    hash.add(std::as_bytes(std::span(texels_)));
    return hash.hex();
}

double EnvironmentMap::densityAt(int x, int y) const {
    if (constant() || rowSums_.back() == 0.0) return 1.0 / (4.0 * kPi);
    const double* row = &sums_[static_cast<size_t>(y) * (static_cast<size_t>(width_) + 1)];
    // Texels of a row have one solid angle: (top - bottom) 2 pi / width.
    return (row[x + 1] - row[x]) / rowSums_.back() * width_ / (2.0 * kPi);
}

}  // namespace lobe
