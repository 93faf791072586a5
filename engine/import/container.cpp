#include "import/container.hpp"

#include <cstring>
#include <nlohmann/json.hpp>

#include "import/refuse.hpp"

namespace lobe {

namespace {

constexpr uint32_t kGlbMagic = 0x46546C67;   // "glTF"
constexpr uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr uint32_t kBinChunk = 0x004E4942;   // "BIN\0"
constexpr size_t kGlbHeader = 12;
constexpr size_t kChunkHeader = 8;
constexpr int kDeepestNesting = 64;  // glTF itself needs about ten; the rest is for extras

uint32_t wordAt(std::span<const std::byte> bytes, size_t offset) {
    uint32_t word;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

std::string_view asText(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

Container openContainer(std::span<const std::byte> bytes, const std::string& file) {
    if (bytes.size() < 4 || wordAt(bytes, 0) != kGlbMagic) {
        return {asText(bytes), std::nullopt};
    }
    if (bytes.size() < kGlbHeader + kChunkHeader) {
        refuse(file, "file length", std::to_string(bytes.size()), "at least 20 bytes of GLB header");
    }
    if (wordAt(bytes, 4) != 2) {
        refuse(file, "GLB version", std::to_string(wordAt(bytes, 4)), "2");
    }
    const uint32_t length = wordAt(bytes, 8);
    if (length > bytes.size()) {
        refuse(file, "GLB length", std::to_string(length),
               "at most the file's " + std::to_string(bytes.size()) + " bytes; is it cut off?");
    }
    Container container;
    size_t offset = kGlbHeader;
    for (size_t index = 0; offset + kChunkHeader <= length; ++index) {
        const uint32_t chunkLength = wordAt(bytes, offset);
        const uint32_t type = wordAt(bytes, offset + 4);
        offset += kChunkHeader;
        if (chunkLength > length - offset) {
            refuse(file, at("GLB chunk", index) + " length", std::to_string(chunkLength),
                   "at most the " + std::to_string(length - offset) + " bytes that are left");
        }
        if ((index == 0) != (type == kJsonChunk)) {
            refuse(file, at("GLB chunk", index) + " type", std::to_string(type),
                   "JSON first, and only there");
        }
        if (index == 0) {
            container.json = asText(bytes.subspan(offset, chunkLength));
        } else if (type == kBinChunk && !container.bin) {
            container.bin = bytes.subspan(offset, chunkLength);
        }
        offset += chunkLength;
    }
    return container;
}

nlohmann::json parseJson(std::string_view text, const std::string& file) {
    int depth = 0;
    bool inString = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (inString) {
            i += c == '\\' ? 1U : 0U;
            inString = c != '"';
        } else if (c == '"') {
            inString = true;
        } else if (c == '{' || c == '[') {
            if (++depth > kDeepestNesting) {
                refuse(file, "JSON text, byte " + std::to_string(i),
                       "nested deeper than " + std::to_string(kDeepestNesting), "a glTF scene");
            }
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& error) {
        std::string reason = error.what();
        const size_t id = reason.find("] ");
        refuse(file, "JSON text", id == std::string::npos ? reason : reason.substr(id + 2),
               "a glTF 2.0 scene, as JSON or GLB");
    }
}

}  // namespace lobe
