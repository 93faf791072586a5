/// Draws a scene's surfaces: geometry and materials on the GPU, and the order in which they are drawn. Shared
/// by the G-buffer and the forward pass.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "passes/brdf_table_buffer.hpp"
#include "passes/gpu_textures.hpp"
#include "passes/program_cache.hpp"
#include "plan/plan.hpp"
#include "scene/camera.hpp"
#include "scene/scene.hpp"

namespace lobe {

enum class SurfaceOrder { byProgram, backToFront, byScene };

class SurfaceDraws {
public:
    SurfaceDraws(const Scene& scene, const FramePlan& plan, const Capabilities& capabilities,
                 ProgramCache& programs, const BrdfTableBuffer& tables);

    /// Compiles the programs of a pass and uploads what they read, so that the first picture's time is its
    /// own.
    void prepare(const PlannedPass& pass);

    /// Draws every instance whose surface is among the pass's variants and whose bound is in view.
    /// `perProgram` sets a pass's own uniforms after a program is put in use. Stencil reference: the model's
    /// mask value.
    void draw(const PlannedPass& pass, const View& view, SurfaceOrder order,
              const std::function<void(const gl::Program&, const Variant&)>& perProgram);

    /// Compiles and uploads for drawCasters().
    void prepareCasters(const PlannedPass& pass);
    /// Draws the depth of what casts shadows and is among the pass's variants, both sides of it.
    void drawCasters(const PlannedPass& pass, const View& view,
                     const std::function<void(const gl::Program&)>& perProgram);

    /// Before passes are made anew: programs are found by the places of their variants.
    void forgetVariants() { compiled_.clear(); }

    /// Gives the uploaded textures away, or takes them (GpuTextures::adopt).
    GpuTextures& textures() { return textures_; }

private:
    struct Geometry {
        gl::VertexArray vertexArray;
        gl::Buffer vertices, indices;
        GLsizei indexCount = 0;
        glm::dvec3 center{0.0};
        double radius = 0.0;
    };
    struct Item {
        int instance = 0;
        int surface = 0;
        double depth = 0.0;
    };
    const Geometry& geometry(int primitive);
    const gl::Program& casterProgram(const PlannedPass& pass, const Variant& variant);
    void useMaterial(const gl::Program& program, const Variant& variant, int material);
    const Variant* variantOf(const PlannedPass& pass, int surface) const;
    const gl::Program& program(const PlannedPass& pass, const Variant& variant);

    const Scene& scene_;
    const FramePlan& plan_;
    ProgramCache& programs_;
    const BrdfTableBuffer& tables_;
    GpuTextures textures_;
    std::map<int, Geometry> geometry_;
    std::vector<int> surfaceOfInstance_;
    std::vector<int> firstTriangles_;  ///< of each instance, counting all of the scene
    std::map<const Variant*, const gl::Program*> compiled_;
};

}  // namespace lobe
