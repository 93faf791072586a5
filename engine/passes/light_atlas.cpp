#include "passes/light_atlas.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.hpp"
#include "scene/light_image.hpp"

namespace lobe {
namespace {

/// Beyond those that other inputs take; combined units reach to 48.
constexpr GLuint kUnit = 31;

/// What an image and its halves take.
glm::ivec2 blockOf(const LightImage& image) {
    return {2 * image.width() + 1, image.height() + 1};
}

void fill(const LightImage& image, GLint x, GLint y) {
    glTexSubImage2D(GL_TEXTURE_2D, 0, x, y, image.width(), image.height(), GL_RGB, GL_FLOAT, image.values().data());
}

}  // namespace

LightAtlas::LightAtlas(const Scene& scene, const FramePlan& plan) {
    if (!plan.lightImages) return;
    std::map<int, LightImage> images;
    for (const Light& light : scene.lights)
        if (light.image >= 0 && !images.contains(light.image))
            images.emplace(light.image, LightImage(scene.images[static_cast<size_t>(light.image)]));
    // One beside the other in rows, which are about as wide as all are high.
    double area = 0.0;
    int width = 0;
    for (const auto& [index, image] : images) {
        const glm::ivec2 block = blockOf(image);
        area += static_cast<double>(block.x) * block.y;
        width = std::max(width, block.x);
    }
    width = std::max(width, static_cast<int>(std::sqrt(area)));
    glm::ivec2 next(0);
    int row = 0;
    for (const auto& [index, image] : images) {
        const glm::ivec2 block = blockOf(image);
        if (next.x + block.x > width) {
            next = {0, next.y + row};
            row = 0;
        }
        places_[index] = {next.x, next.y, image.width(), image.height()};
        next.x += block.x;
        row = std::max(row, block.y);
    }
    const int height = next.y + row;
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    if (std::max(width, height) > most)
        throw InputError(scene.file + ": images on lights take a texture of " + std::to_string(width) + " x " +
                         std::to_string(height) + " texels; expected at most " + std::to_string(most) +
                         " a side, the driver's limit");
    texture_ = gl::Texture::make();
    glBindTexture(GL_TEXTURE_2D, texture_.id());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, width, height, 0, GL_RGB, GL_FLOAT, nullptr);
    for (const GLenum side : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, side, GL_LINEAR);
    for (const GLenum side : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, side, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    for (const auto& [index, image] : images) {
        const glm::ivec2 corner = glm::dvec2(places_.at(index));
        const glm::ivec2 size(image.width(), image.height());
        fill(image, corner.x, corner.y);
        LightImage half = image;
        for (int level = 1; half.width() > 1 || half.height() > 1; ++level) {
            half = half.halved();
            const glm::ivec2 at = corner + glm::ivec2(size.x, 0) + size - (size >> (level - 1));
            fill(half, at.x, at.y);
        }
    }
}

void LightAtlas::bind(const gl::Program& program) const {
    if (!texture_ || program.uniform("uLightImages") < 0) return;
    glActiveTexture(GL_TEXTURE0 + kUnit);
    glBindTexture(GL_TEXTURE_2D, texture_.id());
    glBindSampler(kUnit, 0);
    program.set("uLightImages", static_cast<int>(kUnit));
}

}  // namespace lobe
