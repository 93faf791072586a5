/// What a light's shadow costs, as a multiple of the same light without.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gl/context.hpp"
#include "scene/scene.hpp"

namespace lobe::bench {

struct ShadowTime {
    std::string scene, light, method;
    size_t triangles = 0;
    double plain =
        0.0;  ///< a light without shadow, ns a pixel of processor time, the pass's own cost taken off
    double shadowed = 0.0;  ///< with
    double ratio = 0.0;     ///< shadowed / plain
    double setUp = 0.0;     ///< ms more until the first picture: the hierarchy, and compiling unless the
                            ///< driver's cache has it
};

/// Passes of each type of light over balls on a floor, few triangles and 100,000, by each method, in turn.
/// `extra`: scenes to measure beside these. `done` is called with each result.
std::vector<ShadowTime> shadowTimes(gl::Context& context, const std::vector<Scene>& extra, int width,
                                    int height, int rounds,
                                    const std::function<void(const ShadowTime&)>& done);

}  // namespace lobe::bench
