#include "passes/light_atlas.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace lobe {
namespace {

/// Beyond those that other inputs take; combined units reach to 48.
constexpr GLuint kUnit = 31;

/// How often 1 is doubled until it is `size` or more.
int doublings(int size) {
    int count = 0;
    while ((1 << count) < size)
        ++count;
    return count;
}

int partsAt(int level, int behind, int full, int size) {
    return std::min(size, 1 << std::clamp(level - behind, 0, full));
}

void fill(const LightImage& image, const glm::ivec2& at) {
    glTexSubImage2D(GL_TEXTURE_2D, 0, at.x, at.y, image.width(), image.height(), GL_RGB, GL_FLOAT,
                    image.values().data());
}

}  // namespace

LightImageLayout::LightImageLayout(const glm::ivec2& imageSize, double aspect)
    : size(imageSize),
      turn(static_cast<int>(std::clamp(std::round(0.5 * std::log2(aspect)), -2.0, 2.0))),
      behind(std::max(-2 * turn, 0), std::max(2 * turn, 0)),
      full(doublings(size.x), doublings(size.y)),
      last(std::max(full.x + behind.x, full.y + behind.y)) {}

glm::ivec2 LightImageLayout::sizeOf(int level) const {
    if (level >= last) return size;
    return {partsAt(level, behind.x, full.x, size.x), partsAt(level, behind.y, full.y, size.y)};
}

glm::ivec2 LightImageLayout::cornerOf(int level) const {
    if (level >= last) return {0, 0};
    glm::ivec2 corner(size.x, 0);
    for (int above = 0; above < level; ++above)
        corner.y += sizeOf(above).y;
    return corner;
}

glm::ivec2 LightImageLayout::block() const {
    int high = size.y;
    if (last > 0) high = std::max(high, cornerOf(last - 1).y + sizeOf(last - 1).y);
    return {2 * size.x, high};
}

LightAtlas::Key LightAtlas::keyOf(const Scene& scene, const Light& light) {
    const Bitmap& image = scene.images[static_cast<size_t>(light.image)];
    return {light.image, LightImageLayout({image.width, image.height}, light.width / light.height).turn};
}

LightAtlas::LightAtlas(const Scene& scene, const FramePlan& plan) : scene_(scene) {
    if (!plan.lightImages) return;
    for (const Light& light : scene.lights)
        if (light.image >= 0) {
            const Bitmap& image = scene.images[static_cast<size_t>(light.image)];
            layouts_.emplace(keyOf(scene, light),
                             LightImageLayout({image.width, image.height}, light.width / light.height));
        }
    // One beside the other in rows, which are about as wide as all are high.
    double area = 0.0;
    int width = 0;
    for (const auto& [key, layout] : layouts_) {
        area += static_cast<double>(layout.block().x) * layout.block().y;
        width = std::max(width, layout.block().x);
    }
    width = std::max(width, static_cast<int>(std::sqrt(area)));
    glm::ivec2 next(0);
    int row = 0;
    for (const auto& [key, layout] : layouts_) {
        const glm::ivec2 block = layout.block();
        if (next.x + block.x > width) {
            next = {0, next.y + row};
            row = 0;
        }
        corners_[key] = next;
        next.x += block.x;
        row = std::max(row, block.y);
    }
    upload(scene, width, next.y + row);
}

void LightAtlas::upload(const Scene& scene, int width, int height) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (std::max(width, height) > most)
        throw InputError(scene.file + ": images on lights take a texture of " + std::to_string(width) +
                         " x " + std::to_string(height) + " texels; expected at most " +
                         std::to_string(most) + " a side, the driver's limit");
    texture_ = gl::Texture::make();
    glBindTexture(GL_TEXTURE_2D, texture_.id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    // Filters touch what is between the pictures with a weight of 0: it must be a number.
    const std::vector<float> black(3 * static_cast<size_t>(width) * static_cast<size_t>(height), 0.0F);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGB, GL_FLOAT, black.data());
    for (const GLenum side : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, side, GL_LINEAR);
    for (const GLenum side : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, side, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    for (const auto& [key, layout] : layouts_) {
        const LightImage image(scene.images[static_cast<size_t>(key.first)]);
        for (int level = 0; level <= layout.last; ++level) {
            const glm::ivec2 size = layout.sizeOf(level);
            fill(image.reduced(size.x, size.y), corners_.at(key) + layout.cornerOf(level));
        }
    }
}

glm::dvec4 LightAtlas::nameOf(const Light& light) const {
    if (light.image < 0) return glm::dvec4(0.0);
    const Key key = keyOf(scene_, light);
    const LightImageLayout& layout = layouts_.at(key);
    const glm::ivec2 corner = corners_.at(key);
    return {corner.x + (layout.turn + 2) / 8.0, corner.y + (16 * layout.full.x + layout.full.y) / 256.0,
            layout.size.x, layout.size.y};
}

void LightAtlas::bind(const gl::Program& program) const {
    if (!texture_ || program.uniform("uLightImages") < 0) return;
    glActiveTexture(GL_TEXTURE0 + kUnit);
    glBindTexture(GL_TEXTURE_2D, texture_.id());
    glBindSampler(kUnit, 0);
    program.set("uLightImages", static_cast<int>(kUnit));
}

}  // namespace lobe
