/// The text header of Radiance's .hdr.
#pragma once

#include <string>

#include "codec/bytes.hpp"

namespace lobe::codec::hdr {

/// The file without comments: OpenImageIO gives up on headers of a hundred lines.
std::string onlyPixels(Bytes file);

/// What withComment() wrote, or nothing.
std::string comment(Bytes file);

/// The file with a text without line ends as comment lines ("#lobe ..."), short enough for readers with small
/// buffers.
std::string withComment(Bytes file, const std::string& comment);

}  // namespace lobe::codec::hdr
