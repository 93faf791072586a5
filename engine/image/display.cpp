#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "image/srgb_table.hpp"
#include "image/tone.hpp"
#include "image/tone_curves.hpp"
#include "image/tone_loops.hpp"

namespace lobe {
namespace {

constexpr size_t kChunk = 512;  // pixels whose planes stay in the first-level cache

struct Channels {
    std::array<size_t, 3> rgb{};
    std::optional<size_t> alpha;
};

Channels findChannels(const Image& image) {
    const auto find = [&](const char* name) -> std::optional<size_t> {
        const auto found = std::find(image.channels.begin(), image.channels.end(), name);
        if (found == image.channels.end()) return std::nullopt;
        return static_cast<size_t>(found - image.channels.begin());
    };
    Channels channels;
    constexpr std::array<const char*, 3> kNames = {"R", "G", "B"};
    for (size_t i = 0; i < 3; ++i) {
        const auto found = find(kNames[i]);
        if (!found)
            throw InputError(std::string("picture has no channel ") + kNames[i] + "; expected R, G and B");
        channels.rgb[i] = *found;
    }
    channels.alpha = find("A");
    return channels;
}

struct Chunk {
    std::array<std::array<float, kChunk>, 3> rgb;
    std::array<float, kChunk> alpha;
};

void load(Chunk& chunk, const Image& image, const Channels& channels, size_t first, size_t count) {
    const size_t stride = image.channelCount();
    const float* const values = image.values.data() + first * stride;
    for (size_t i = 0; i < count; ++i)
        for (size_t c = 0; c < 3; ++c)
            chunk.rgb[c][i] = values[i * stride + channels.rgb[c]];
    if (!channels.alpha) {
        std::fill_n(chunk.alpha.begin(), count, 1.0F);
        return;
    }
    for (size_t i = 0; i < count; ++i)
        chunk.alpha[i] = curves::clamp01(values[i * stride + *channels.alpha]);
}

}  // namespace

Bitmap toDisplay(const Image& image, float exposure, ToneMapping curve, bool keepAlpha,
                 const float background[3]) {
    const Channels channels = findChannels(image);
    const SrgbTable& table = SrgbTable::get();
    const float gain = std::exp2(exposure);
    const size_t components = keepAlpha ? 4 : 3;
    Bitmap bitmap{image.width, image.height, static_cast<int>(components), ComponentType::u8, {}};
    bitmap.data.resize(image.pixelCount() * components);
    auto* out = reinterpret_cast<uint8_t*>(bitmap.data.data());

    Chunk chunk;
    for (size_t first = 0; first < image.pixelCount(); first += kChunk) {
        const size_t count = std::min(kChunk, image.pixelCount() - first);
        load(chunk, image, channels, first, count);
        for (auto& plane : chunk.rgb)
            for (size_t i = 0; i < count; ++i)
                plane[i] *= keepAlpha && chunk.alpha[i] > 0.0F ? gain / chunk.alpha[i] : gain;
        toneMapPlanes(curve, {chunk.rgb[0].data(), chunk.rgb[1].data(), chunk.rgb[2].data()}, count);
        if (!keepAlpha && channels.alpha)
            for (size_t c = 0; c < 3; ++c)
                for (size_t i = 0; i < count; ++i)
                    chunk.rgb[c][i] =
                        curves::clamp01(chunk.rgb[c][i] + (1.0F - chunk.alpha[i]) * background[c]);
        for (size_t i = 0; i < count; ++i, out += components)
            for (size_t c = 0; c < 3; ++c)
                out[c] = table.encode(chunk.rgb[c][i]);
        if (keepAlpha)
            for (size_t i = 0; i < count; ++i)
                (out - 4 * (count - i))[3] = static_cast<uint8_t>(std::lround(chunk.alpha[i] * 255.0F));
    }
    return bitmap;
}

}  // namespace lobe
