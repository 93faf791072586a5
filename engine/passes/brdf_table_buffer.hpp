/// The tables of a scene's materials on the GPU, for models that read them (common/table.glsl).
#pragma once

#include "gl/objects.hpp"
#include "gl/program.hpp"
#include "plan/plan.hpp"
#include "scene/scene.hpp"

namespace lobe {

class BrdfTableBuffer {
public:
    /// With the tables of fits that the plan asks for, which are made now unless they are kept.
    BrdfTableBuffer(const Scene& scene, const FramePlan& plan);

    /// Binds the buffer to the last texture unit that OpenGL 3.3 guarantees, if the program, which must be in
    /// use, reads it.
    void bind(const gl::Program& program) const;

private:
    gl::TextureBuffer buffer_;
};

}  // namespace lobe
