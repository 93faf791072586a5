#include "passes/occlusion_pass.hpp"

namespace lobe {

void OcclusionPass::prepare() {
    program_ = &resources().programs.get("pass/screen.vert", planned_.program,
                                         planned_.variants.front().defines, {});
}

void OcclusionPass::run(const View& view) {
    glBindFramebuffer(GL_FRAMEBUFFER, targets().lighting(planned_.writes.front()));
    const float background[] = {0.0f, 0.0f, 0.0f, 0.0f};
    glClearBufferfv(GL_COLOR, 0, background);
    program_->use();
    const int unit = resources().inputs.bindView(*program_, targets(), view);
    program_->set("uNormal", unit);
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, targets().texture("normal"));
    glBindSampler(static_cast<GLuint>(unit), 0);
    program_->set("uOcclusionFrame", resources().environment.frame());
    for (const Variant& variant : planned_.variants) {
        resources().inputs.setMask(plan().brdf(variant.brdf));
        resources().inputs.drawScreen(*program_);
    }
    resources().inputs.clearMask();
}

}  // namespace lobe
