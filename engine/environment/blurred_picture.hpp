#pragma once

#include "environment/environment_map.hpp"

namespace lobe {

/// An equirectangular picture of an environment out of focus, of 32-bit floats: blurred by a Gaussian of 5
/// degrees. Radiance without the environment's scale, in the map's own axes.
Bitmap blurredPicture(const EnvironmentMap& map);

}  // namespace lobe
