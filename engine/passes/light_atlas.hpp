/// The images on rect lights in one texture.
#pragma once

#include <map>

#include "gl/objects.hpp"
#include "gl/program.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace lobe {

/// Each image has a rectangle of the texture: the image itself in its corner; to the right of it its halves, each beside
/// and below the one before (shaders/glsl/light/light_image.glsl).
class LightAtlas {
public:
    /// Empty where the plan needs none. Throws InputError for images that the driver's largest texture cannot hold.
    LightAtlas(const Scene& scene, const FramePlan& plan);

    /// Corner and size, in texels, of an image (index into Scene::images) itself.
    glm::dvec4 place(int image) const { return places_.at(image); }

    /// At a texture unit of its own.
    void bind(const gl::Program& program) const;

private:
    std::map<int, glm::dvec4> places_;
    gl::Texture texture_;
};

}  // namespace lobe
