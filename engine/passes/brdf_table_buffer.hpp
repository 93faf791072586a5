/// The tables of a scene's materials on the GPU, for models that read them (common/table.glsl).
#pragma once

#include "gl/objects.hpp"
#include "gl/program.hpp"
#include "scene/scene.hpp"

namespace lobe {

class BrdfTableBuffer {
public:
    explicit BrdfTableBuffer(const Scene& scene);

    /// Binds the buffer to the last texture unit that OpenGL 3.3 guarantees, if the program, which must be in
    /// use, reads it.
    void bind(const gl::Program& program) const;

private:
    gl::TextureBuffer buffer_;
};

}  // namespace lobe
