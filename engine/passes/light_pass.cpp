#include "passes/light_pass.hpp"

#include <algorithm>

#include "passes/material_glsl.hpp"

namespace lobe {

const gl::Program& LightPass::program(const Variant& variant) const {
    return resources().programs.get("pass/screen.vert", planned_.program, variant.defines,
                                    screenMaterialGlsl(plan(), *plan().brdf(variant.brdf)));
}

void LightPass::prepare() {
    for (const Variant& variant : planned_.variants)
        program(variant);
}

void LightPass::run(const View& view) {
    static constexpr const char* kNames[] = {"Directional", "Point", "Spot"};
    const std::string name = kNames[static_cast<size_t>(type_)];
    const std::string channel = planned_.writes.front();
    glBindFramebuffer(GL_FRAMEBUFFER, targets().lighting(channel));
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    for (const Variant& variant : planned_.variants) {
        const PlannedBrdf& brdf = *plan().brdf(variant.brdf);
        const gl::Program& shader = program(variant);
        shader.use();
        int unit = resources().inputs.bind(shader, targets(), view, brdf);
        unit = resources().rays.bind(shader, unit, view);
        resources().lights.bind(shader, unit);
        resources().inputs.setMask(&brdf);
        if (variant.defines.contains("TILES")) {
            const LightBuffers& lights = resources().lights;
            if (lights.tileCount(type_) > 0)
                resources().inputs.drawTiles(shader, targets(), lights.tileArray(type_),
                                             lights.tileCount(type_));
            continue;
        }
        const int count = resources().lights.globalCount(type_);
        const int each =
            plan().shadowOf(type_) == PlannedShadow::rays ? kLightsPerDrawOfRays : kLightsPerDraw;
        for (int first = 0; first < count; first += each) {
            shader.set("u" + name + "First", first);
            shader.set("u" + name + "End", std::min(count, first + each));
            resources().inputs.drawScreen(shader);
        }
    }
    resources().inputs.clearMask();
    glDisable(GL_BLEND);
}

}  // namespace lobe
