/// Picture files, read and written in a worker process (lobe-image-worker, which alone links OpenImageIO): a
/// file that crashes, hangs or bloats its decoder costs that file and not the program, and the program starts
/// without loading the decoders' 250 libraries.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/worker.hpp"
#include "image/image.hpp"

namespace lobe {

/// Pixel storage of EXR files. With half, "Z" and channels with a finite value beyond 65504 are stored as
/// float all the same, so that nothing finite becomes infinite.
enum class ExrPrecision : uint8_t { half, single };

struct WriteOptions {
    std::map<std::string, std::string>
        metadata;  ///< e.g. "lobe:settings" -> JSON; "Software" -> "lobe 0.1.0"
    ExrPrecision exrPrecision = ExrPrecision::half;
    int jpegQuality = 92;
};

/// Formats are decided by content when reading (PNG, JPEG, WebP, HDR, EXR only) and by extension when
/// writing.
class ImageFiles {
public:
    /// Starts its worker at once and does not wait for it. One thread at a time.
    explicit ImageFiles(WorkerLimits limits = {});

    /// Decodes a file's bytes. `what` names it in messages ("helmet.gltf: images[2] (albedo.png)"). Throws
    /// InputError.
    Bitmap decode(std::span<const std::byte> fileBytes, const std::string& what);

    /// A picture as floats with its channel names as the file has them (8- and 16-bit values as 0..1, not
    /// linearised; the first part of a multi-part EXR), and its metadata. Throws InputError.
    Image read(const std::filesystem::path& file);
    std::map<std::string, std::string> readMetadata(const std::filesystem::path& file);

    /// Display pixels to .png or .jpg; throws OutputError; the file appears whole or not at all.
    void write(const std::filesystem::path& file, const Bitmap& bitmap, const WriteOptions& options);
    /// Linear pixels to .exr (any channels, channels of other than R,G,B,A as layers "layer.channel") or .hdr
    /// (R,G,B).
    void write(const std::filesystem::path& file, const Image& image, const WriteOptions& options);

    /// Extensions that write() knows, lower case with dot.
    static const std::vector<std::string>& displayExtensions();  ///< .png .jpg .jpeg
    static const std::vector<std::string>& linearExtensions();   ///< .exr .hdr

private:
    Worker worker_;
};

}  // namespace lobe
