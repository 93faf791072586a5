#include "passes/fog_passes.hpp"

#include <algorithm>

#include "passes/fog_uniforms.hpp"

namespace lobe {
namespace {

const gl::Program& programOf(const FrameResources& resources, const PlannedPass& pass,
                             const Variant& variant) {
    return resources.programs.get("pass/screen.vert", pass.program, variant.defines, {});
}

/// Draws where surfaces are, or, of variants for the background, where none is.
void maskFor(const FrameResources& resources, const PlannedPass& pass, const Variant& variant) {
    if (!variant.defines.contains("FOG_BACKGROUND"))
        resources.inputs.setMask(nullptr);
    else if (!pass.reads.empty())
        resources.inputs.setBackgroundMask();
    else
        resources.inputs.clearMask();  // no surface has been drawn yet: all is background
}

}  // namespace

void FogPass::prepare() {
    for (const Variant& variant : planned_.variants)
        programOf(resources(), planned_, variant);
}

void FogPass::draw(const Variant& variant, const std::string& target, const View& view) const {
    glBindFramebuffer(GL_FRAMEBUFFER, targets().lighting(target));
    const gl::Program& program = programOf(resources(), planned_, variant);
    program.use();
    resources().inputs.bindView(program, targets(), view);
    setFog(program, resources().scene, view);
    maskFor(resources(), planned_, variant);
    resources().inputs.drawScreen(program);
}

void FogPass::run(const View& view) {
    glEnable(GL_BLEND);
    for (const Variant& variant : planned_.variants) {
        // Coverage stays that of surfaces.
        if (variant.defines.contains("FOG_DIMS")) {
            glBlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
            for (size_t i = 1; i < planned_.writes.size(); ++i)
                draw(variant, planned_.writes[i], view);
        } else {
            glBlendFuncSeparate(GL_ONE, GL_SRC1_COLOR, GL_ZERO, GL_ONE);
            draw(variant, planned_.writes.front(), view);
        }
    }
    resources().inputs.clearMask();
    glDisable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ZERO);  // several targets may not even be set to blend with two outputs
}

void AirlightPass::prepare() {
    for (const Variant& variant : planned_.variants)
        programOf(resources(), planned_, variant);
}

void AirlightPass::run(const View& view) {
    glBindFramebuffer(GL_FRAMEBUFFER, targets().lighting(planned_.writes.front()));
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_ONE);
    const LightBuffers& lights = resources().lights;
    for (const Variant& variant : planned_.variants) {
        const gl::Program& program = programOf(resources(), planned_, variant);
        program.use();
        const int unit = resources().inputs.bindView(program, targets(), view);
        lights.bind(program, unit);
        setAirlight(program, resources().scene, plan(), lights);
        maskFor(resources(), planned_, variant);
        const bool points = variant.defines.contains("AIRLIGHT_POINTS");
        const std::string name = points ? "uAirlightPoint" : "uAirlightSpot";
        const int count = lights.count(points ? LightType::point : LightType::spot);
        const int perDraw = std::max(1, kLightsPerDraw / plan().airlightNodes);
        for (int first = 0; first < count; first += perDraw) {
            program.set(name + "First", first);
            program.set(name + "End", std::min(count, first + perDraw));
            resources().inputs.drawScreen(program);
        }
    }
    resources().inputs.clearMask();
    glDisable(GL_BLEND);
}

}  // namespace lobe
