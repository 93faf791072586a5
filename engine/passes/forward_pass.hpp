#pragma once

#include <memory>
#include <vector>

#include "passes/layer_peeler.hpp"
#include "passes/pass.hpp"

namespace lobe {

/// Surfaces with all their light in one go: blended ones, back to front or layer by layer; with forward
/// shading the opaque ones before them.
class ForwardPass : public Pass {
public:
    using Pass::Pass;
    void prepare() override;
    void run(const View& view) override;

private:
    /// Programs that draw into the same targets at once.
    struct Group {
        std::vector<std::string> targets;
        PlannedPass part;  ///< the plan's pass with their variants alone
        gl::Framebuffer framebuffer;
        bool colored = false;  ///< what shows through is multiplied by the second output
    };
    Group& group(std::vector<Group>& groups, const Variant& variant);
    void draw(Group& group, const View& view, SurfaceOrder order, bool rest);
    void drawSorted(const View& view);
    void drawPeeled(const View& view);

    std::vector<Group> opaque_, blended_;
    std::unique_ptr<LayerPeeler> peeler_;
};

}  // namespace lobe
