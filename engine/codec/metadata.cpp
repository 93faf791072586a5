#include "codec/metadata.hpp"

#include <nlohmann/json.hpp>

#include "codec/exr_header.hpp"
#include "codec/hdr_header.hpp"
#include "codec/jpeg_segments.hpp"
#include "codec/png_chunks.hpp"

namespace lobe::codec {
namespace {

/// One line of ASCII, whatever the texts hold.
std::string packed(const Metadata& metadata) {
    if (metadata.empty()) return {};
    return nlohmann::json(metadata).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

Metadata unpacked(const std::string& comment) {
    Metadata metadata;
    if (comment.empty()) return metadata;
    const nlohmann::json object = nlohmann::json::parse(comment, nullptr, false);
    if (!object.is_object()) return {{"Comment", comment}};
    for (const auto& [key, value] : object.items())
        metadata[key] = value.is_string() ? value.get<std::string>() : value.dump();
    return metadata;
}

}  // namespace

Metadata metadataOf(Format format, Bytes file) {
    switch (format) {
        case Format::png:
            return png::texts(file);
        case Format::jpeg:
            return unpacked(jpeg::comment(file));
        case Format::hdr:
            return unpacked(hdr::comment(file));
        case Format::exr:
            return exr::readHeader(file).parts.front().strings;
        case Format::webp:
            return {};
    }
    return {};
}

std::string withMetadata(Format format, Bytes file, const Metadata& metadata) {
    switch (format) {
        case Format::png:
            return png::withTexts(file, metadata);
        case Format::jpeg:
            return jpeg::withComment(file, packed(metadata));
        case Format::hdr:
            return hdr::withComment(file, packed(metadata));
        case Format::exr:
        case Format::webp:
            break;
    }
    return std::string(textOf(file));
}

}  // namespace lobe::codec
