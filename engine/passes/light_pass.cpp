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
    glBindFramebuffer(GL_FRAMEBUFFER, targets().lighting(planned_.writes.front()));
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    for (const Variant& variant : planned_.variants) {
        const PlannedBrdf& brdf = *plan().brdf(variant.brdf);
        const gl::Program& shader = program(variant);
        shader.use();
        int unit = resources().inputs.bind(shader, targets(), view, brdf);
        unit = resources().rays.bind(shader, unit, view);
        unit = resources().lights.bind(shader, unit);
        unit = resources().bodies.bind(shader, unit, plan().areaPoints);
        resources().environment.bind(shader, unit, variant.brdf, plan().environmentSamples);
        resources().shadowMaps.bind(shader);
        resources().inputs.setMask(&brdf);
        draw(variant, shader);
    }
    resources().inputs.clearMask();
    glDisable(GL_BLEND);
}

void PunctualLightPass::draw(const Variant& variant, const gl::Program& shader) const {
    static constexpr const char* kNames[] = {"Directional", "Point", "Spot"};
    const LightBuffers& lights = resources().lights;
    if (variant.defines.contains("TILES")) {
        if (lights.tileCount(type_) > 0)
            resources().inputs.drawTiles(shader, targets(), lights.tileArray(type_), lights.tileCount(type_));
        return;
    }
    const std::string name = kNames[static_cast<size_t>(type_)];
    const int count = lights.globalCount(type_);
    const int each = plan().shadowOf(type_) == PlannedShadow::rays ? kLightsPerDrawOfRays : kLightsPerDraw;
    for (int first = 0; first < count; first += each) {
        shader.set("u" + name + "First", first);
        shader.set("u" + name + "End", std::min(count, first + each));
        resources().inputs.drawScreen(shader);
    }
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

void EnvironmentPass::draw(const Variant& variant, const gl::Program& shader) const {
    if (!variant.defines.contains("ENVIRONMENT_SAMPLED")) return resources().inputs.drawScreen(shader);
    const int pairs = EnvironmentLight::pairsOf(plan().environmentSamples);
    const int each =
        std::max(1, (variant.defines.contains("ENVIRONMENT_SHADOWS") ? kRaysPerDraw : kPointsPerDraw) / 2);
    for (int first = 0; first < pairs; first += each) {
        EnvironmentLight::setPairs(shader, first, std::min(pairs, first + each));
        resources().inputs.drawScreen(shader);
    }
}

}  // namespace lobe
