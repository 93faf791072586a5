/// Picture files through OpenImageIO, in this process. Only the image worker and tests call this: damaged
/// files crash some of OpenImageIO's readers, so everybody else goes through image/image_files.hpp.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "image/image.hpp"
#include "image/image_files.hpp"

namespace lobe::codec {

/// Largest picture that is read: 16384 pixels a side (the texture limit everywhere) and 2^28 components.
inline constexpr int kMaxSide = 16384;

Bitmap decode(std::span<const std::byte> fileBytes);  ///< throws InputError
Image read(std::span<const std::byte> fileBytes);     ///< throws InputError
std::map<std::string, std::string> readMetadata(std::span<const std::byte> fileBytes);

/// The bytes of a file: extension .png, .jpg or .jpeg, and .exr or .hdr for linear pixels. Throws
/// OutputError.
std::string encode(const std::string& extension, const Bitmap& bitmap, const WriteOptions& options);
std::string encode(const std::string& extension, const Image& image, const WriteOptions& options);
void write(const std::filesystem::path& file, const Bitmap& bitmap,
           const WriteOptions& options);  ///< OutputError
void write(const std::filesystem::path& file, const Image& image, const WriteOptions& options);

/// The image worker's request handler: the wire form of the functions above.
Message serve(const Message& request);

}  // namespace lobe::codec
