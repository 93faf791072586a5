#include <cmath>
#include <cstring>
#include <fstream>

#include "base/atomic_file.hpp"
#include "base/content_hash.hpp"
#include "base/error.hpp"
#include "base/resources.hpp"
#include "environment/prefiltered.hpp"
#include "fit/table_cache.hpp"

namespace lobe::environment {
namespace {

constexpr uint32_t kMagic = 0x45424f4c;  // "LOBE"

/// Before the texels.
struct Header {
    uint32_t magic = kMagic;
    int32_t version = kVersion;
    int32_t width = 0, height = 0;
    int32_t layers = 0;
    std::array<Square, kMostLayers> squares{};
    Square irradiance;
    int32_t tableX = 0, tableY = 0, tableRows = 0;
    double firstLogWidth = 0.0, rowsPerLogWidth = 0.0;
    std::array<char, 16> key{}, content{};
};

std::array<char, 16> characters(const std::string& hex) {
    std::array<char, 16> result{};
    std::copy_n(hex.begin(), std::min(hex.size(), result.size()), result.begin());
    return result;
}

std::array<char, 16> contentOf(const std::vector<float>& texels) {
    ContentHash hash;
    hash.add(std::as_bytes(std::span(texels)));
    return characters(hash.hex());
}

bool fits(const Header& header, const Square& square) {
    return square.size >= 0 && square.x >= 0 && square.y >= 0 && square.x + square.size + 2 <= header.width &&
           square.y + square.size + 2 <= header.height;
}

bool good(const Header& header, const std::string& key) {
    constexpr int32_t kMostSide = 1 << 14;
    if (header.magic != kMagic || header.version != kVersion || header.key != characters(key)) return false;
    if (header.width < 1 || header.height < 1 || header.width > kMostSide || header.height > kMostSide)
        return false;
    if (header.layers < 0 || header.layers > static_cast<int32_t>(kMostLayers)) return false;
    for (int32_t i = 0; i < header.layers; ++i)
        if (!fits(header, header.squares[static_cast<size_t>(i)])) return false;
    return header.tableRows >= 1 && header.tableX >= 0 && header.tableY >= 0 &&
           header.tableY + header.tableRows <= header.height;
}

}  // namespace

std::string keyOf(const EnvironmentMap& map, const Request& request) {
    ContentHash hash;
    const std::string content = map.contentHash(), lobe = fit::tableKey(request.lobe);
    hash.add(std::as_bytes(std::span(content)));
    hash.add(std::as_bytes(std::span(lobe)));
    const std::array<double, 4> rest{kVersion, request.irradiance ? 1.0 : 0.0, request.widths.first,
                                     request.widths.second};
    hash.add(std::as_bytes(std::span(rest)));
    return hash.hex();
}

Cache::Cache() : Cache(cacheFolder("environment")) {}

std::optional<Prefiltered> Cache::find(const std::string& key) const {
    if (folder_.empty()) return {};
    std::ifstream file(fileOf(key), std::ios::binary);
    std::array<char, sizeof(Header)> head{};
    if (!file.read(head.data(), head.size())) return {};
    Header header;
    std::memcpy(&header, head.data(), sizeof(header));
    if (!good(header, key)) return {};
    Prefiltered made;
    made.width = header.width;
    made.height = header.height;
    made.layers.assign(header.squares.begin(), header.squares.begin() + header.layers);
    made.irradiance = header.irradiance;
    made.tableX = header.tableX;
    made.tableY = header.tableY;
    made.tableRows = header.tableRows;
    made.firstLogWidth = header.firstLogWidth;
    made.rowsPerLogWidth = header.rowsPerLogWidth;
    made.texels.resize(4 * static_cast<size_t>(made.width) * static_cast<size_t>(made.height));
    if (!file.read(reinterpret_cast<char*>(made.texels.data()),
                   static_cast<std::streamsize>(made.texels.size() * sizeof(float))) ||
        file.peek() != EOF || header.content != contentOf(made.texels))
        return {};
    return made;
}

void Cache::keep(const std::string& key, const Prefiltered& made) const {
    if (folder_.empty()) return;
    Header header;
    header.width = made.width;
    header.height = made.height;
    header.layers = static_cast<int32_t>(made.layers.size());
    std::copy(made.layers.begin(), made.layers.end(), header.squares.begin());
    header.irradiance = made.irradiance;
    header.tableX = made.tableX;
    header.tableY = made.tableY;
    header.tableRows = made.tableRows;
    header.firstLogWidth = made.firstLogWidth;
    header.rowsPerLogWidth = made.rowsPerLogWidth;
    header.key = characters(key);
    header.content = contentOf(made.texels);
    std::string bytes(sizeof(header) + made.texels.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), &header, sizeof(header));
    std::memcpy(bytes.data() + sizeof(header), made.texels.data(), made.texels.size() * sizeof(float));
    try {
        writeAtomically(fileOf(key), bytes);
    } catch (const Error&) {
        return;  // a full or read-only disk costs time, nothing else
    }
}

}  // namespace lobe::environment
