/// What a picture may ask of memory before any of it is decoded.
#pragma once

#include <cstdint>

namespace lobe::codec {

inline constexpr int64_t kMaxComponents = int64_t{1} << 28;
inline constexpr int64_t kMaxChannels = 1024;

/// Throws InputError that names the number that is out of range: sides up to kMaxSide of codec.hpp.
void checkSize(int64_t width, int64_t height, int64_t channels);

}  // namespace lobe::codec
