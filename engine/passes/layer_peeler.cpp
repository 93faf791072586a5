#include "passes/layer_peeler.hpp"

namespace lobe {
namespace {

/// Apart from those that are counted up from 0 for textures and lights; OpenGL 3.3 has 48 of them.
constexpr int kLayerUnit = 27;

}  // namespace

LayerPeeler::LayerPeeler(const PlannedPass& planned, FrameResources& resources)
    : planned_(planned), resources_(resources), query_(gl::Query::make()) {
    const int width = resources.targets.width(), height = resources.targets.height();
    depth_ = gl::makeTarget(GL_DEPTH_COMPONENT32F, width, height);
    for (size_t i : {size_t{0}, size_t{1}}) {
        layers_[i] = gl::makeTarget(GL_RG32UI, width, height);
        framebuffers_[i] = gl::makeFramebuffer({layers_[i].id()}, depth_.id(), GL_DEPTH_ATTACHMENT);
    }
    gl::Defines defines;
    if (!resources.plan.reversedDepth) defines["LINEAR_Z"] = "1";
    startProgram_ = &resources.programs.get("pass/screen.vert", "pass/peel_start.frag", defines, {});
    resources.surfaces.prepare(planned);
}

void LayerPeeler::start() {
    current_ = 0;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[current_].id());
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    startProgram_->use();
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, resources_.targets.texture("depth"));
    glBindSampler(0, 0);
    startProgram_->set("uDepth", 0);
    resources_.inputs.drawScreen(*startProgram_);
}

bool LayerPeeler::next(const View& view) {
    const bool reversed = resources_.plan.reversedDepth;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[1 - current_].id());
    // Pixels without another fragment keep a key that no fragment is in front of.
    const GLuint nearest[] = {0xffffffffu, 0u, 0u, 0u};
    glClearBufferuiv(GL_COLOR, 0, nearest);
    glDepthMask(GL_TRUE);
    glClearDepth(reversed ? 1.0 : 0.0);
    glClear(GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    // The farthest; at one place the last of the scene, which is behind the others there.
    glDepthFunc(reversed ? GL_LEQUAL : GL_GEQUAL);
    glDisable(GL_BLEND);
    glBeginQuery(GL_SAMPLES_PASSED, query_.id());
    resources_.surfaces.draw(planned_, view, SurfaceOrder::byScene,
                             [this](const gl::Program& program, const Variant&) { bindLayer(program); });
    glEndQuery(GL_SAMPLES_PASSED);
    GLuint passed = 0;
    glGetQueryObjectuiv(query_.id(), GL_QUERY_RESULT, &passed);
    glDepthMask(GL_FALSE);
    current_ = 1 - current_;
    return passed > 0;
}

GLuint LayerPeeler::framebuffer(const std::vector<std::string>& colors) {
    auto& framebuffer = drawing_[colors];
    if (!framebuffer) {
        std::vector<GLuint> ids;
        for (const std::string& name : colors)
            ids.push_back(resources_.targets.texture(name));
        framebuffer = gl::makeFramebuffer(ids, depth_.id(), GL_DEPTH_ATTACHMENT);
    }
    return framebuffer.id();
}

void LayerPeeler::bindLayer(const gl::Program& program, bool last) const {
    glActiveTexture(GL_TEXTURE0 + kLayerUnit);
    glBindTexture(GL_TEXTURE_2D, layers_[last ? current_ : 1 - current_].id());
    glBindSampler(kLayerUnit, 0);
    program.set("uLayer", kLayerUnit);
}

}  // namespace lobe
