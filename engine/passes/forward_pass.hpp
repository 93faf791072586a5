#pragma once

#include "passes/pass.hpp"

namespace lobe {

/// Surfaces with all their light in one go: blended ones, back to front; with forward shading the opaque ones
/// before them.
class ForwardPass : public Pass {
public:
    using Pass::Pass;
    void prepare() override;
    void run(const View& view) override;

private:
    void draw(const View& view, bool blended);
    PlannedPass opaque_, blended_;  ///< the plan's pass, split by how its surfaces are drawn
};

}  // namespace lobe
