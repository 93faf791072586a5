#include "codec/webp.hpp"

#include <webp/decode.h>

#include "base/error.hpp"
#include "codec/limits.hpp"

namespace lobe::codec::webp {

Bitmap decode(Bytes file) {
    const auto* const data = reinterpret_cast<const uint8_t*>(file.data());
    WebPBitstreamFeatures features{};
    if (WebPGetFeatures(data, file.size(), &features) != VP8_STATUS_OK)
        throw InputError("file is damaged: not a whole WebP header");
    if (features.has_animation != 0) throw InputError("WebP is animated; expected a still picture");
    const bool hasAlpha = features.has_alpha != 0;
    const int channels = hasAlpha ? 4 : 3;
    checkSize(features.width, features.height, channels);

    Bitmap bitmap{features.width, features.height, channels, ComponentType::u8, {}};
    bitmap.data.resize(static_cast<size_t>(features.width) * static_cast<size_t>(features.height) *
                       static_cast<size_t>(channels));
    auto* const pixels = reinterpret_cast<uint8_t*>(bitmap.data.data());
    const int stride = features.width * channels;
    const auto into = hasAlpha ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
    if (into(data, file.size(), pixels, bitmap.data.size(), stride) == nullptr)
        throw InputError("file is damaged: its pixels can't be decoded");
    return bitmap;
}

}  // namespace lobe::codec::webp
