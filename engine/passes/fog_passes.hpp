/// Fog over the opaque picture.
#pragma once

#include "passes/pass.hpp"

namespace lobe {

/// What fog takes from each surface and the background, and its own radiance.
class FogPass : public Pass {
public:
    using Pass::Pass;
    void prepare() override;
    void run(const View& view) override;

private:
    void draw(const Variant& variant, const std::string& target, const View& view) const;
};

/// The light of point and spot lights that fog scatters to the eye.
class AirlightPass : public Pass {
public:
    using Pass::Pass;
    void prepare() override;
    void run(const View& view) override;
};

}  // namespace lobe
