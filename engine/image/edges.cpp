#include "image/edges.hpp"

#include <algorithm>
#include <cmath>

namespace lobe {
namespace {

constexpr double kTurned = 0.8660254037844386;  // cos 30 degrees
constexpr double kOffPlane = 0.01;              // of 1 / depth, which is linear in x and y on a plane

struct Layers {
    std::optional<Plane> material, depth;
    std::array<std::optional<Plane>, 3> normal;

    bool any() const { return material || depth || hasNormal(); }
    bool hasNormal() const { return normal[0] && normal[1] && normal[2]; }
};

Layers layersOf(const Image& image) {
    return {channelOf(image, "material.id"),
            channelOf(image, "depth.Z"),
            {channelOf(image, "normal.X"), channelOf(image, "normal.Y"), channelOf(image, "normal.Z")}};
}

/// Whether pixels a and b show different surfaces.
bool differ(const Layers& layers, size_t a, size_t b) {
    if (layers.material && (*layers.material)[a] != (*layers.material)[b]) return true;
    if (layers.depth && ((*layers.depth)[a] == 0.0) != ((*layers.depth)[b] == 0.0)) return true;
    if (!layers.hasNormal()) return false;
    double product = 0.0, lengthA = 0.0, lengthB = 0.0;
    for (const std::optional<Plane>& axis : layers.normal) {
        product += (*axis)[a] * (*axis)[b];
        lengthA += (*axis)[a] * (*axis)[a];
        lengthB += (*axis)[b] * (*axis)[b];
    }
    return product < kTurned * std::sqrt(lengthA * lengthB) || (lengthA == 0.0) != (lengthB == 0.0);
}

/// Three pixels in a row that do not lie on one plane.
bool bent(const Layers& layers, size_t before, size_t at, size_t after) {
    if (!layers.depth) return false;
    const double a = (*layers.depth)[before], b = (*layers.depth)[at], c = (*layers.depth)[after];
    if (a == 0.0 || b == 0.0 || c == 0.0) return false;  // background: found by differ()
    return std::abs(b / a - 2.0 + b / c) > kOffPlane;
}

}  // namespace

std::optional<Plane> channelOf(const Image& image, const std::string& name) {
    const auto found = std::find(image.channels.begin(), image.channels.end(), name);
    if (found == image.channels.end()) return std::nullopt;
    const auto channel = static_cast<size_t>(found - image.channels.begin());
    Plane plane(image.pixelCount());
    for (size_t i = 0; i < plane.size(); ++i)
        plane[i] = static_cast<double>(image.values[i * image.channelCount() + channel]);
    return plane;
}

std::optional<PixelMask> edgePixels(const Image& test, const Image& truth) {
    const Layers own = layersOf(truth), other = layersOf(test);
    if (!own.any() && !other.any()) return std::nullopt;
    const Layers& layers = own.any() ? own : other;
    const int width = truth.width, height = truth.height;
    const auto at = [&](int x, int y) {
        return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
    };
    PixelMask mask(truth.pixelCount(), 0);
    const bool bothKnow = own.material && other.material;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const size_t here = at(x, y);
            bool edge = bothKnow && (*own.material)[here] != (*other.material)[here];
            for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v)
                for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u)
                    edge = edge || differ(layers, here, at(u, v));
            if (x > 0 && x + 1 < width) edge = edge || bent(layers, at(x - 1, y), here, at(x + 1, y));
            if (y > 0 && y + 1 < height) edge = edge || bent(layers, at(x, y - 1), here, at(x, y + 1));
            mask[here] = edge ? 1 : 0;
        }
    return mask;
}

}  // namespace lobe
