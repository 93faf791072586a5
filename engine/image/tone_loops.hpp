/// Tone mapping of many pixels at once.
#pragma once

#include <cstddef>

#include "image/tone.hpp"

namespace lobe {

/// One array a channel, which do not overlap.
struct Planes {
    float* r;
    float* g;
    float* b;
};

/// toneMap() of `count` pixels in place.
void toneMapPlanes(ToneMapping curve, const Planes& planes, size_t count);

}  // namespace lobe
