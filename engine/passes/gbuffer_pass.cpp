#include "passes/gbuffer_pass.hpp"

#include <cmath>

namespace lobe {

void GbufferPass::prepare() {
    resources().surfaces.prepare(planned_);
}

void GbufferPass::run(const View& view) {
    glBindFramebuffer(GL_FRAMEBUFFER, targets().gbuffer());
    // Only what is read where no surface is drawn needs clearing: depth, and radiance where it is among the
    // targets.
    glClearDepth(plan().reversedDepth ? 0.0 : 1.0);
    glClearStencil(0);
    glDepthMask(GL_TRUE);
    glStencilMask(0xff);
    glClear(GL_DEPTH_BUFFER_BIT | (plan().masked ? GL_STENCIL_BUFFER_BIT : 0u));
    const float beyond[] = {HUGE_VALF, 0.0f, 0.0f, 0.0f};
    const float black[] = {0.0f, 0.0f, 0.0f, 0.0f};
    for (size_t i = 0; i < plan().gbufferTargets.size(); ++i) {
        const std::string& target = plan().gbufferTargets[i];
        if (target == "radiance" || target.starts_with("contribution."))
            glClearBufferfv(GL_COLOR, static_cast<GLint>(i), black);
        if (target == "linear_z" && plan().occlusionSlices > 0)
            glClearBufferfv(GL_COLOR, static_cast<GLint>(i), beyond);  // looked at beside surfaces too
    }
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(plan().reversedDepth ? GL_GREATER : GL_LESS);
    glDisable(GL_BLEND);
    if (plan().masked) {
        glEnable(GL_STENCIL_TEST);
        glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    }
    resources().surfaces.draw(
        planned_, view, SurfaceOrder::byProgram, [&](const gl::Program& program, const Variant&) {
            program.set("uForward", glm::vec3(view.forward));
            program.set("uAmbientRadiance",
                        glm::vec3(resources().scene.ambientRadiance.value_or(glm::dvec3(0.0))));
        });
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    targets().copyMask();
}

}  // namespace lobe
