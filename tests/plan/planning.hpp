/// What tests of the plan share.
#pragma once

#include <set>
#include <string>

#include "plan/plan.hpp"
#include "support/scenes.hpp"

namespace lobe::test {

/// Of a driver that has all that Lobe makes use of.
inline Capabilities modern() {
    Capabilities capabilities;
    capabilities.clipControl = true;
    capabilities.maxTextureSize = 16384;
    capabilities.maxArrayLayers = 2048;
    capabilities.maxTextureBufferTexels = 1 << 27;
    return capabilities;
}

inline FramePlan planOf(const Scene& scene, const Quality& quality = {},
                        const AovSet& aovs = {Aov::radiance}) {
    return planFrame(summarise(scene), quality, modern(), aovs);
}

/// Why something was left out; empty if it was not.
inline std::string reasonFor(const FramePlan& plan, const std::string& name) {
    for (const LeftOut& leftOut : plan.leftOut)
        if (leftOut.name == name) return leftOut.reason;
    return {};
}

/// Defines of all programs of the plan.
inline std::set<std::string> definesOf(const FramePlan& plan) {
    std::set<std::string> all;
    for (const PlannedPass& pass : plan.passes)
        for (const Variant& variant : pass.variants)
            for (const auto& [key, value] : variant.defines)
                all.insert(key);
    return all;
}

}  // namespace lobe::test
