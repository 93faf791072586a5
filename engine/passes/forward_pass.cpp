#include "passes/forward_pass.hpp"

namespace lobe {
namespace {

/// Above the units that a material's textures take (at most 8 slots).
constexpr int kFirstLightUnit = 8;

}  // namespace

void ForwardPass::prepare() {
    opaque_ = blended_ = planned_;
    opaque_.variants.clear();
    blended_.variants.clear();
    for (const Variant& variant : planned_.variants) {
        const bool blend =
            plan().surfaces[static_cast<size_t>(variant.surface)].alphaMode == AlphaMode::blend;
        (blend ? blended_ : opaque_).variants.push_back(variant);
    }
    resources().surfaces.prepare(opaque_);
    resources().surfaces.prepare(blended_);
}

void ForwardPass::draw(const View& view, bool blended) {
    glDepthMask(blended ? GL_FALSE : GL_TRUE);
    if (blended) {
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    } else {
        glDisable(GL_BLEND);
    }
    resources().surfaces.draw(
        blended ? blended_ : opaque_, view, blended ? SurfaceOrder::backToFront : SurfaceOrder::byProgram,
        [&](const gl::Program& program) {
            program.set("uForward", glm::vec3(view.forward));
            program.set("uRayDirection", glm::vec3(view.rayDirection));
            program.set("uRayDirectionDx", glm::vec3(view.rayDirectionDx));
            program.set("uRayDirectionDy", glm::vec3(view.rayDirectionDy));
            const auto ambient = resources().scene.ambientRadiance.value_or(glm::dvec3(0.0));
            program.set("uAmbientRadiance", glm::vec3(ambient));
            int unit = resources().rays.bind(program, kFirstLightUnit, view);
            unit = resources().lights.bind(program, unit);
            resources().bodies.bind(program, unit, plan().areaPointsForward);
        });
}

void ForwardPass::run(const View& view) {
    glBindFramebuffer(GL_FRAMEBUFFER, targets().forward());
    if (!opaque_.variants.empty()) {
        glDepthMask(GL_TRUE);
        glClearDepth(plan().reversedDepth ? 0.0 : 1.0);
        glClear(GL_DEPTH_BUFFER_BIT);
    }
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(plan().reversedDepth ? GL_GREATER : GL_LESS);
    if (!opaque_.variants.empty()) draw(view, false);
    if (!blended_.variants.empty()) draw(view, true);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
}

}  // namespace lobe
