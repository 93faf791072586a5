/// Keys and texts kept beside the pixels, in each format's own way; none of it needs a decoder.
#pragma once

#include <map>
#include <string>

#include "codec/format.hpp"

namespace lobe::codec {

using Metadata = std::map<std::string, std::string>;

/// PNG: text chunks. EXR: string attributes of the first part. JPEG and HDR: a JSON object in the comment,
/// and the plain comment of other programs' JPEG files as "Comment". WebP: nothing.
Metadata metadataOf(Format format, Bytes file);

/// The encoded file with metadata. EXR's attributes are the encoder's business: the file comes back as it is.
std::string withMetadata(Format format, Bytes file, const Metadata& metadata);

}  // namespace lobe::codec
