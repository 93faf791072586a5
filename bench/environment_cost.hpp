/// What the environment's lighting pass costs against that of one point light.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gl/context.hpp"
#include "scene/scene.hpp"

namespace lobe::bench {

struct EnvironmentCost {
    std::string model, method;
    double point = 0.0, environment = 0.0;  ///< ns a pixel of the picture, least of the rounds
};

/// Nine balls on a floor, without shadows, one sample a pixel; both passes in one frame.
std::vector<EnvironmentCost> environmentCosts(gl::Context& context, const Bitmap& panorama, int rounds,
                                              const std::function<void(const EnvironmentCost&)>& done);

}  // namespace lobe::bench
