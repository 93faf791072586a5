/// The floor of a pass: a pass over the screen that reads and writes the same bytes and computes nothing.
#pragma once

#include <map>
#include <string>

#include "gl/context.hpp"
#include "plan/plan.hpp"

namespace lobe::measure {

/// Milliseconds of each pass's floor, the least of `runs` runs.
std::map<std::string, double> floorTimes(const FramePlan& plan, const gl::ContextInfo& info, int width,
                                         int height, int runs);

}  // namespace lobe::measure
