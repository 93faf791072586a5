/// Structural similarity: Wang et al., Image Quality Assessment, IEEE TIP 13(4), 2004.
#pragma once

#include "image/planes.hpp"

namespace lobe {

/// Of grey values 0..1: 1 where equal, for each pixel. Gaussian window of 11 x 11, deviation 1.5, K1 0.01, K2
/// 0.03; the nearest pixel goes on beyond the border, so that the map has the picture's size. Symmetric.
Plane ssim(const Plane& a, const Plane& b, int width, int height);

}  // namespace lobe
