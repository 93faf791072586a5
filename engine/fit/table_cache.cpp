#include "fit/table_cache.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>

#include "base/atomic_file.hpp"
#include "base/content_hash.hpp"
#include "base/error.hpp"
#include "base/resources.hpp"

namespace lobe::fit {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kMagic = 0x46424f4c;  // "LOBF"

/// Before the texels; then comes a hash of them.
struct Header {
    uint32_t magic = kMagic;
    int32_t version = kFitVersion;
    int32_t terms = 0;
    int32_t cosines = 0;
    uint64_t floats = 0;
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

bool fits(const Header& header, const std::vector<float>& texels) {
    const auto isCount = [](float number) {
        return number >= 1.0f && number <= 1e4f && number == std::floor(number);
    };
    if (texels.size() < 4 || !isCount(texels[0]) || !isCount(texels[1])) return false;
    AreaTable table{header.terms, header.cosines != 0, texels};
    const size_t nodes = static_cast<size_t>(table.angles()) * static_cast<size_t>(table.widths());
    return texels.size() == 4 * (1 + nodes * static_cast<size_t>(table.nodeTexels())) &&
           std::all_of(texels.begin(), texels.end(), [](float number) { return std::isfinite(number); });
}

}  // namespace

std::string tableKey(const TableRequest& request) {
    ContentHash hash;
    hash.add(std::as_bytes(std::span(request.brdf->name)));
    const ParameterValues values = normalised(request).values;
    hash.add(std::as_bytes(std::span(values)));
    const std::array<int, 3> rest{kFitVersion, request.colorsVary ? 1 : 0, request.widthVaries ? 1 : 0};
    hash.add(std::as_bytes(std::span(rest)));
    return hash.hex();
}

TableCache::TableCache() : TableCache(cacheFolder("fits")) {}

std::optional<AreaTable> TableCache::find(const std::string& key) const {
    if (folder_.empty()) return {};
    std::ifstream file(fileOf(key), std::ios::binary);
    std::array<char, sizeof(Header)> head{};
    if (!file.read(head.data(), head.size())) return {};
    Header header;
    std::memcpy(&header, head.data(), sizeof(header));
    constexpr uint64_t kMostFloats = 1U << 24;
    if (header.magic != kMagic || header.version != kFitVersion || header.key != characters(key) ||
        header.terms < 0 || header.terms > 2 || header.floats > kMostFloats)
        return {};
    std::vector<float> texels(header.floats);
    std::vector<char> bytes(texels.size() * sizeof(float));
    if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) || file.peek() != EOF) return {};
    std::memcpy(texels.data(), bytes.data(), bytes.size());
    if (header.content != contentOf(texels) || !fits(header, texels)) return {};
    return AreaTable{header.terms, header.cosines != 0, std::move(texels)};
}

void TableCache::keep(const std::string& key, const AreaTable& table) const {
    if (folder_.empty()) return;
    Header header;
    header.terms = table.terms;
    header.cosines = table.cosines ? 1 : 0;
    header.floats = table.texels.size();
    header.key = characters(key);
    header.content = contentOf(table.texels);
    std::string bytes(sizeof(header) + table.texels.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), &header, sizeof(header));
    std::memcpy(bytes.data() + sizeof(header), table.texels.data(), table.texels.size() * sizeof(float));
    try {
        writeAtomically(fileOf(key), bytes);
    } catch (const Error&) {
        return;  // a full or read-only disk costs time, nothing else
    }
}

AreaTable TableCache::table(const TableRequest& request) const {
    return tables({request}).front();
}

std::vector<AreaTable> TableCache::tables(const std::vector<TableRequest>& requests) const {
    std::vector<AreaTable> result(requests.size());
    std::vector<std::string> keys;
    std::map<std::string, size_t> missing;  // the first request of each
    for (size_t i = 0; i < requests.size(); ++i) {
        keys.push_back(tableKey(requests[i]));
        if (std::optional<AreaTable> found = find(keys[i]))
            result[i] = std::move(*found);
        else
            missing.emplace(keys[i], i);
    }
    std::vector<size_t> jobs;
    for (const auto& [key, index] : missing)
        jobs.push_back(index);
    if (!jobs.empty()) {
        ThreadTeam team;
        for (size_t job : jobs) {
            result[job] = makeTable(normalised(requests[job]), team);
            keep(keys[job], result[job]);
        }
    }
    for (size_t i = 0; i < requests.size(); ++i)
        if (result[i].texels.empty()) result[i] = result[missing.at(keys[i])];
    return result;
}

}  // namespace lobe::fit
