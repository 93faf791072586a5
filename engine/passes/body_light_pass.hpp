#pragma once

#include "passes/pass.hpp"

namespace lobe {

/// Adds the light of bodies of one type to all surfaces: one program a model in use, masked by stencil. Draws
/// are split by lights and by points on them, so that no loop of a shader is too long.
class BodyLightPass : public Pass {
public:
    BodyLightPass(const PlannedPass& planned, FrameResources& resources, LightType type)
        : Pass(planned, resources), type_(type) {}
    void prepare() override;
    void run(const View& view) override;

private:
    const gl::Program& program(const Variant& variant) const;
    void draw(const Variant& variant, const gl::Program& shader) const;
    LightType type_;
};

}  // namespace lobe
