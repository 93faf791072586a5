/// One value a pixel in double, and separable filters over them.
#pragma once

#include <cstddef>
#include <vector>

namespace lobe {

/// Row by row from the top, width * height values.
using Plane = std::vector<double>;

/// A kernel of 2 r + 1 weights, the middle one at r.
using Kernel = std::vector<double>;

/// Convolution along x with `horizontal`, then along y with `vertical`; beyond the border the nearest pixel
/// goes on. In fixed order, so that equal input gives equal bits.
Plane filtered(const Plane& plane, int width, int height, const Kernel& horizontal, const Kernel& vertical);

}  // namespace lobe
