/// What a command line or a batch file asks for, as a list of pictures to make.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "config.hpp"
#include "settings.hpp"

namespace lobe::app {

/// One picture.
struct Shot {
    std::filesystem::path scene;
    std::shared_ptr<const Settings> settings;  ///< one for all frames of a turntable
    int number = 1;                            ///< running number n, over all shots of the command
    int frame = 0;                             ///< of settings' frames
    std::string output;
};

/// A change to a setting by the command line, in its order.
struct Assignment {
    enum class Kind { set, reset } kind = Kind::set;
    std::string key;
    nlohmann::json value;  ///< text; of settings that take several, all that were given
};

/// Settings that one place of a batch file gives, and that place's name.
using SettingLayer = std::pair<nlohmann::json, std::string>;

/// Where settings come from, weakest first: configs, preset and shot of a batch, the command line.
struct SettingSources {
    std::vector<Config> configs;
    std::vector<Assignment> assignments;

    Settings resolve(const std::filesystem::path& scene,
                     const std::vector<SettingLayer>& batchLayers = {}) const;
};

/// Scene files below folders, in order of name; files as given, whether they exist or not; "-" is standard
/// input. Throws InputError for a folder without scenes.
std::vector<std::filesystem::path> sceneFiles(const std::vector<std::string>& inputs);

/// Appends all frames that the settings ask for.
void addFrames(std::vector<Shot>& shots, const std::filesystem::path& scene, Settings settings);

/// Shots for scenes named on the command line: all frames of each.
std::vector<Shot> shotsOf(const std::vector<std::filesystem::path>& scenes, const SettingSources& sources);

/// Every Nth shot from the Ith: a partition for I = 1..N. `text` is "I/N"; throws UsageError.
std::vector<Shot> shard(const std::vector<Shot>& shots, const std::string& text);

}  // namespace lobe::app
