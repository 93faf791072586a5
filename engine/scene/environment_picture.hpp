/// Pictures of environments: their values, and other layouts than the equirectangular one.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "image/image.hpp"

namespace lobe {

/// A component as radiance: 8- and 16-bit pictures are sRGB.
double linearComponent(const Bitmap& bitmap, size_t index);

/// How many texels are negative or not finite, which count as 0, in words; nothing if none is.
std::optional<std::string> badTexelWarning(const Bitmap& bitmap);

/// Whether a picture is as wide and high as an unfolded cube: 4 : 3 or 3 : 4.
bool isCubeCross(const Bitmap& bitmap);

/// A cube, unfolded as it is seen from inside, as an equirectangular picture (Environment::image) of 4 x 2
/// sides of its faces. +Z is in the middle; +X is left of it, -X right, +Y above, -Y below; -Z is right of -X
/// or, upside down, below -Y.
Bitmap fromCubeCross(const Bitmap& cross);

/// Six square faces, +X -X +Y -Y +Z -Z, each as OpenGL's cube maps and KTX files have them (rows from the
/// top), as an equirectangular picture. Throws InputError, which starts with `what`, if they are not square
/// and alike.
Bitmap fromCubeFaces(const std::array<Bitmap, 6>& faces, const std::string& what);

}  // namespace lobe
