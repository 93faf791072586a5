/// What fog, airlight and the order of blended surfaces cost a pixel.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gl/context.hpp"
#include "measure/statistics.hpp"

namespace lobe::bench {

/// A picture against the same picture without what is measured.
struct FogCost {
    std::string name;
    std::string base;            ///< what it is compared with
    double perPixel = 0.0;       ///< ns a pixel more than the base, median of the rounds
    measure::Interval interval;  ///< of that median
    double ratio = 0.0;          ///< to the base's frame, median
};

/// At 640 x 360, one sample a pixel; all in turn, `rounds` times.
std::vector<FogCost> fogCosts(gl::Context& context, int rounds);

}  // namespace lobe::bench
