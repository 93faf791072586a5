#include "image/image.hpp"

#include <algorithm>
#include <bit>

namespace lobe {
namespace {

constexpr uint32_t kExponent = 0x7f800000;  // all ones for NaN and infinity, and for nothing else

bool isFinite(float value) {
    return (std::bit_cast<uint32_t>(value) & kExponent) != kExponent;
}

/// Without a branch, so that the loop becomes vector instructions: nearly every picture has none.
bool allFinite(const float* values, size_t count) {
    uint32_t bad = 0;
    for (size_t i = 0; i < count; ++i)
        bad |= isFinite(values[i]) ? 0U : 1U;
    return bad == 0;
}

}  // namespace

NonFinite countNonFinite(const Image& image) {
    constexpr size_t kPixelsAtOnce = 1024;
    NonFinite result;
    const size_t channels = image.channelCount();
    for (size_t block = 0; block < image.pixelCount(); block += kPixelsAtOnce) {
        const size_t end = std::min(block + kPixelsAtOnce, image.pixelCount());
        if (allFinite(image.values.data() + block * channels, (end - block) * channels)) continue;
        for (size_t pixel = block; pixel < end; ++pixel) {
            const float* const values = image.values.data() + pixel * channels;
            const float* const bad = std::find_if_not(values, values + channels, isFinite);
            if (bad == values + channels) continue;
            if (result.pixels++ > 0) continue;
            result.firstX = static_cast<int>(pixel % static_cast<size_t>(image.width));
            result.firstY = static_cast<int>(pixel / static_cast<size_t>(image.width));
            result.firstChannel = image.channels[static_cast<size_t>(bad - values)];
        }
    }
    return result;
}

}  // namespace lobe
