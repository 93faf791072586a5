/// What is in the way of the environment, as the depth buffer shows it.
#pragma once

#include "passes/pass.hpp"

namespace lobe {

class OcclusionPass : public Pass {
public:
    using Pass::Pass;
    void prepare() override;
    void run(const View& view) override;

private:
    const gl::Program* program_ = nullptr;
};

}  // namespace lobe
