/// Tables that were fitted, kept between runs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/number_store.hpp"
#include "fit/area_table.hpp"

namespace lobe::fit {

/// What a table is of: a hash of the model's name, the values (with the model's own table) and the version of
/// the fits.
std::string tableKey(const TableRequest& request);

/// Those of a folder (base/number_store.hpp).
class TableCache {
public:
    /// In $XDG_CACHE_HOME/lobe/fits, else ~/.cache/lobe/fits; without a home nothing is kept.
    TableCache();
    explicit TableCache(std::filesystem::path folder) : store_(std::move(folder), ".fit", kFitVersion) {}

    std::optional<AreaTable> find(const std::string& key) const;
    /// Failing to keep it is no error: it is fitted again.
    void keep(const std::string& key, const AreaTable& table) const;
    /// From the folder, else fitted and kept.
    AreaTable table(const TableRequest& request) const;
    /// Several; those that are missing are fitted, each on all cores.
    std::vector<AreaTable> tables(const std::vector<TableRequest>& requests) const;

private:
    NumberStore store_;
};

}  // namespace lobe::fit
