#pragma once

#include "passes/pass.hpp"

namespace lobe {

/// Adds the light of one type to all surfaces: one program a model in use, masked by stencil.
class LightPass : public Pass {
public:
    LightPass(const PlannedPass& planned, FrameResources& resources, LightType type)
        : Pass(planned, resources), type_(type) {}
    void prepare() override;
    void run(const View& view) override;

private:
    const gl::Program& program(const Variant& variant) const;
    LightType type_;
};

}  // namespace lobe
