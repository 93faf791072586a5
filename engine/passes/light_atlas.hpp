/// The images on rect lights in one texture.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <utility>

#include "gl/objects.hpp"
#include "gl/program.hpp"
#include "plan/plan.hpp"
#include "scene/light_image.hpp"

namespace lobe {

/// How an image lies in the texture: the image itself, and beside it, one below the other, its means over
/// ever more parts (shaders/glsl/light/light_image.glsl). Level 0 is the mean of all; each has twice as many
/// parts along each side as the one before, at most as many as texels; along the shorter side of a rect 4 or
/// 16 times as long as wide, which cells are to be square on, only from level 2 or 4 on. The last is the
/// image itself.
struct LightImageLayout {
    /// `aspect`: width / height of the rect.
    LightImageLayout(const glm::ivec2& imageSize, double aspect);

    glm::ivec2 sizeOf(int level) const;
    glm::ivec2 cornerOf(int level) const;
    glm::ivec2 block() const;  ///< that all take

    glm::ivec2 size;
    int turn;           ///< log4 of the aspect, rounded, -2..2
    glm::ivec2 behind;  ///< levels with one part along this side
    glm::ivec2 full;    ///< levels from there on until there are as many parts as texels
    int last;
};

class LightAtlas {
public:
    /// Empty where the plan needs none. Throws InputError for images that the driver's largest texture cannot
    /// hold.
    LightAtlas(const Scene& scene, const FramePlan& plan);

    /// A light's image as shaders take it: light_image_of(). All 0 without an image.
    glm::dvec4 nameOf(const Light& light) const;

    /// At a texture unit of its own.
    void bind(const gl::Program& program) const;

private:
    using Key = std::pair<int, int>;  ///< image and turn
    static Key keyOf(const Scene& scene, const Light& light);
    void upload(const Scene& scene, int width, int height);
    const Scene& scene_;
    std::map<Key, LightImageLayout> layouts_;
    std::map<Key, glm::ivec2> corners_;
    gl::Texture texture_;
};

}  // namespace lobe
