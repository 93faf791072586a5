/// What shadow maps cost and how wrong they are, by their size and the taps of their filter.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gl/context.hpp"

namespace lobe::bench {

struct ShadowMapResult {
    std::string light;
    int size = 0, taps = 0;
    double lookUp = 0.0;  ///< a shadowed light and pixel, in unshadowed ones of the same type
    double draw = 0.0;    ///< drawing a light's map, in unshadowed lights over the picture
    double error = 0.0;   ///< mean over the pixels that the light reaches: |visibility - what rays find|
    double wrong = 0.0;   ///< share of these pixels that are off by more than a half
};

/// A ball of 18,000 triangles over a plane, each type of light, shadow maps of each size with each number of
/// taps; compared with rays in double through the pixels' centres. `done` is called with each.
std::vector<ShadowMapResult> shadowMapResults(gl::Context& context, int width, int height, int rounds,
                                              const std::function<void(const ShadowMapResult&)>& done);

}  // namespace lobe::bench
