/// Results that are numbers and take time to make, kept between runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lobe {

/// What is kept under a key: a few numbers that say what the rest is, and the rest.
struct KeptNumbers {
    std::vector<double> facts;
    std::vector<float> values;
};

/// A folder of files, one a key. Files that are damaged, of another key, kind or version count as absent.
class NumberStore {
public:
    /// `kind` is the files' extension, ".fit". `version` changes whenever numbers under the same key would
    /// mean something else. An empty folder: nothing is kept.
    NumberStore(std::filesystem::path folder, std::string kind, int32_t version)
        : folder_(std::move(folder)), kind_(std::move(kind)), version_(version) {}

    std::optional<KeptNumbers> find(const std::string& key) const;
    /// Failing to keep them is no error: they are made again.
    void keep(const std::string& key, const KeptNumbers& numbers) const;

private:
    std::filesystem::path fileOf(const std::string& key) const { return folder_ / (key + kind_); }
    std::string checkOf(const std::string& key, const KeptNumbers& numbers) const;

    std::filesystem::path folder_;
    std::string kind_;
    int32_t version_;
};

}  // namespace lobe
