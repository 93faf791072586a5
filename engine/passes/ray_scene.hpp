/// What rays in shaders need of a scene (shaders/glsl/shadow/rays.glsl), on the GPU.
#pragma once

#include "gl/objects.hpp"
#include "gl/program.hpp"
#include "scene/camera.hpp"
#include "scene/scene.hpp"

namespace lobe {

/// Made once a scene; the same for all views of it.
class RayScene {
public:
    /// Empty: nothing to bind.
    RayScene() = default;
    /// Builds and uploads the hierarchy. Throws InputError where it does not fit into memory, ContextError
    /// where it does not fit into the driver's buffers of `maxTexels`.
    RayScene(const Scene& scene, int maxTexels);

    /// Binds texture units from `firstUnit` on and sets all uniforms of rays.glsl, if the program (in use)
    /// has them. Returns the first free unit.
    int bind(const gl::Program& program, int firstUnit, const View& view) const;

    /// How far a surface's drawn positions may be off it: m, and per metre from the eye. Ways start so far
    /// above it.
    glm::dvec2 positionError(const View& view) const;

    /// Main and graphics memory that it takes, bytes.
    size_t bytes() const { return bytes_; }

private:
    gl::TextureBuffer nodes_, triangles_, texels_;
    int opaqueNodes_ = 0, allNodes_ = 0;
    glm::dvec3 center_{0.0};
    double scale_ = 1.0;
    double error_ = 0.0;
    size_t bytes_ = 0;
};

}  // namespace lobe
