#include "codec/png_chunks.hpp"

#include <algorithm>
#include <array>
#include <functional>

namespace lobe::codec::png {
namespace {

constexpr size_t kSignature = 8;
constexpr size_t kAroundData = 12;  // length, type, checksum

struct Chunk {
    std::string_view type;
    std::string_view data;
    std::string_view whole;
};

/// Every chunk in turn; the last one may be cut off, which is for the decoder to judge.
void forEachChunk(Bytes file, const std::function<void(const Chunk&)>& visit) {
    const std::string_view text = textOf(file);
    size_t at = kSignature;
    while (const auto length = bigEndian32(file, at)) {
        const std::string_view whole = text.substr(at, size_t{*length} + kAroundData);
        if (whole.size() < 8) return;
        visit({whole.substr(4, 4), whole.substr(8, *length), whole});
        at += whole.size();
    }
}

uint32_t crc(std::string_view bytes) {
    static const std::array<uint32_t, 256> table = [] {
        std::array<uint32_t, 256> values{};
        for (uint32_t i = 0; i < values.size(); ++i) {
            uint32_t value = i;
            for (int bit = 0; bit < 8; ++bit)
                value = (value & 1U) != 0 ? 0xedb88320U ^ (value >> 1) : value >> 1;
            values[i] = value;
        }
        return values;
    }();
    uint32_t value = 0xffffffffU;
    for (const char byte : bytes)
        value = table[(value ^ static_cast<unsigned char>(byte)) & 0xffU] ^ (value >> 8);
    return value ^ 0xffffffffU;
}

std::string utf8FromLatin1(std::string_view latin1) {
    std::string result;
    for (const char byte : latin1) {
        const auto code = static_cast<unsigned char>(byte);
        if (code < 0x80) {
            result += byte;
        } else {
            result += static_cast<char>(0xc0U | code >> 6);
            result += static_cast<char>(0x80U | (code & 0x3fU));
        }
    }
    return result;
}

/// Takes what precedes the next zero byte off the front; everything when there is none.
std::string_view takeTerminated(std::string_view& rest) {
    const std::string_view taken = rest.substr(0, rest.find('\0'));
    rest.remove_prefix(std::min(rest.size(), taken.size() + 1));
    return taken;
}

}  // namespace

std::string onlyPixels(Bytes file) {
    std::string result(textOf(file).substr(0, kSignature));
    result.reserve(file.size());
    forEachChunk(file, [&](const Chunk& chunk) {
        for (const std::string_view kept : {"IHDR", "PLTE", "tRNS", "IDAT", "IEND"})
            if (chunk.type == kept) result += chunk.whole;
    });
    return result;
}

std::map<std::string, std::string> texts(Bytes file) {
    std::map<std::string, std::string> result;
    forEachChunk(file, [&](const Chunk& chunk) {
        std::string_view rest = chunk.data;
        if (chunk.type == "tEXt") {
            const std::string keyword(takeTerminated(rest));
            result.insert_or_assign(keyword, utf8FromLatin1(rest));
        } else if (chunk.type == "iTXt") {
            const std::string keyword(takeTerminated(rest));
            if (rest.size() < 2 || rest[0] != 0) return;  // compressed
            rest.remove_prefix(2);
            takeTerminated(rest);  // language
            takeTerminated(rest);  // translated keyword
            result.insert_or_assign(keyword, std::string(rest));
        }
    });
    return result;
}

std::string withTexts(Bytes file, const std::map<std::string, std::string>& texts) {
    constexpr size_t kLongestKeyword = 79;
    constexpr size_t kHeader = kSignature + kAroundData + 13;  // IHDR is first
    const std::string_view text = textOf(file);
    std::string result(text.substr(0, kHeader));
    for (const auto& [key, value] : texts) {
        std::string body = "iTXt" + key.substr(0, kLongestKeyword);
        body.append(5, '\0');  // end of keyword, uncompressed, method, no language, no translated keyword
        body += value;
        appendBigEndian32(result, static_cast<uint32_t>(body.size() - 4));
        result += body;
        appendBigEndian32(result, crc(body));
    }
    return result.append(text.substr(kHeader));
}

}  // namespace lobe::codec::png
