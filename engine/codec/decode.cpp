#include <algorithm>

#include "base/error.hpp"
#include "codec/codec.hpp"
#include "codec/metadata.hpp"
#include "codec/open_picture.hpp"
#include "codec/webp.hpp"

namespace lobe::codec {
namespace {

ComponentType componentType(const OIIO::TypeDesc& stored) {
    switch (stored.basetype) {
        case OIIO::TypeDesc::UINT8:
            return ComponentType::u8;
        case OIIO::TypeDesc::UINT16:
            return ComponentType::u16;
        default:
            return ComponentType::f32;
    }
}

OIIO::TypeDesc typeOf(ComponentType type) {
    switch (type) {
        case ComponentType::u8:
            return OIIO::TypeDesc::UINT8;
        case ComponentType::u16:
            return OIIO::TypeDesc::UINT16;
        case ComponentType::f32:
            return OIIO::TypeDesc::FLOAT;
    }
    return OIIO::TypeDesc::UNKNOWN;
}

/// How many of the leading channels are colour and alpha: all of 1 to 4, and R, G, B[, A] of a picture with
/// layers.
int bitmapChannels(const OIIO::ImageSpec& spec) {
    if (spec.nchannels <= 4) return spec.nchannels;
    const auto isNamed = [&](size_t i, const char* name) { return spec.channelnames[i] == name; };
    if (!isNamed(0, "R") || !isNamed(1, "G") || !isNamed(2, "B"))
        throw InputError("channels: " + std::to_string(spec.nchannels) +
                         "; expected 1 to 4, or R, G and B among them");
    return isNamed(3, "A") ? 4 : 3;
}

/// 8-bit colour [and alpha] as 0..1, not linearised, as OpenImageIO converts.
Image asImage(const Bitmap& bitmap) {
    std::vector<std::string> names = {"R", "G", "B"};
    if (bitmap.channels == 4) names.emplace_back("A");
    Image image(bitmap.width, bitmap.height, std::move(names));
    std::transform(bitmap.data.begin(), bitmap.data.end(), image.values.begin(),
                   [](std::byte code) { return static_cast<float>(std::to_integer<int>(code)) / 255.0F; });
    return image;
}

}  // namespace

Bitmap decode(std::span<const std::byte> fileBytes) {
    if (formatOf(fileBytes) == Format::webp) return webp::decode(fileBytes);
    OpenPicture picture(fileBytes);
    const OIIO::ImageSpec& spec = picture.spec();
    Bitmap bitmap;
    bitmap.width = spec.width;
    bitmap.height = spec.height;
    bitmap.channels = bitmapChannels(spec);
    bitmap.type = componentType(spec.format);
    bitmap.data.resize(static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) *
                       static_cast<size_t>(bitmap.channels) * bitmap.bytesPerComponent());
    picture.read(typeOf(bitmap.type), bitmap.channels, bitmap.data.data());
    return bitmap;
}

Image read(std::span<const std::byte> fileBytes) {
    if (formatOf(fileBytes) == Format::webp) return asImage(webp::decode(fileBytes));
    OpenPicture picture(fileBytes);
    const OIIO::ImageSpec& spec = picture.spec();
    Image image(spec.width, spec.height, spec.channelnames);
    picture.read(OIIO::TypeDesc::FLOAT, spec.nchannels, image.values.data());
    return image;
}

std::map<std::string, std::string> readMetadata(std::span<const std::byte> fileBytes) {
    return metadataOf(formatOf(fileBytes), fileBytes);
}

}  // namespace lobe::codec
