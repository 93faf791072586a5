#pragma once

#include "passes/pass.hpp"

namespace lobe {

/// Stores the nearest opaque or masked surface of each pixel, and its emission and ambient light.
class GbufferPass : public Pass {
public:
    using Pass::Pass;
    void prepare() override;
    void run(const View& view) override;
};

}  // namespace lobe
