/// Edge pixels: those whose error is one of coverage and not of shading.
#pragma once

#include <optional>

#include "image/metrics.hpp"

namespace lobe {

/// By the layers material.id, depth.Z and normal.X Y Z, of which one is enough (lobe render --aov): a pixel
/// is at an edge where the two pictures show different materials, or where in the truth (in the picture, if
/// only that has layers) it or one of its eight neighbours has another material, is background, is off the
/// plane of its neighbours in depth, or is turned by more than 30 degrees. Nothing where neither has a layer.
/// Pictures of one size.
std::optional<PixelMask> edgePixels(const Image& test, const Image& truth);

/// The values of one channel; nothing where the picture has none of that name.
std::optional<Plane> channelOf(const Image& image, const std::string& name);

}  // namespace lobe
