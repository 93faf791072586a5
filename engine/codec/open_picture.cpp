#include "codec/open_picture.hpp"

#include <algorithm>
#include <new>

#include "base/error.hpp"
#include "codec/exr_header.hpp"
#include "codec/hdr_header.hpp"
#include "codec/jpeg_segments.hpp"
#include "codec/limits.hpp"
#include "codec/open_image_io.hpp"
#include "codec/png_chunks.hpp"

namespace lobe::codec {
namespace {

constexpr int64_t kSmallTile = 1024;  // a side that tiles may have in pictures that are smaller

/// OpenEXR allocates whole tiles when it opens a file.
void checkExr(Bytes file) {
    const exr::Header header = exr::readHeader(file);
    if (header.deep) throw InputError("EXR is deep; expected a flat picture");
    for (const exr::Part& part : header.parts) {
        if (!part.dataWindow) throw InputError("EXR header is damaged: it has no data window");
        const auto channels = static_cast<int64_t>(part.channels.size());
        checkSize(part.dataWindow->width, part.dataWindow->height, channels);
        for (const exr::Channel& channel : part.channels)
            if (channel.subsampled)
                throw InputError(
                    "EXR channel " + channel.name +
                    " is subsampled (luminance-chroma); expected every channel at full resolution");
        if (!part.tile) continue;
        const int64_t widest = std::max(part.dataWindow->width, kSmallTile);
        const int64_t highest = std::max(part.dataWindow->height, kSmallTile);
        const exr::Size tile = *part.tile;
        if (tile.width < 1 || tile.height < 1 || tile.width > widest || tile.height > highest ||
            tile.width * tile.height * channels > kMaxComponents)
            throw InputError("EXR tile size: " + std::to_string(tile.width) + "x" +
                             std::to_string(tile.height) + "; expected at most " + std::to_string(widest) +
                             "x" + std::to_string(highest));
    }
}

/// The library's reason in one line.
[[noreturn]] void fail(const std::string& libraryError) {
    if (libraryError.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    std::string line = libraryError.substr(0, libraryError.find('\n'));
    if (line.empty()) line = "the decoder gave no reason";
    throw InputError("file is damaged: " + line);
}

/// Runs a call into the library; whatever it throws is a damaged file.
template<class Call>
bool guarded(const Call& call) {
    try {
        return call();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        fail(error.what());
    } catch (...) {
        fail("");
    }
}

}  // namespace

OpenPicture::OpenPicture(Bytes file) {
    setUpOpenImageIo();
    const Format format = formatOf(file);
    if (format == Format::exr) checkExr(file);
    if (format == Format::png) reduced_ = png::onlyPixels(file);
    if (format == Format::hdr) reduced_ = hdr::onlyPixels(file);
    if (format == Format::jpeg) reduced_ = jpeg::onlyPixels(file);
    const Bytes decoded = reduced_.empty() ? file : std::as_bytes(std::span(reduced_));

    const std::string name = openImageIoName(format);
    memory_ = std::make_unique<OIIO::Filesystem::IOMemReader>(decoded.data(), decoded.size());
    input_ = OIIO::ImageInput::create(name);
    if (!input_) throw InputError("OpenImageIO was built without " + name);
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::Filesystem::IOProxy* proxy = memory_.get();
    hints.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    OIIO::ImageSpec opened;
    // Readers look at the name's extension for nothing once they are chosen, but some want a name.
    if (!guarded([&] { return input_->open("memory." + name, opened, hints); })) fail(input_->geterror());
    const OIIO::ImageSpec& found = input_->spec();
    checkSize(found.width, found.height, found.nchannels);
    if (found.deep || found.depth > 1)
        throw InputError("picture is deep or a volume; expected a flat picture");
    if (static_cast<int64_t>(found.tile_width) * found.tile_height > kMaxComponents)
        throw InputError("tile size: " + std::to_string(found.tile_width) + "x" +
                         std::to_string(found.tile_height) + "; expected at most " +
                         std::to_string(kMaxComponents) + " pixels");
}

void OpenPicture::read(OIIO::TypeDesc type, int channels, void* pixels) {
    if (!guarded([&] { return input_->read_image(0, 0, 0, channels, type, pixels); }))
        fail(input_->geterror());
}

}  // namespace lobe::codec
