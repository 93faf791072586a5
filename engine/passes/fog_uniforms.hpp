/// What programs with fog read: the medium as seen from a view, and the lamps whose light it scatters.
#pragma once

#include "gl/program.hpp"
#include "passes/light_buffers.hpp"
#include "plan/plan.hpp"
#include "scene/camera.hpp"
#include "scene/scene.hpp"

namespace lobe {

/// Uniforms of pass/fog.glsl. The program must be in use; the scene must have fog.
void setFog(const gl::Program& program, const Scene& scene, const View& view);

/// Uniforms of pass/airlight.glsl, for all lamps of the types that it loops over.
void setAirlight(const gl::Program& program, const Scene& scene, const FramePlan& plan,
                 const LightBuffers& lights);

}  // namespace lobe
