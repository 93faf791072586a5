/// Which kind of file a byte string is, by its first bytes; file names do not count.
#pragma once

#include <cstdint>

#include "codec/bytes.hpp"

namespace lobe::codec {

enum class Format : uint8_t { png, jpeg, webp, hdr, exr };

/// Throws InputError for what is none of them, with the name of the format when it is a well-known one.
Format formatOf(Bytes file);

/// What OpenImageIO calls its reader and writer.
const char* openImageIoName(Format format);

/// By extension (".PNG"), for writing: png, jpeg, hdr or exr; throws OutputError for others.
Format formatOfExtension(const std::string& extension);

}  // namespace lobe::codec
