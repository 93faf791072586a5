/// Tables that were fitted, kept between runs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "fit/area_table.hpp"

namespace lobe::fit {

/// What a table is of: a hash of the model's name, the values (with the model's own table) and the version of
/// the fits.
std::string tableKey(const TableRequest& request);

/// A folder of files, one a key. Files that are damaged, of another key or of another layout count as absent.
class TableCache {
public:
    /// In $XDG_CACHE_HOME/lobe/fits, else ~/.cache/lobe/fits; without a home nothing is kept.
    TableCache();
    explicit TableCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

    std::optional<AreaTable> find(const std::string& key) const;
    /// Failing to keep it is no error: it is fitted again.
    void keep(const std::string& key, const AreaTable& table) const;
    /// From the folder, else fitted and kept.
    AreaTable table(const TableRequest& request) const;
    /// Several; those that are missing are fitted, each on all cores.
    std::vector<AreaTable> tables(const std::vector<TableRequest>& requests) const;

private:
    std::filesystem::path fileOf(const std::string& key) const { return folder_ / (key + ".fit"); }
    std::filesystem::path folder_;
};

}  // namespace lobe::fit
