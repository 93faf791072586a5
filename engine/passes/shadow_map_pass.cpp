#include "passes/shadow_map_pass.hpp"

#include "passes/shadow_maps.hpp"

namespace lobe {

void ShadowMapPass::prepare() {
    resources().surfaces.prepareCasters(planned_);
}

void ShadowMapPass::run(const View& view) {
    const std::vector<PlacedShadowMap> maps = resources().shadowMaps.update(view);
    if (maps.empty()) return;
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    glClearDepth(0.0);
    glDisable(GL_BLEND);
    glEnable(GL_SCISSOR_TEST);
    for (const auto& [projection, tile] : maps) {
        resources().shadowMaps.bindForDrawing(tile.layer);
        glViewport(tile.x, tile.y, tile.size, tile.size);
        glScissor(tile.x, tile.y, tile.size, tile.size);
        glClear(GL_DEPTH_BUFFER_BIT);
        if (projection.empty) continue;
        View light = shadowView(projection, tile.size);
        // Without clip control depths from 0 to 1 are clip coordinates from -1 to 1.
        if (!plan().reversedDepth) {
            glm::dmat4 stretched(1.0);
            stretched[2][2] = 2.0;
            stretched[3][2] = -1.0;
            light.clipFromRelative = stretched * light.clipFromRelative;
        }
        const float reach = projection.perspective ? static_cast<float>(projection.reach) : 0.0f;
        resources().surfaces.drawCasters(planned_, light,
                                         [&](const gl::Program& program) { program.set("uReach", reach); });
    }
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glViewport(0, 0, targets().width(), targets().height());
}

}  // namespace lobe
