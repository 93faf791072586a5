/// Textures read as OpenGL reads them, in double: wrapping, filters, mipmaps.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <vector>

#include "scene/scene.hpp"

namespace lobe::reference {

/// Texture coordinates at a point and how they change from pixel to pixel; without: the finest level.
struct UvFootprint {
    glm::dvec2 uv{0.0};
    glm::dvec2 dx{0.0}, dy{0.0};
    bool known = false;  ///< whether dx and dy are
};

class TextureReader {
public:
    /// Decodes and filters the images that the materials in use refer to; the scene is kept by reference.
    explicit TextureReader(const Scene& scene);

    /// Red, green, blue, alpha. `srgb`: colours are decoded before they are filtered. A texture without image
    /// is white.
    glm::dvec4 read(const TextureSlot& slot, bool srgb, const UvFootprint& footprint) const;

private:
    struct Level {
        int width = 0, height = 0;
        std::vector<glm::vec4> texels;
    };
    using Levels = std::vector<Level>;
    static Levels decode(const Bitmap& bitmap, bool srgb);
    static Level halved(const Level& level);
    static glm::dvec4 sample(const Level& level, const Sampler& sampler, Filter filter, const glm::dvec2& uv);

    const Scene& scene_;
    std::map<std::pair<int, bool>, Levels> images_;
};

}  // namespace lobe::reference
