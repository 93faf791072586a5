/// Finds the blended fragments of each pixel one after the other, from the farthest (Everitt, Interactive
/// order-independent transparency, 2001, from behind).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "passes/pass.hpp"

namespace lobe {

class LayerPeeler {
public:
    /// `planned`: the plan's pass "peel". Compiles its programs.
    LayerPeeler(const PlannedPass& planned, FrameResources& resources);

    /// Before the first layer: the opaque surfaces are complete.
    void start();
    /// Finds the next layer in front of the last; whether there is one in any pixel.
    bool next(const View& view);
    /// Draws into colour targets with the depth of the layer found last, to be tested for equality.
    GLuint framebuffer(const std::vector<std::string>& colors);
    /// Puts a layer's keys where pass/peel.glsl reads them: the one found last, or, to draw all that is in
    /// front of it, the one before.
    void bindLayer(const gl::Program& program, bool last = true) const;

private:
    const PlannedPass& planned_;
    FrameResources& resources_;
    gl::Texture layers_[2], depth_;
    gl::Framebuffer framebuffers_[2];
    std::map<std::vector<std::string>, gl::Framebuffer> drawing_;
    gl::Query query_;
    const gl::Program* startProgram_;
    size_t current_ = 0;  ///< of layers_: the one found last
};

}  // namespace lobe
