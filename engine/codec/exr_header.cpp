#include "codec/exr_header.hpp"

#include "base/error.hpp"

namespace lobe::codec::exr {
namespace {

constexpr uint32_t kDeepFlag = 0x800;
constexpr uint32_t kMultiPartFlag = 0x1000;

/// Reads on from where it last stopped.
class Cursor {
public:
    explicit Cursor(Bytes bytes) : bytes_(bytes) {}

    bool atEnd() const { return bytes_.empty(); }

    std::string_view text(size_t size) {
        if (size > bytes_.size()) throw InputError("EXR header is cut off");
        const std::string_view taken = textOf(bytes_.first(size));
        bytes_ = bytes_.subspan(size);
        return taken;
    }
    uint32_t u32() {
        const auto value = littleEndian32(bytes_, 0);
        text(4);
        return *value;
    }
    int64_t i32() { return static_cast<int32_t>(u32()); }
    std::string terminated() {
        const std::string_view rest = textOf(bytes_);
        const size_t end = rest.find('\0');
        constexpr size_t kLongestName = 255;  // npos is longer too
        if (end > kLongestName) throw InputError("EXR header is damaged: a name does not end");
        std::string name(rest.substr(0, end));
        text(end + 1);
        return name;
    }

private:
    Bytes bytes_;
};

std::vector<Channel> channelsOf(Cursor value) {
    std::vector<Channel> channels;
    for (std::string name = value.terminated(); !name.empty(); name = value.terminated()) {
        value.text(8);  // pixel type, linearity, reserved
        const uint32_t x = value.u32();
        const uint32_t y = value.u32();
        channels.push_back({std::move(name), x != 1 || y != 1});
    }
    return channels;
}

Size windowOf(Cursor value) {
    const int64_t left = value.i32();
    const int64_t top = value.i32();
    const int64_t right = value.i32();
    const int64_t bottom = value.i32();
    return {right - left + 1, bottom - top + 1};
}

Size tileOf(Cursor value) {
    const uint32_t width = value.u32();
    const uint32_t height = value.u32();
    return {width, height};
}

/// Nothing for the empty header that ends a list of parts.
std::optional<Part> partOf(Cursor& cursor) {
    std::string name = cursor.terminated();
    if (name.empty()) return std::nullopt;
    Part part;
    for (; !name.empty(); name = cursor.terminated()) {
        const std::string type = cursor.terminated();
        const size_t size = cursor.u32();
        const std::string_view value = cursor.text(size);
        const Cursor inner(std::as_bytes(std::span(value)));
        if (name == "channels" && type == "chlist") part.channels = channelsOf(inner);
        if (name == "dataWindow" && type == "box2i") part.dataWindow = windowOf(inner);
        if (name == "tiles" && type == "tiledesc") part.tile = tileOf(inner);
        if (type == "string") part.strings.insert_or_assign(name, std::string(value));
    }
    return part;
}

}  // namespace

Header readHeader(Bytes file) {
    Cursor cursor(file);
    cursor.text(4);  // signature
    const uint32_t version = cursor.u32();
    Header header;
    header.deep = (version & kDeepFlag) != 0;
    const bool multiPart = (version & kMultiPartFlag) != 0;
    do {
        auto part = partOf(cursor);
        if (!part) break;
        header.parts.push_back(std::move(*part));
    } while (multiPart);
    if (header.parts.empty()) throw InputError("EXR header is damaged: it has no attributes");
    return header;
}

}  // namespace lobe::codec::exr
