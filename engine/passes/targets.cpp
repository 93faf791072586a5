#include "passes/targets.hpp"

namespace lobe {

GLenum formatOf(const std::string& name) {
    static const std::map<std::string, GLenum> formats = {{"R8", GL_R8},
                                                          {"RG8", GL_RG8},
                                                          {"RGBA8", GL_RGBA8},
                                                          {"R16", GL_R16},
                                                          {"RG16", GL_RG16},
                                                          {"RGBA16", GL_RGBA16},
                                                          {"R32F", GL_R32F},
                                                          {"RG32F", GL_RG32F},
                                                          {"RGBA16F", GL_RGBA16F},
                                                          {"RGBA32F", GL_RGBA32F},
                                                          {"R8UI", GL_R8UI},
                                                          {"R16UI", GL_R16UI},
                                                          {"R32UI", GL_R32UI},
                                                          {"DEPTH_COMPONENT24", GL_DEPTH_COMPONENT24},
                                                          {"DEPTH_COMPONENT32F", GL_DEPTH_COMPONENT32F},
                                                          {"DEPTH24_STENCIL8", GL_DEPTH24_STENCIL8},
                                                          {"DEPTH32F_STENCIL8", GL_DEPTH32F_STENCIL8}};
    return formats.at(name);
}

Targets::Targets(const FramePlan& plan, int width, int height) : width_(width), height_(height) {
    for (const Channel& channel : plan.channels) {
        // Those that are accumulated have one each, made below; layers belong to their pass, shadow maps have
        // a size of their own.
        if (channel.name == "accumulated" || channel.name.starts_with("layer")) continue;
        if (channel.name == "shadow.maps") continue;
        textures_.emplace(channel.name, gl::makeTarget(formatOf(channel.format), width, height));
    }
    std::vector<std::string> pictures;
    for (const std::string& name : plan.contributionTargets)
        pictures.push_back("contribution." + name);
    pictures.emplace_back("radiance");
    if (plan.samples > 1)
        for (const std::string& picture : pictures)
            textures_.emplace("accumulated." + picture, gl::makeTarget(GL_RGBA32F, width, height));

    const GLenum depthFormat = formatOf(plan.channel("depth")->format);
    stencil_ = plan.masked;
    const GLenum attachment = stencil_ ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
    const GLuint depth = texture("depth");
    const auto ids = [this](const std::vector<std::string>& names) {
        std::vector<GLuint> result;
        for (const std::string& name : names)
            result.push_back(texture(name));
        return result;
    };
    if (plan.pass("gbuffer") != nullptr)
        gbuffer_ = gl::makeFramebuffer(ids(plan.gbufferTargets), depth, attachment);

    // Linear z is a texture of its own, so the depth buffer itself can mask; otherwise it is sampled and
    // needs a copy.
    copies_ = plan.reversedDepth && plan.pass("gbuffer") != nullptr;
    if (copies_) {
        mask_ = gl::makeTarget(depthFormat, width, height);
        maskOnly_ = gl::makeFramebuffer({}, mask_.id(), attachment);
    }
    const GLuint mask = copies_ ? mask_.id() : depth;
    if (has("ambient_occlusion")) pictures.emplace_back("ambient_occlusion");
    for (const std::string& picture : pictures)
        lighting_.emplace(picture, gl::makeFramebuffer({texture(picture)}, mask, attachment));
    if (!plan.dataTargets.empty()) data_ = gl::makeFramebuffer(ids(plan.dataTargets), mask, attachment);
    if (const PlannedPass* forward = plan.pass("forward"))
        forward_ = gl::makeFramebuffer(ids(forward->writes), depth, attachment);
    for (const auto& [name, target] : textures_)
        if (name != "depth") single_.emplace(name, gl::makeFramebuffer({target.id()}, 0, attachment));
}

void Targets::copyMask() const {
    if (!copies_) return;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, gbuffer_.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, maskOnly_.id());
    const GLbitfield what = GL_DEPTH_BUFFER_BIT | (stencil_ ? GL_STENCIL_BUFFER_BIT : 0u);
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, what, GL_NEAREST);
}

}  // namespace lobe
