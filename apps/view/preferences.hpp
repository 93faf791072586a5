/// What is kept between runs: files opened last, saved views, and how the window was.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pose.hpp"

namespace lobe::view {

struct Preferences {
    std::vector<std::string> recent;  ///< files, the last first
    int width = 1280, height = 800;   ///< of the window, points
    float panelWidth = 390.0F;        ///< points at 96 dots an inch
    bool panels = true;
    std::string folder;                                        ///< of the open dialog
    std::map<std::string, std::map<std::string, Pose>> views;  ///< by scene file and name

    void addRecent(const std::string& file);

    /// From $XDG_CONFIG_HOME/lobe/view.json, else ~/.config/lobe/view.json. What is absent or damaged is as
    /// at first.
    static Preferences load();
    void save() const;  ///< failing is no error
};

}  // namespace lobe::view
