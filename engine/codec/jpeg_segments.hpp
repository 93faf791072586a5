/// The segments of a JPEG file before its pixels.
#pragma once

#include <string>

#include "codec/bytes.hpp"

namespace lobe::codec::jpeg {

/// The file without comments and application segments, but for JFIF and Adobe's, which tell the colour space:
/// OpenImageIO's parsers of embedded profiles crash on some damaged ones, and textures need none.
std::string onlyPixels(Bytes file);

/// All comments, joined.
std::string comment(Bytes file);

/// The file with a comment, in as many segments as it takes.
std::string withComment(Bytes file, const std::string& comment);

}  // namespace lobe::codec::jpeg
