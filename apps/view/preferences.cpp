#include "preferences.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"

namespace lobe::view {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr size_t kMostRecent = 12;

fs::path fileOfUser() {
    const char* xdg = std::getenv("XDG_CONFIG_HOME");
    const char* home = std::getenv("HOME");
    if (xdg != nullptr && *xdg == '/') return fs::path(xdg) / "lobe" / "view.json";
    if (home != nullptr && *home != '\0') return fs::path(home) / ".config" / "lobe" / "view.json";
    return {};
}

json vectorOf(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

glm::dvec3 vectorFrom(const json& v) {
    return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
}

void read(Preferences& preferences, const json& file) {
    preferences.recent = file.value("recent", preferences.recent);
    preferences.width = std::clamp(file.value("width", preferences.width), 320, 16384);
    preferences.height = std::clamp(file.value("height", preferences.height), 240, 16384);
    preferences.panelWidth = std::clamp(file.value("panel_width", preferences.panelWidth), 250.0F, 2000.0F);
    preferences.panels = file.value("panels", preferences.panels);
    preferences.folder = file.value("folder", preferences.folder);
    const json views = file.value("views", json::object());
    for (const auto& [scene, named] : views.items())
        for (const auto& [name, pose] : named.items())
            preferences.views[scene][name] = {vectorFrom(pose.at("position")), vectorFrom(pose.at("focal")),
                                              pose.at("view_angle").get<double>()};
}

}  // namespace

void Preferences::addRecent(const std::string& file) {
    std::erase(recent, file);
    recent.insert(recent.begin(), file);
    if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

Preferences Preferences::load() {
    Preferences preferences;
    std::ifstream stream(fileOfUser(), std::ios::binary);
    if (!stream) return preferences;
    try {
        read(preferences, json::parse(stream));
    } catch (const json::exception&) {
        return {};
    }
    return preferences;
}

void Preferences::save() const {
    const fs::path file = fileOfUser();
    if (file.empty()) return;
    json stored = {{"recent", recent},          {"width", width},   {"height", height},
                   {"panel_width", panelWidth}, {"panels", panels}, {"folder", folder},
                   {"views", json::object()}};
    for (const auto& [scene, named] : views)
        for (const auto& [name, pose] : named)
            stored["views"][scene][name] = {{"position", vectorOf(pose.position)},
                                            {"focal", vectorOf(pose.focal)},
                                            {"view_angle", pose.viewAngle}};
    try {
        fs::create_directories(file.parent_path());
        writeAtomically(file.string(), stored.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
    } catch (const std::exception&) {
        return;  // as it was next time
    }
}

}  // namespace lobe::view
