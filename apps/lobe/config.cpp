#include "config.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include "base/error.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

bool matches(const json& match, const std::string& scene, const std::string& origin) {
    if (match.is_string()) return matchesGlob(match.get<std::string>(), scene);
    if (match.is_object() && match.size() == 1) {
        const auto& [kind, value] = *match.items().begin();
        if (value.is_string()) {
            const std::string pattern = value.get<std::string>();
            if (kind == "glob") return matchesGlob(pattern, scene);
            if (kind == "exact") return pattern == scene;
            try {
                if (kind == "regex") return std::regex_search(scene, std::regex(pattern));
            } catch (const std::regex_error&) {
                throw UsageError(origin + ": match regex '" + pattern + "'; expected a regular expression");
            }
        }
    }
    throw UsageError(origin + ": match " + match.dump() + "; expected a pattern, or {\"glob\"|\"exact\"|\"regex\": \"...\"}");
}

void addFolder(std::vector<Config>& configs, const fs::path& folder) {
    std::error_code ignored;
    if (fs::is_regular_file(folder / "config.json", ignored))
        configs.emplace_back(readJsonFile(folder / "config.json"), (folder / "config.json").string());
    std::vector<fs::path> parts;
    for (const auto& entry : fs::directory_iterator(folder / "config.d", ignored))
        if (entry.path().extension() == ".json") parts.push_back(entry.path());
    std::sort(parts.begin(), parts.end());
    for (const fs::path& part : parts)
        configs.emplace_back(readJsonFile(part), part.string());
}

}  // namespace

bool matchesGlob(const std::string& pattern, const std::string& text) {
    return fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
}

json readJsonFile(const fs::path& file) {
    std::error_code failed;
    if (fs::is_directory(file, failed)) throw InputError(file.string() + ": is a folder; expected a JSON file");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError(file.string() + ": cannot be read; expected a JSON file");
    std::ostringstream text;
    text << stream.rdbuf();
    const std::string content = text.str();
    try {
        return json::parse(content, nullptr, true, true);
    } catch (const json::parse_error& error) {
        const size_t upTo = std::min<size_t>(error.byte, content.size());
        const auto line = 1 + std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(upTo), '\n');
        throw InputError(file.string() + ":" + std::to_string(line) + ": not JSON");
    }
}

Config::Config(json content, std::string origin) : content_(std::move(content)), origin_(std::move(origin)) {
    if (!content_.is_object() && !content_.is_array())
        throw UsageError(origin_ + ": " + content_.type_name() + "; expected an object of settings or a list of blocks");
}

void Config::apply(const std::string& scene, Settings& settings) const {
    if (content_.is_object()) return settings.setAll(content_, origin_);
    for (const json& block : content_) {
        if (!block.is_object() || !block.contains("settings"))
            throw UsageError(origin_ + ": block " + block.dump() + "; expected {\"match\": ..., \"settings\": {...}}");
        if (!block.contains("match") || matches(block["match"], scene, origin_)) settings.setAll(block["settings"], origin_);
    }
}

std::vector<Config> standardConfigs() {
    std::vector<Config> configs;
    addFolder(configs, "/etc/lobe");
    const char* xdg = std::getenv("XDG_CONFIG_HOME");
    const char* home = std::getenv("HOME");
    if (xdg != nullptr && *xdg != '\0')
        addFolder(configs, fs::path(xdg) / "lobe");
    else if (home != nullptr)
        addFolder(configs, fs::path(home) / ".config" / "lobe");
    return configs;
}

}  // namespace lobe::app
