#pragma once

#include "passes/pass.hpp"

namespace lobe {

/// Adds the light of one type, or of the environment, to all surfaces: one program a model in use, masked by
/// stencil.
class LightPass : public Pass {
public:
    LightPass(const PlannedPass& planned, FrameResources& resources, LightType type)
        : Pass(planned, resources), type_(type) {}
    void prepare() override;
    void run(const View& view) override;

protected:
    /// One model's pixels, in as many draws as the lights need. The program is in use, all but the range of
    /// lights set.
    virtual void draw(const Variant& variant, const gl::Program& shader) const = 0;
    const LightType type_;

private:
    const gl::Program& program(const Variant& variant) const;
};

/// Lights without extent.
class PunctualLightPass : public LightPass {
    using LightPass::LightPass;
    void draw(const Variant& variant, const gl::Program& shader) const override;
};

/// Lights with a body. Draws are split by lights and by points on them, so that no loop of a shader is too
/// long.
class BodyLightPass : public LightPass {
    using LightPass::LightPass;
    void draw(const Variant& variant, const gl::Program& shader) const override;
};

/// The environment. Draws are split by directions, for the same reason.
class EnvironmentPass : public LightPass {
public:
    EnvironmentPass(const PlannedPass& planned, FrameResources& resources)
        : LightPass(planned, resources, LightType::directional) {}

protected:
    void draw(const Variant& variant, const gl::Program& shader) const override;
};

}  // namespace lobe
