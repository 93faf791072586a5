/// What a command line or a batch file asks for, as a list of pictures to make.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config.hpp"
#include "settings.hpp"

namespace lobe::app {

/// One picture.
struct Shot {
    std::filesystem::path scene;
    Settings settings;
    int number = 1;   ///< running number n, over all shots of the command
    int frame = 0;    ///< of settings' frames
    std::string output;
};

/// A change to a setting by the command line, in its order.
struct Assignment {
    enum class Kind { set, reset } kind = Kind::set;
    std::string key;
    std::string value;
};

/// Where settings come from, weakest first: configs, preset and shot of a batch, the command line.
struct SettingSources {
    std::vector<Config> configs;
    std::vector<Assignment> assignments;

    Settings resolve(const std::string& scene, const std::vector<std::pair<nlohmann::json, std::string>>& batchLayers = {}) const;
};

/// Scene files below folders, in order of name; files as given. Throws InputError for what does not exist.
std::vector<std::filesystem::path> sceneFiles(const std::vector<std::string>& inputs);

/// Shots for scenes named on the command line: all frames of each.
std::vector<Shot> shotsOf(const std::vector<std::filesystem::path>& scenes, const SettingSources& sources);

/// Shots of a batch file (docs/batch.md).
std::vector<Shot> shotsOfBatch(const std::filesystem::path& file, const SettingSources& sources);

/// Fills in output names and refuses two shots with one name, unknown extensions, and layers in files without layers.
void nameOutputs(std::vector<Shot>& shots);

/// Every Nth shot from the Ith: a partition for I = 1..N. `text` is "I/N"; throws UsageError.
std::vector<Shot> shard(const std::vector<Shot>& shots, const std::string& text);

}  // namespace lobe::app
