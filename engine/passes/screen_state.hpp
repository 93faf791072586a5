/// State and uniforms that all passes over the screen share.
#pragma once

#include "gl/program.hpp"
#include "passes/brdf_table_buffer.hpp"
#include "passes/targets.hpp"
#include "plan/plan.hpp"
#include "scene/camera.hpp"
#include "scene/scene.hpp"

namespace lobe {

/// What a screen pass reads: the G-buffer, the material table, the view.
class ScreenInputs {
public:
    ScreenInputs(const Scene& scene, const FramePlan& plan, const BrdfTableBuffer& tables);

    /// Sets the G-buffer's samplers, the view and the parameters that are the same for all the model's
    /// materials. Uses texture units from 0; returns the first free one.
    int bind(const gl::Program& program, const Targets& targets, const View& view,
             const PlannedBrdf& brdf) const;

    /// The depth of surfaces and the view, of bind().
    int bindView(const gl::Program& program, const Targets& targets, const View& view) const;

    /// Draws only where a surface was stored, and only the model's pixels if the scene has several.
    void setMask(const PlannedBrdf* brdf) const;
    /// Draws only where none was.
    void setBackgroundMask() const;
    void clearMask() const;

    /// One triangle over all; the program must be made with pass/screen.vert.
    void drawScreen(const gl::Program& program) const;
    /// The same, tile by tile.
    void drawTiles(const gl::Program& program, const Targets& targets, const gl::VertexArray& tiles,
                   int count) const;

private:
    float farDepth() const { return plan_.reversedDepth ? 0.0f : 1.0f; }

    const Scene& scene_;
    const FramePlan& plan_;
    const BrdfTableBuffer& tables_;
    gl::TextureBuffer materials_;
    gl::VertexArray empty_;
};

}  // namespace lobe
