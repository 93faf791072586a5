/// The chunks of a PNG file around its pixels.
#pragma once

#include <map>
#include <string>

#include "codec/bytes.hpp"

namespace lobe::codec::png {

/// The file with only the chunks that pixels depend on (IHDR, PLTE, tRNS, IDAT, IEND): OpenImageIO's parsers
/// of embedded profiles and XMP crash on some damaged ones, and textures need neither.
std::string onlyPixels(Bytes file);

/// Texts: tEXt (Latin-1) and uncompressed iTXt (UTF-8), by keyword.
std::map<std::string, std::string> texts(Bytes file);

/// The file with an iTXt chunk a text, before its pixels. Keywords are cut to the 79 bytes that PNG allows.
std::string withTexts(Bytes file, const std::map<std::string, std::string>& texts);

}  // namespace lobe::codec::png
