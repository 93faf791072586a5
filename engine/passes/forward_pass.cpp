#include "passes/forward_pass.hpp"

#include "passes/fog_uniforms.hpp"

namespace lobe {
namespace {

/// Above the units that a material's textures take (at most 8 slots).
constexpr int kFirstLightUnit = 8;

/// `alpha` and the like of what is blended: "behind" times what shows through, plus the surface's own.
void setBlending(bool colored) {
    glEnable(GL_BLEND);
    if (colored)
        glBlendFuncSeparate(GL_ONE, GL_SRC1_COLOR, GL_ONE, GL_SRC1_ALPHA);
    else
        glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

}  // namespace

ForwardPass::Group& ForwardPass::group(std::vector<Group>& groups, const Variant& variant) {
    const auto only = variant.defines.find("ONLY_TARGET");
    const std::vector<std::string> names =
        only == variant.defines.end()
            ? planned_.writes
            : std::vector<std::string>{planned_.writes[static_cast<size_t>(std::stoi(only->second))]};
    for (Group& candidate : groups)
        if (candidate.targets == names) return candidate;
    Group& made = groups.emplace_back();
    made.targets = names;
    made.part = planned_;
    made.part.variants.clear();
    made.colored = variant.defines.contains("COLORED_TRANSMITTANCE");
    std::vector<GLuint> ids;
    for (const std::string& name : names)
        ids.push_back(targets().texture(name));
    made.framebuffer = gl::makeFramebuffer(ids, targets().texture("depth"), targets().depthAttachment());
    return made;
}

void ForwardPass::prepare() {
    for (const Variant& variant : planned_.variants) {
        const bool blend = plan().surfaces[static_cast<size_t>(variant.surface)].blended();
        group(blend ? blended_ : opaque_, variant).part.variants.push_back(variant);
    }
    for (std::vector<Group>* groups : {&opaque_, &blended_})
        for (const Group& one : *groups)
            resources().surfaces.prepare(one.part);
    if (const PlannedPass* peel = plan().pass("peel"))
        peeler_ = std::make_unique<LayerPeeler>(*peel, resources());
}

void ForwardPass::draw(Group& group, const View& view, SurfaceOrder order, bool rest) {
    resources().surfaces.draw(
        group.part, view, order, [&](const gl::Program& program, const Variant& variant) {
            const Scene& scene = resources().scene;
            program.set("uForward", glm::vec3(view.forward));
            program.set("uRayDirection", glm::vec3(view.rayDirection));
            program.set("uRayDirectionDx", glm::vec3(view.rayDirectionDx));
            program.set("uRayDirectionDy", glm::vec3(view.rayDirectionDy));
            program.set("uAmbientRadiance", glm::vec3(scene.ambientRadiance.value_or(glm::dvec3(0.0))));
            int unit = resources().rays.bind(program, kFirstLightUnit, view);
            unit = resources().lights.bind(program, unit);
            unit = resources().bodies.bind(program, unit, plan().areaPointsForward);
            resources().environment.bind(program, unit, variant.brdf, plan().environmentSamplesForward);
            resources().shadowMaps.bind(program);
            if (scene.fog) {
                program.set("uRayOrigin", glm::vec3(view.rayOrigin));
                program.set("uRayOriginDx", glm::vec3(view.rayOriginDx));
                program.set("uRayOriginDy", glm::vec3(view.rayOriginDy));
                setFog(program, scene, view);
                if (plan().airlightNodes > 0) setAirlight(program, scene, plan(), resources().lights);
            }
            if (peeler_) {
                peeler_->bindLayer(program, !rest);
                program.set("uPeelRest", rest ? 1 : 0);
            }
        });
}

void ForwardPass::drawSorted(const View& view) {
    for (Group& group : blended_) {
        glBindFramebuffer(GL_FRAMEBUFFER, group.framebuffer.id());
        setBlending(group.colored);
        draw(group, view, SurfaceOrder::backToFront, false);
    }
}

void ForwardPass::drawPeeled(const View& view) {
    peeler_->start();
    int layers = 0;
    while (peeler_->next(view)) {
        const bool rest = layers++ == plan().mostLayers;
        for (Group& group : blended_) {
            glBindFramebuffer(GL_FRAMEBUFFER, peeler_->framebuffer(group.targets));
            setBlending(group.colored);
            if (rest) {
                glDisable(GL_DEPTH_TEST);  // all that is in front of the last layer
                resources().remarks.insert(
                    "more than " + std::to_string(plan().mostLayers) +
                    " layers of blended surfaces in a pixel: those nearer to the eye are "
                    "in order by object only");
                draw(group, view, SurfaceOrder::backToFront, true);
                continue;
            }
            glEnable(GL_DEPTH_TEST);
            glDepthFunc(GL_EQUAL);
            draw(group, view, SurfaceOrder::byProgram, false);
        }
        if (rest) break;
    }
}

void ForwardPass::run(const View& view) {
    glDepthMask(GL_TRUE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(plan().reversedDepth ? GL_GREATER : GL_LESS);
    // Without opaque surfaces that went before, nothing has cleared the depth.
    if (!opaque_.empty() || plan().pass("gbuffer") == nullptr) {
        glBindFramebuffer(GL_FRAMEBUFFER, targets().forward());
        glClearDepth(plan().reversedDepth ? 0.0 : 1.0);
        glClear(GL_DEPTH_BUFFER_BIT);
    }
    if (targets().has("transmittance")) {
        const float clear[] = {1.0f, 1.0f, 1.0f, 1.0f};
        glBindFramebuffer(GL_FRAMEBUFFER, targets().single("transmittance"));
        glClearBufferfv(GL_COLOR, 0, clear);
    }
    glDisable(GL_BLEND);
    for (Group& group : opaque_) {
        glBindFramebuffer(GL_FRAMEBUFFER, group.framebuffer.id());
        draw(group, view, SurfaceOrder::byProgram, false);
    }
    glDepthMask(GL_FALSE);
    if (peeler_)
        drawPeeled(view);
    else
        drawSorted(view);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ZERO);  // several targets may not even be set to blend with two outputs
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
}

}  // namespace lobe
