#include "passes/body_light_pass.hpp"

#include <algorithm>

#include "passes/material_glsl.hpp"

namespace lobe {

const gl::Program& BodyLightPass::program(const Variant& variant) const {
    return resources().programs.get("pass/screen.vert", planned_.program, variant.defines,
                                    screenMaterialGlsl(plan(), *plan().brdf(variant.brdf)));
}

void BodyLightPass::prepare() {
    for (const Variant& variant : planned_.variants)
        program(variant);
}

void BodyLightPass::draw(const Variant& variant, const gl::Program& shader) const {
    if (variant.defines.contains("MIRRORED_LIGHTS")) return resources().inputs.drawScreen(shader);
    const bool rays =
        variant.defines.contains("AREA_SHADOWS") || variant.defines.contains("AREA_HARD_SHADOWS");
    const int most = rays ? kRaysPerDraw : kPointsPerDraw;
    const int points = variant.defines.contains("AREA_SAMPLED") ? plan().areaPoints : 1;
    const int pointsEach = std::min(points, most);
    const int lightsEach = most / pointsEach;
    const int count = resources().bodies.count(type_);
    for (int first = 0; first < count; first += lightsEach) {
        BodyLights::setLights(shader, type_, first, std::min(count, first + lightsEach));
        for (int from = 0; from < points; from += pointsEach) {
            BodyLights::setPoints(shader, from, std::min(points, from + pointsEach), points);
            resources().inputs.drawScreen(shader);
        }
    }
}

void BodyLightPass::run(const View& view) {
    glBindFramebuffer(GL_FRAMEBUFFER, targets().lighting(planned_.writes.front()));
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    for (const Variant& variant : planned_.variants) {
        const PlannedBrdf& brdf = *plan().brdf(variant.brdf);
        const gl::Program& shader = program(variant);
        shader.use();
        int unit = resources().inputs.bind(shader, targets(), view, brdf);
        unit = resources().rays.bind(shader, unit, view);
        resources().bodies.bind(shader, unit, plan().areaPoints);
        resources().inputs.setMask(&brdf);
        draw(variant, shader);
    }
    resources().inputs.clearMask();
    glDisable(GL_BLEND);
}

}  // namespace lobe
