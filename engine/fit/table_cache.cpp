#include "fit/table_cache.hpp"

#include <array>
#include <map>
#include <span>

#include "base/content_hash.hpp"
#include "base/resources.hpp"

namespace lobe::fit {
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
    std::optional<KeptNumbers> kept = store_.find(key);
    if (!kept || kept->facts.size() != 2) return {};
    return AreaTable{static_cast<int>(kept->facts[0]), kept->facts[1] != 0.0, std::move(kept->values)};
}

void TableCache::keep(const std::string& key, const AreaTable& table) const {
    store_.keep(key, {{double(table.terms), table.cosines ? 1.0 : 0.0}, table.texels});
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
