/// What a light with a body costs, as a multiple of a point light over the same surfaces.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gl/context.hpp"

namespace lobe::bench {

struct AreaLightTime {
    std::string model, light, method;  ///< "lambert", "rect", "analytic" or "sampled 16" or "shadowed 16"
    double point = 0.0;                ///< a point light without shadow, ns a pixel of processor time
    double body = 0.0;                 ///< this light
    double ratio = 0.0;                ///< body / point
};

/// Light passes over balls on a floor, one model at a time, in turn; what a pass costs by itself is taken
/// off. `done` is called with each result.
std::vector<AreaLightTime> areaLightTimes(gl::Context& context, int width, int height, int rounds,
                                          const std::function<void(const AreaLightTime&)>& done);

}  // namespace lobe::bench
