/// Draws the depths that lights see: once a scene, and again where a map's fit follows the camera.
#pragma once

#include "passes/pass.hpp"

namespace lobe {

class ShadowMapPass : public Pass {
public:
    using Pass::Pass;
    void prepare() override;
    void run(const View& view) override;
};

}  // namespace lobe
