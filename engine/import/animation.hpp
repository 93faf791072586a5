/// Animations, evaluated at one time.
#pragma once

#include <vector>

#include "import/nodes.hpp"

namespace lobe {

/// Poses all animations at `time` seconds (each clamped to its own keys) and returns their durations. Where
/// several move the same property the last one in the file holds. Checks all samplers that move something.
std::vector<double> animate(Document& document, double time, std::vector<NodePose>& pose);

}  // namespace lobe
