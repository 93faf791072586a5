/// Configuration files, and the order in which they win (docs/cli.md): system, user, --config, --settings.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "settings.hpp"

namespace lobe::app {

/// A JSON file; throws InputError naming file and line for what is no JSON or not readable.
nlohmann::json readJsonFile(const std::filesystem::path& file);

/// A configuration: an object of settings, or a list of blocks {"match": ..., "settings": {...}}.
class Config {
public:
    /// Refuses whatever is wrong in any block, whether it will match a scene or not. Throws UsageError.
    Config(nlohmann::json content, std::string origin);
    /// Applies all settings, or those of the blocks that match the scene's path, as given or absolute.
    void apply(const std::filesystem::path& scene, Settings& settings) const;

private:
    nlohmann::json content_;
    std::string origin_;
};

/// The configuration in a file; names of files in it are relative to its folder. Throws InputError,
/// UsageError.
Config configFrom(const std::filesystem::path& file);

/// config.json and config.d/*.json of a folder, as far as they exist, in the order of precedence, weakest
/// first.
std::vector<Config> configsIn(const std::filesystem::path& folder);
/// Those of the system, then those of the user.
std::vector<Config> standardConfigs();

/// Shell pattern: * any text, ? any letter.
bool matchesGlob(const std::string& pattern, const std::string& text);

}  // namespace lobe::app
