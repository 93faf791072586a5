/// The textures and framebuffers that a plan's channels become at one size.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gl/objects.hpp"
#include "plan/plan.hpp"

namespace lobe {

class Targets {
public:
    /// Throws ContextError if the driver cannot draw into a combination of formats.
    Targets(const FramePlan& plan, int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }
    bool has(const std::string& channel) const { return textures_.contains(channel); }
    GLuint texture(const std::string& channel) const { return textures_.at(channel).id(); }

    GLuint gbuffer() const { return gbuffer_.id(); }
    GLuint data() const { return data_.id(); }
    /// Adds to one colour channel, masked by a copy of depth and stencil: the original is read as a texture
    /// meanwhile.
    GLuint lighting(const std::string& channel) const { return lighting_.at(channel).id(); }
    GLuint forward() const { return forward_.id(); }
    /// Where the depth channel is attached.
    GLenum depthAttachment() const { return stencil_ ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT; }
    /// One colour channel alone, for clearing, reading and accumulation.
    GLuint single(const std::string& channel) const { return single_.at(channel).id(); }
    /// What lies behind `lighting`'s mask; call when the G-buffer is complete.
    void copyMask() const;

private:
    int width_, height_;
    bool stencil_ = false, copies_ = false;
    std::map<std::string, gl::Texture> textures_;
    gl::Texture mask_;
    gl::Framebuffer gbuffer_, data_, forward_, maskOnly_;
    std::map<std::string, gl::Framebuffer> lighting_, single_;
};

/// GL enumerant of a format name as plans write it ("RG16", "DEPTH_COMPONENT32F").
GLenum formatOf(const std::string& name);

}  // namespace lobe
