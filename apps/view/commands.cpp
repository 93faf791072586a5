#include "commands.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "gltf_export.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

std::string needsScene(const Viewer& viewer) {
    return viewer.document.scene() ? "" : "no scene is open";
}

std::string needsPicture(const Viewer& viewer) {
    return viewer.frame ? "" : "there is no picture yet";
}

void look(Viewer& viewer, double azimuth, double elevation) {
    if (viewer.takeCamera()) viewer.camera.lookFrom(azimuth, elevation, viewer.pictureAspect());
}

void nextCamera(Viewer& viewer) {
    const std::vector<Camera>& cameras = viewer.document.scene()->cameras;
    const nlohmann::json& present = viewer.document.settings()->get("camera");
    size_t next = 0;
    for (size_t i = 0; i < cameras.size() && !viewer.document.pose(); ++i)
        if (present == cameras[i].name || present == std::to_string(i)) next = (i + 1) % cameras.size();
    if (present.is_null() && !viewer.document.pose())
        next = 1 % cameras.size();  // the first is shown already
    viewer.resetCamera();
    viewer.attempt([&] { viewer.document.change("camera", std::to_string(next)); });
    viewer.say("camera " + std::to_string(next) + " '" + cameras[next].name + "'");
}

void showNext(Viewer& viewer, int step) {
    const std::vector<Shown> choices = shownChoices(viewer.drawn()->plan);
    const auto found = std::find(choices.begin(), choices.end(), viewer.ui.shown);
    const auto count = static_cast<int>(choices.size());
    const int at = found == choices.end() ? 0 : static_cast<int>(found - choices.begin());
    viewer.ui.shown = choices[static_cast<size_t>((at + step + count) % count)];
    viewer.say("showing " + nameOf(viewer.ui.shown));
}

void toggleWipe(Viewer& viewer) {
    Comparison comparison;
    if (viewer.ui.comparison.with == Comparison::With::nothing) {
        comparison.with = Comparison::With::kept;
        comparison.keptSettings = viewer.document.settings();
        comparison.keptEdits = viewer.document.edits();
    }
    viewer.compareWith(comparison);
}

std::vector<Command> makeTable() {
    std::vector<Command> table = {
        {"File", "Open...", GLFW_KEY_O, true, false,
         [](Viewer& v) {
             v.ui.openDialog = true;
             v.ui.openPath = v.preferences.folder;
         }},
        {"File", "Gallery", GLFW_KEY_G, false, false, [](Viewer& v) { v.ui.startPage = !v.ui.startPage; },
         needsScene, [](const Viewer& v) { return v.ui.startPage; }},
        {"File", "Previous scene of the folder", GLFW_KEY_LEFT, false, false,
         [](Viewer& v) { v.openNeighbour(-1); }, needsScene},
        {"File", "Next scene of the folder", GLFW_KEY_RIGHT, false, false,
         [](Viewer& v) { v.openNeighbour(1); }, needsScene},
        {"File", "Load the scene again", GLFW_KEY_R, false, false, [](Viewer& v) { v.reloadScene(); },
         needsScene},
        {"File", "Reload shaders", GLFW_KEY_R, true, true, [](Viewer& v) { v.worker.reload(); }},
        {"File", "Save picture as...", GLFW_KEY_S, true, true,
         [](Viewer& v) {
             v.ui.saveDialog = true;
             v.ui.savePath = v.freeName(".png").string();
         },
         needsScene},
        {"File", "Save the window", GLFW_KEY_F12, false, false, [](Viewer& v) { v.wantsSave = true; }},
        {"File", "Save the picture", GLFW_KEY_F12, true, false,
         [](Viewer& v) { v.savePicture(v.freeName(".png")); }, needsScene},
        {"File", "Save state", GLFW_KEY_S, true, false,
         [](Viewer& v) { v.attempt([&] { saveState(v, v.freeName(".json")); }); }, needsScene},
        {"File", "Load state...", GLFW_KEY_L, true, false,
         [](Viewer& v) {
             v.ui.openDialog = true;
             v.ui.openPath = (std::filesystem::current_path() / "out").string();
         }},
        {"File", "Export the edited scene", GLFW_KEY_E, true, false,
         [](Viewer& v) { v.attempt([&] { exportEdited(v, v.freeName(".gltf")); }); }, needsScene},
        {"File", "Quit", GLFW_KEY_Q, true, false, [](Viewer& v) { v.window.close(); }},

        {"Edit", "Undo", GLFW_KEY_Z, true, false, [](Viewer& v) { v.document.undo(); },
         [](const Viewer& v) { return v.document.canUndo() ? "" : "nothing was changed"; }},
        {"Edit", "Redo", GLFW_KEY_Y, true, false, [](Viewer& v) { v.document.redo(); },
         [](const Viewer& v) { return v.document.canRedo() ? "" : "nothing was undone"; }},
        {"Edit", "Copy state", GLFW_KEY_C, true, false,
         [](Viewer& v) {
             ImGui::SetClipboardText(v.stateText().c_str());
             v.say("the state is in the clipboard");
         },
         needsScene},
        {"Edit", "Paste state", GLFW_KEY_V, true, false,
         [](Viewer& v) {
             const char* text = ImGui::GetClipboardText();
             v.useState(text != nullptr ? text : "", "clipboard");
         },
         needsScene},
        {"Edit", "Copy command line", GLFW_KEY_C, true, true,
         [](Viewer& v) {
             ImGui::SetClipboardText(v.commandLine().c_str());
             v.say(v.commandLine());
         },
         needsScene},
        {"Edit", "Take all changes back", 0, false, false, [](Viewer& v) { v.document.revertAll(); },
         needsScene},

        {"View", "Frame the scene", GLFW_KEY_F, false, false,
         [](Viewer& v) {
             if (v.takeCamera()) v.camera.frame(v.pictureAspect());
         },
         needsPicture},
        {"View", "Camera as at first", GLFW_KEY_ENTER, false, false, [](Viewer& v) { v.resetCamera(); },
         needsPicture},
        {"View", "Next camera of the scene", GLFW_KEY_C, false, false, nextCamera,
         [](const Viewer& v) {
             return !v.document.scene()                   ? "no scene is open"
                    : v.document.scene()->cameras.empty() ? "the scene has no camera"
                                                          : "";
         }},
        {"View", "From the front", GLFW_KEY_1, false, false, [](Viewer& v) { look(v, 0.0, 0.0); },
         needsPicture},
        {"View", "From the right", GLFW_KEY_3, false, false, [](Viewer& v) { look(v, 90.0, 0.0); },
         needsPicture},
        {"View", "From above", GLFW_KEY_7, false, false, [](Viewer& v) { look(v, 0.0, 90.0); }, needsPicture},
        {"View", "Show the next quantity", GLFW_KEY_V, false, false, [](Viewer& v) { showNext(v, 1); },
         needsPicture},
        {"View", "Show the previous quantity", GLFW_KEY_V, false, true, [](Viewer& v) { showNext(v, -1); },
         needsPicture},
        {"View", "Show the picture", GLFW_KEY_B, false, false, [](Viewer& v) { v.ui.shown = {}; },
         needsPicture},
        {"View",
         "Panels",
         GLFW_KEY_P,
         false,
         false,
         [](Viewer& v) { v.ui.panels = !v.ui.panels; },
         {},
         [](const Viewer& v) { return v.ui.panels; }},
        {"View", "Messages", GLFW_KEY_ESCAPE, false, false, [](Viewer& v) { v.showPanel(Panel::log); }},

        {"Compare", "Keep this picture and wipe", GLFW_KEY_X, false, false, toggleWipe, needsPicture,
         [](const Viewer& v) { return v.ui.comparison.with != Comparison::With::nothing; }},
        {"Compare", "With the truth", GLFW_KEY_T, false, false,
         [](Viewer& v) { v.compareWith({.with = Comparison::With::truth}); }, needsPicture},
        {"Compare", "Error against the truth", GLFW_KEY_T, false, true,
         [](Viewer& v) { v.compareWith({.with = Comparison::With::error}); }, needsPicture},
        {"Compare", "All models", GLFW_KEY_M, false, false,
         [](Viewer& v) { v.ui.modelGrid = !v.ui.modelGrid; }, needsPicture,
         [](const Viewer& v) { return v.ui.modelGrid; }},
        {"Compare", "Explain a pixel", GLFW_KEY_I, false, false,
         [](Viewer& v) {
             v.ui.inspect = !v.ui.inspect;
             if (v.ui.inspect) v.showPanel(Panel::pixel);
         },
         needsPicture, [](const Viewer& v) { return v.ui.inspect; }},

        {"Help",
         "Keys",
         GLFW_KEY_H,
         false,
         false,
         [](Viewer& v) { v.ui.help = !v.ui.help; },
         {},
         [](const Viewer& v) { return v.ui.help; }},
    };
    for (size_t i = 0; i < kPanelCount; ++i) {
        const auto panel = static_cast<Panel>(i);
        table.push_back({"Panels",
                         nameOf(panel),
                         GLFW_KEY_1 + static_cast<int>(i),
                         true,
                         false,
                         [panel](Viewer& v) { v.showPanel(panel); },
                         {},
                         [panel](const Viewer& v) { return v.ui.panels && v.ui.panel == panel; }});
    }
    return table;
}

/// Held keys: W A S D E Q.
void fly(Viewer& viewer, double seconds) {
    // Of Ctrl+E the E may be let go last.
    static std::set<int> pressedWithControl;
    if (const std::optional<Window::Key> pressed = viewer.window.key()) {
        if (pressed->control)
            pressedWithControl.insert(pressed->key);
        else
            pressedWithControl.erase(pressed->key);
    }
    if (ImGui::GetIO().KeyCtrl || viewer.window.hasKeys()) return;
    const auto held = [](int key) {
        return ImGui::IsKeyDown(key) && !pressedWithControl.contains(key) ? 1.0 : 0.0;
    };
    const glm::dvec3 way(held(GLFW_KEY_D) - held(GLFW_KEY_A), held(GLFW_KEY_E) - held(GLFW_KEY_Q),
                         held(GLFW_KEY_W) - held(GLFW_KEY_S));
    if (way == glm::dvec3(0.0) || !viewer.takeCamera()) return;
    const double diametersPerSecond = ImGui::GetIO().KeyShift ? 1.0 : 0.25;
    viewer.camera.fly(way, diametersPerSecond * std::min(seconds, 0.1));
}

}  // namespace

std::string Command::keyText() const {
    if (key == 0) return "";
    static const std::map<int, std::string> named = {{GLFW_KEY_LEFT, "Left"},
                                                     {GLFW_KEY_RIGHT, "Right"},
                                                     {GLFW_KEY_F12, "F12"},
                                                     {GLFW_KEY_ENTER, "Enter"},
                                                     {GLFW_KEY_ESCAPE, "Esc"}};
    const auto found = named.find(key);
    return std::string(control ? "Ctrl+" : "") + (shift ? "Shift+" : "") +
           (found != named.end() ? found->second : std::string(1, static_cast<char>(key)));
}

std::string Command::reasonAgainst(const Viewer& viewer) const {
    return whyNot ? whyNot(viewer) : "";
}

const std::vector<Command>& commandTable() {
    static const std::vector<Command> table = makeTable();
    return table;
}

void handleKeys(Viewer& viewer, double seconds) {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput || ImGui::IsAnyItemActive()) return;
    // Keys are those of dialogs, menus and lists while one is open.
    if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) return;
    const std::optional<Window::Key> pressed = viewer.window.key();
    for (const Command& command : commandTable()) {
        if (!pressed || pressed->key != command.key) continue;
        if (command.control != pressed->control || command.shift != pressed->shift) continue;
        // Arrows and Enter are ImGui's while one moves through its controls.
        const bool navigates =
            command.key == GLFW_KEY_LEFT || command.key == GLFW_KEY_RIGHT || command.key == GLFW_KEY_ENTER;
        if (navigates && io.NavVisible) continue;
        const std::string reason = command.reasonAgainst(viewer);
        if (!reason.empty())
            viewer.say(command.name + ": " + reason);
        else
            command.run(viewer);
        viewer.events.add("command",
                          {{"name", command.name}, {"key", command.keyText()}, {"done", reason.empty()}});
    }
    fly(viewer, seconds);
}

}  // namespace lobe::view
