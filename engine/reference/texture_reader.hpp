/// Texels in double, filtered after the rules of OpenGL 3.3 (section 3.8.9, 3.8.10).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "image/image.hpp"
#include "scene/scene.hpp"

namespace lobe::reference {

/// An image with its mip levels. Each level is floor(size / 2) texels a side, at least 1, and its texels are
/// means over the area that they cover, of linear values.
class TextureReader {
public:
    /// Keeps a reference to the bitmap. With `srgb` colours, not alpha, are decoded (but floats, which are
    /// linear already).
    TextureReader(const Bitmap& bitmap, bool srgb);

    /// Texel of a level, coordinates within it; grey stands for equal red, green and blue, absent alpha is 1.
    glm::dvec4 texel(int level, int x, int y) const;
    glm::ivec2 size(int level) const;
    int levels() const { return static_cast<int>(coarser_.size()) + 1; }

    /// Filtered value at uv (0, 0 = corner of the first row's first texel). `dx`, `dy`: change of uv from
    /// pixel to pixel; zero = magnified.
    glm::dvec4 sample(const Sampler& sampler, const glm::dvec2& uv, const glm::dvec2& dx,
                      const glm::dvec2& dy) const;

private:
    struct Level {
        int width = 0;
        int height = 0;
        std::vector<double> values;  ///< as many channels as the bitmap has
    };
    double value(int level, int x, int y, int channel) const;
    glm::dvec4 sampleLevel(const Sampler& sampler, Filter filter, const glm::dvec2& uv, int level) const;

    const Bitmap& bitmap_;
    bool decode_;
    std::vector<Level> coarser_;  ///< levels 1 and up
};

}  // namespace lobe::reference
