/// From the frame's targets to an Image.
#pragma once

#include "image/image.hpp"
#include "passes/targets.hpp"
#include "plan/plan.hpp"
#include "scene/camera.hpp"

namespace lobe {

/// Radiance and whatever else was asked for, as named channels, row 0 at the top.
Image readPicture(const FramePlan& plan, const Targets& targets, const View& view, const AovSet& aovs);

}  // namespace lobe
