/// All that keys and menus do, once: the menus, the keys and the cheat sheet follow from this table.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace lobe::view {

struct Viewer;

struct Command {
    std::string menu;  ///< "File"; empty: only a key
    std::string name;  ///< "Open..."
    int key = 0;       ///< GLFW's; 0: none
    bool control = false, shift = false;
    std::function<void(Viewer&)> run;
    std::function<std::string(const Viewer&)> whyNot =
        {};                                        ///< why it would do nothing now; empty text: it would
    std::function<bool(const Viewer&)> isOn = {};  ///< of what can be on and off

    std::string keyText() const;                            ///< "Ctrl+Shift+R"
    std::string reasonAgainst(const Viewer& viewer) const;  ///< whyNot, where there is one
};

const std::vector<Command>& commandTable();

/// Runs what the keys pressed in this frame ask for, and flies with those that are held.
void handleKeys(Viewer& viewer, double seconds);

void drawMenus(Viewer& viewer);
void drawCheatSheet(Viewer& viewer);

}  // namespace lobe::view
