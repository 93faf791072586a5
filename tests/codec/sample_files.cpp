#include "codec/sample_files.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <webp/encode.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "codec/codec.hpp"

namespace lobe::samples {
namespace {

std::string bigEndian(uint32_t value) {
    std::string text;
    for (const int shift : {24, 16, 8, 0})
        text += static_cast<char>(value >> shift & 0xffU);
    return text;
}

uint32_t crc(const std::string& text) {
    uint32_t value = ~0U;
    for (const char c : text) {
        value ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit)
            value = (value >> 1) ^ ((value & 1U) != 0 ? 0xedb88320U : 0U);
    }
    return ~value;
}

std::string chunk(const std::string& type, const std::string& data) {
    return bigEndian(static_cast<uint32_t>(data.size())) + type + data + bigEndian(crc(type + data));
}

/// zlib's format with one stored block.
std::string zlibStored(const std::string& data) {
    uint32_t a = 1;
    uint32_t b = 0;
    for (const char c : data) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<uint16_t>(data.size());
    std::string text("\x78\x01\x01", 3);
    for (const uint32_t value : {uint32_t{size}, uint32_t{static_cast<uint16_t>(~size)}}) {
        text += static_cast<char>(value & 0xffU);
        text += static_cast<char>(value >> 8);
    }
    return text + data + bigEndian(b << 16 | a);
}

std::string encoded(const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                    const void* pixels) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create(format);
    if (!output || !output->set_ioproxy(&memory) || !output->open(std::string("x.") + format, spec) ||
        !output->write_image(type, pixels) || !output->close())
        throw std::runtime_error(std::string("can't make a sample: ") + format);
    return {bytes.begin(), bytes.end()};
}

}  // namespace

std::span<const std::byte> bytesOf(const std::string& file) {
    return std::as_bytes(std::span(file));
}

Bitmap bitmap(int width, int height, int channels, ComponentType type) {
    Bitmap result{width, height, channels, type, {}};
    const size_t count =
        static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(channels);
    result.data.resize(count * result.bytesPerComponent());
    const bool hasAlpha = channels == 2 || channels == 4;
    for (size_t i = 0; i < count; ++i) {
        auto value = static_cast<uint32_t>(i * 2654435761U >> 7);
        const size_t pixel = i / static_cast<size_t>(channels);
        if (hasAlpha && i % static_cast<size_t>(channels) == static_cast<size_t>(channels) - 1)
            value = pixel % 3 == 0 ? 0 : pixel % 3 == 1 ? 0xffff : value;
        if (type == ComponentType::u8)
            result.data[i] = static_cast<std::byte>(value & 0xffU);
        else
            for (size_t b = 0; b < 2; ++b)
                result.data[i * 2 + b] = static_cast<std::byte>(value >> (8 * b) & 0xffU);
    }
    return result;
}

Image image(int width, int height, const std::vector<std::string>& channels) {
    Image result(width, height, channels);
    for (size_t i = 0; i < result.values.size(); ++i)
        result.values[i] = std::exp2(static_cast<float>(i * 7919 % 997) / 60.0F - 6.0F);
    return result;
}

std::string png(const PngParts& parts) {
    std::string header = bigEndian(parts.width) + bigEndian(parts.height);
    header += static_cast<char>(parts.bitDepth);
    header += static_cast<char>(parts.colourType);
    header.append(3, '\0');  // compression, filter, no interlacing
    std::string file("\x89PNG\r\n\x1a\n", 8);
    file += chunk("IHDR", header);
    if (!parts.palette.empty()) file += chunk("PLTE", parts.palette);
    if (!parts.transparency.empty()) file += chunk("tRNS", parts.transparency);
    std::string filtered;
    const size_t stride = std::max<size_t>(1, parts.rows.size() / std::max(1U, parts.height));
    for (size_t at = 0; at < parts.rows.size(); at += stride)
        filtered += '\0' + parts.rows.substr(at, stride);
    return file + chunk("IDAT", zlibStored(filtered)) + chunk("IEND", "");
}

std::string webp(const Bitmap& bitmap) {
    WebPConfig config{};
    WebPPicture picture{};
    WebPMemoryWriter memory{};
    WebPMemoryWriterInit(&memory);
    bool done = WebPConfigInit(&config) != 0 && WebPPictureInit(&picture) != 0;
    config.lossless = 1;
    config.exact = 1;  // colour under alpha 0 too
    picture.use_argb = 1;
    picture.width = bitmap.width;
    picture.height = bitmap.height;
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &memory;
    const auto* const pixels = reinterpret_cast<const uint8_t*>(bitmap.data.data());
    const int stride = bitmap.width * bitmap.channels;
    const auto import = bitmap.channels == 4 ? WebPPictureImportRGBA : WebPPictureImportRGB;
    done = done && import(&picture, pixels, stride) != 0 && WebPEncode(&config, &picture) != 0;
    WebPPictureFree(&picture);
    std::string file(reinterpret_cast<const char*>(memory.mem), memory.size);
    WebPMemoryWriterClear(&memory);
    if (!done) throw std::runtime_error("can't make a sample: webp");
    return file;
}

std::string tiledExr(const Image& image, int tileWidth, int tileHeight) {
    OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channelCount()),
                         OIIO::TypeDesc::FLOAT);
    spec.channelnames = image.channels;
    spec.tile_width = tileWidth;
    spec.tile_height = tileHeight;
    return encoded("openexr", spec, OIIO::TypeDesc::FLOAT, image.values.data());
}

std::map<std::string, std::string> everyFormat() {
    const WriteOptions options{{{"lobe:settings", "{\"a\": 1}"}}, ExrPrecision::half, 90};
    return {
        {"png", codec::encode(".png", bitmap(13, 9, 4, ComponentType::u8), options)},
        {"png16", codec::encode(".png", bitmap(7, 5, 3, ComponentType::u16), {})},
        {"palette", png({4, 2, 4, 3, std::string("\1\2\3\4\5\6\7\10\11", 9), "\x80",
                         std::string("\x01\x20\x20\x10", 4)})},
        {"jpeg", codec::encode(".jpg", bitmap(16, 16, 3, ComponentType::u8), options)},
        {"webp", webp(bitmap(11, 7, 4, ComponentType::u8))},
        {"hdr", codec::encode(".hdr", image(12, 6, {"R", "G", "B"}), options)},
        {"exr", codec::encode(".exr", image(9, 8, {"R", "G", "B", "A", "Z", "normal.X"}), options)},
        {"tiled", tiledExr(image(20, 20, {"R", "G", "B"}), 16, 16)},
    };
}

}  // namespace lobe::samples
