/// Waits for files to change.
#pragma once

#include <filesystem>
#include <map>
#include <vector>

namespace lobe::app {

/// When files were last written, by path; those that do not exist have none.
class FileTimes {
public:
    /// Looks at `files` now.
    explicit FileTimes(const std::vector<std::filesystem::path>& files);
    bool operator==(const FileTimes&) const = default;

private:
    std::map<std::filesystem::path, std::filesystem::file_time_type> times_;
};

}  // namespace lobe::app
