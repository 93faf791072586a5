#include "codec/format.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/error.hpp"

namespace lobe::codec {
namespace {

using namespace std::string_view_literals;

struct Signature {
    std::string_view bytes;
    const char* name;
};

/// Formats that people will try, so that the message can say what it is that Lobe does not read.
constexpr std::array kOthers = {
    Signature{"\xABKTX 20\xBB"sv, "KTX2"},
    Signature{"\xABKTX 11\xBB"sv, "KTX"},
    Signature{"DDS "sv, "DDS"},
    Signature{"GIF8"sv, "GIF"},
    Signature{"BM"sv, "BMP"},
    Signature{"II*\0"sv, "TIFF"},
    Signature{"MM\0*"sv, "TIFF"},
    Signature{"8BPS"sv, "PSD"},
    Signature{"\0\0\0\x0CjP"sv, "JPEG 2000"},
    Signature{"\xFF\x0A"sv, "JPEG XL"},
    Signature{"<svg"sv, "SVG"},
    Signature{"%PDF"sv, "PDF"},
};

}  // namespace

Format formatOf(Bytes file) {
    const std::string_view text = textOf(file);
    if (text.empty()) throw InputError("file is empty; expected PNG, JPEG, WebP, HDR or EXR");
    if (text.starts_with("\x89PNG\r\n\x1a\n"sv)) return Format::png;
    if (text.starts_with("\xff\xd8\xff"sv)) return Format::jpeg;
    if (text.starts_with("RIFF"sv) && text.size() >= 12 && text.substr(8, 4) == "WEBP"sv) return Format::webp;
    if (text.starts_with("#?RADIANCE"sv) || text.starts_with("#?RGBE"sv)) return Format::hdr;
    if (text.starts_with("\x76\x2f\x31\x01"sv)) return Format::exr;
    for (const Signature& other : kOthers)
        if (text.starts_with(other.bytes))
            throw InputError(std::string("format is ") + other.name +
                             "; expected PNG, JPEG, WebP, HDR or EXR");
    throw InputError("format is unknown; expected PNG, JPEG, WebP, HDR or EXR");
}

const char* openImageIoName(Format format) {
    switch (format) {
        case Format::png:
            return "png";
        case Format::jpeg:
            return "jpeg";
        case Format::webp:
            return "webp";
        case Format::hdr:
            return "hdr";
        case Format::exr:
            return "openexr";
    }
    return "";
}

Format formatOfExtension(const std::string& extension) {
    std::string lower = extension;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (lower == ".png") return Format::png;
    if (lower == ".jpg" || lower == ".jpeg") return Format::jpeg;
    if (lower == ".hdr") return Format::hdr;
    if (lower == ".exr") return Format::exr;
    throw OutputError("extension: '" + extension + "'; expected .png, .jpg, .jpeg, .exr or .hdr");
}

}  // namespace lobe::codec
