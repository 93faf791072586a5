#include "passes/screen_passes.hpp"

#include "passes/material_glsl.hpp"

namespace lobe {

void CoveragePass::prepare() {
    program_ = &resources().programs.get("pass/screen.vert", planned_.program, {}, {});
}

void CoveragePass::run(const View&) {
    glBindFramebuffer(GL_FRAMEBUFFER, targets().lighting("radiance"));
    program_->use();
    resources().inputs.setMask(nullptr);
    resources().inputs.drawScreen(*program_);
    resources().inputs.clearMask();
}

void BackgroundPass::prepare() {
    program_ = &resources().programs.get("pass/screen.vert", planned_.program, {}, {});
}

void BackgroundPass::run(const View& view) {
    glBindFramebuffer(GL_FRAMEBUFFER, targets().lighting(planned_.writes.front()));
    program_->use();
    const int unit = resources().inputs.bindView(*program_, targets(), view);
    resources().environment.bindBackground(*program_, unit);
    if (planned_.reads.empty())
        resources().inputs.clearMask();  // no surface has been drawn yet: all is background
    else
        resources().inputs.setBackgroundMask();
    resources().inputs.drawScreen(*program_);
    resources().inputs.clearMask();
}

void DimPass::prepare() {
    program_ = &resources().programs.get("pass/screen.vert", planned_.program, {}, {});
}

void DimPass::run(const View&) {
    program_->use();
    program_->set("uTransmittance", 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, targets().texture("transmittance"));
    glBindSampler(0, 0);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    for (const std::string& target : planned_.writes) {
        glBindFramebuffer(GL_FRAMEBUFFER, targets().single(target));
        resources().inputs.drawScreen(*program_);
    }
    glDisable(GL_BLEND);
}

void AccumulatePass::prepare() {
    program_ = &resources().programs.get("pass/screen.vert", planned_.program,
                                         planned_.variants.front().defines, {});
}

void AccumulatePass::run(const View&) {
    program_->use();
    program_->set("uWeight", 1.0f / static_cast<float>(resources().samples));
    program_->set("uRadiance", 0);
    glActiveTexture(GL_TEXTURE0);
    glBindSampler(0, 0);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    std::vector<std::string> pictures = {"radiance"};
    for (const std::string& name : plan().contributionTargets)
        pictures.push_back("contribution." + name);
    for (const std::string& picture : pictures) {
        glBindFramebuffer(GL_FRAMEBUFFER, targets().single("accumulated." + picture));
        glBindTexture(GL_TEXTURE_2D, targets().texture(picture));
        resources().inputs.drawScreen(*program_);
    }
    glDisable(GL_BLEND);
}

const gl::Program& AovPass::program(const Variant& variant) const {
    return resources().programs.get("pass/screen.vert", planned_.program, variant.defines,
                                    screenMaterialGlsl(plan(), *plan().brdf(variant.brdf)));
}

void AovPass::prepare() {
    for (const Variant& variant : planned_.variants)
        program(variant);
}

void AovPass::run(const View& view) {
    glBindFramebuffer(GL_FRAMEBUFFER, targets().data());
    const float zero[] = {0.0f, 0.0f, 0.0f, 0.0f};
    for (size_t i = 0; i < plan().dataTargets.size(); ++i)
        glClearBufferfv(GL_COLOR, static_cast<GLint>(i), zero);
    for (const Variant& variant : planned_.variants) {
        const PlannedBrdf& brdf = *plan().brdf(variant.brdf);
        const gl::Program& shader = program(variant);
        shader.use();
        resources().inputs.bind(shader, targets(), view, brdf);
        resources().inputs.setMask(&brdf);
        resources().inputs.drawScreen(shader);
    }
    resources().inputs.clearMask();
}

}  // namespace lobe
