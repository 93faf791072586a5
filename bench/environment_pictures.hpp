/// Panoramas for the benchmarks of environments.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace lobe::bench {

struct Panorama {
    std::string name;
    Bitmap bitmap;
};

/// Those of the files, or, where there are none, three that are computed: a soft studio, a clear sky with its
/// sun in the picture, a night with small lamps.
std::vector<Panorama> panoramasOf(const std::vector<std::string>& files);

/// Bilinear, of 32-bit floats.
Bitmap resized(const Bitmap& bitmap, int width, int height);

}  // namespace lobe::bench
