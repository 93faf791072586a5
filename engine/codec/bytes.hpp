/// Numbers out of and into byte strings, each read checked against the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lobe::codec {

using Bytes = std::span<const std::byte>;

inline std::string_view textOf(Bytes bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

inline uint32_t byteAt(Bytes bytes, size_t offset) {
    return std::to_integer<uint32_t>(bytes[offset]);
}

inline std::optional<uint32_t> bigEndian32(Bytes bytes, size_t offset) {
    if (offset > bytes.size() || bytes.size() - offset < 4) return std::nullopt;
    return byteAt(bytes, offset) << 24 | byteAt(bytes, offset + 1) << 16 | byteAt(bytes, offset + 2) << 8 |
           byteAt(bytes, offset + 3);
}

inline std::optional<uint32_t> bigEndian16(Bytes bytes, size_t offset) {
    if (offset > bytes.size() || bytes.size() - offset < 2) return std::nullopt;
    return byteAt(bytes, offset) << 8 | byteAt(bytes, offset + 1);
}

inline std::optional<uint32_t> littleEndian32(Bytes bytes, size_t offset) {
    if (offset > bytes.size() || bytes.size() - offset < 4) return std::nullopt;
    return byteAt(bytes, offset) | byteAt(bytes, offset + 1) << 8 | byteAt(bytes, offset + 2) << 16 |
           byteAt(bytes, offset + 3) << 24;
}

inline void appendBigEndian32(std::string& out, uint32_t value) {
    for (const int shift : {24, 16, 8, 0})
        out += static_cast<char>(value >> shift & 0xffU);
}

inline void appendBigEndian16(std::string& out, uint32_t value) {
    for (const int shift : {8, 0})
        out += static_cast<char>(value >> shift & 0xffU);
}

}  // namespace lobe::codec
