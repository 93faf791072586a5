#include "config.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "model_files.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// One way to match a path, with how it is spelt: {"glob": "*.glb"}.
struct Matcher {
    std::string kind, pattern;

    bool operator()(const std::string& path) const {
        if (kind == "exact") return path == pattern;
        if (kind == "glob") return matchesGlob(pattern, path);
        return std::regex_search(path, std::regex(pattern));
    }
};

Matcher matcherOf(const json& match, const std::string& where) {
    Matcher matcher{"glob", {}};
    if (match.is_string()) {
        matcher.pattern = match.get<std::string>();
    } else if (match.is_object() && match.size() == 1 && match.front().is_string()) {
        matcher = {match.begin().key(), match.front().get<std::string>()};
    }
    const bool known = matcher.kind == "glob" || matcher.kind == "exact" || matcher.kind == "regex";
    if (!known || matcher.pattern.empty())
        throw UsageError(where + ".match: " + match.dump() +
                         "; expected a pattern, or {\"glob\"|\"exact\"|\"regex\": \"...\"}");
    try {
        if (matcher.kind == "regex") std::regex{matcher.pattern};
    } catch (const std::regex_error&) {
        throw UsageError(where + ".match: regex '" + matcher.pattern + "'; expected a regular expression");
    }
    return matcher;
}

std::string blockName(const std::string& origin, size_t index) {
    return origin + ": [" + std::to_string(index) + "]";
}

void requireBlock(const json& block, const std::string& where) {
    if (!block.is_object() || !block.contains("settings"))
        throw UsageError(where + ": expected {\"match\": ..., \"settings\": {...}}");
    for (const auto& [key, value] : block.items())
        if (key != "match" && key != "settings")
            throw UsageError(where + ": unknown key '" + key + "'; expected match or settings" +
                             didYouMean(key, {"match", "settings"}));
    if (block.contains("match")) matcherOf(block["match"], where);
    Settings().setAll(block["settings"], where);
}

}  // namespace

bool matchesGlob(const std::string& pattern, const std::string& text) {
    return fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
}

json readJsonFile(const fs::path& file) {
    std::error_code failed;
    if (fs::is_directory(file, failed))
        throw InputError(file.string() + ": is a folder; expected a JSON file");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError(file.string() + ": cannot be read; expected a JSON file");
    std::ostringstream text;
    text << stream.rdbuf();
    const std::string content = text.str();
    try {
        return json::parse(content, nullptr, true, true);
    } catch (const json::parse_error& error) {
        const size_t upTo = std::min<size_t>(error.byte, content.size());
        const std::string before = content.substr(0, upTo);
        const auto line = 1 + std::count(before.begin(), before.end(), '\n');
        const size_t column = before.size() - (before.rfind('\n') + 1);
        throw InputError(file.string() + ":" + std::to_string(line) + ":" + std::to_string(column) +
                         ": not JSON");
    } catch (const json::exception&) {  // a number that no double holds
        throw InputError(file.string() + ": has a number out of range; expected JSON");
    }
}

Config::Config(json content, std::string origin) : content_(std::move(content)), origin_(std::move(origin)) {
    if (content_.is_object()) {
        Settings().setAll(content_, origin_);
        return;
    }
    if (!content_.is_array())
        throw UsageError(origin_ + ": " + content_.type_name() +
                         "; expected an object of settings or a list of blocks");
    for (size_t i = 0; i < content_.size(); ++i)
        requireBlock(content_[i], blockName(origin_, i));
}

void Config::apply(const fs::path& scene, Settings& settings) const {
    if (content_.is_object()) return settings.setAll(content_, origin_);
    std::error_code ignored;
    const std::string given = scene.string();
    const std::string absolute = fs::absolute(scene, ignored).lexically_normal().string();
    for (size_t i = 0; i < content_.size(); ++i) {
        const json& block = content_[i];
        const std::string where = blockName(origin_, i);
        if (block.contains("match")) {
            const Matcher matches = matcherOf(block["match"], where);
            if (!matches(given) && !matches(absolute)) continue;
        }
        settings.setAll(block["settings"], where);
    }
}

Config configFrom(const fs::path& file) {
    json content = withFilesIn(file.parent_path(), readJsonFile(file));
    if (content.is_array())
        for (json& block : content)
            if (block.is_object() && block.contains("settings"))
                block["settings"] = withFilesIn(file.parent_path(), block["settings"]);
    return {std::move(content), file.string()};
}

std::vector<Config> configsIn(const fs::path& folder) {
    std::vector<Config> configs;
    std::error_code ignored;
    if (fs::exists(folder / "config.json", ignored)) configs.push_back(configFrom(folder / "config.json"));
    std::vector<fs::path> parts;
    for (const auto& entry : fs::directory_iterator(folder / "config.d", ignored))
        if (entry.path().extension() == ".json") parts.push_back(entry.path());
    std::sort(parts.begin(), parts.end());
    for (const fs::path& part : parts)
        configs.push_back(configFrom(part));
    return configs;
}

std::vector<Config> standardConfigs() {
    std::vector<Config> configs = configsIn("/etc/lobe");
    const char* xdg = std::getenv("XDG_CONFIG_HOME");
    const char* home = std::getenv("HOME");
    fs::path user;
    if (xdg != nullptr && *xdg == '/')  // the XDG specification: a relative path is to be ignored
        user = xdg;
    else if (home != nullptr && *home != '\0')
        user = fs::path(home) / ".config";
    if (!user.empty())
        for (Config& config : configsIn(user / "lobe"))
            configs.push_back(std::move(config));
    return configs;
}

}  // namespace lobe::app
