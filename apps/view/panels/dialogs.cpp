// Opening and saving by name: a list of files, with what Lobe reads.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "gltf_export.hpp"
#include "output_name.hpp"
#include "panels.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

namespace fs = std::filesystem;

struct Entry {
    std::string name;
    bool isFolder;
};

/// What can be opened in a folder; folders first.
std::vector<Entry> entriesOf(const fs::path& folder) {
    static const std::set<std::string> known = {".gltf", ".glb",  ".hdr",  ".exr",    ".png", ".jpg",
                                                ".jpeg", ".webp", ".glsl", ".binary", ".json"};
    std::vector<Entry> entries;
    std::error_code failed;
    fs::directory_iterator item(folder, fs::directory_options::skip_permission_denied, failed);
    for (; !failed && item != fs::directory_iterator(); item.increment(failed)) {
        std::error_code unknown;
        const bool isFolder = item->is_directory(unknown);
        const std::string name = item->path().filename().string();
        if (name.starts_with(".")) continue;
        if (isFolder || known.contains(app::lowerExtension(item->path())))
            entries.push_back({name, isFolder});
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return std::pair(!a.isFolder, a.name) < std::pair(!b.isFolder, b.name);
    });
    return entries;
}

fs::path folderOf(const std::string& path) {
    std::error_code failed;
    if (!path.empty() && fs::is_directory(path, failed)) return path;
    const fs::path parent = fs::path(path).parent_path();
    return !parent.empty() && fs::is_directory(parent, failed) ? parent : fs::current_path(failed);
}

bool beginDialog(const char* title, bool& asked) {
    if (std::exchange(asked, false)) ImGui::OpenPopup(title);
    const ImGuiViewport& viewport = *ImGui::GetMainViewport();
    ImGui::SetNextWindowPos(viewport.GetCenter(), ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({0.6F * viewport.Size.x, 0.7F * viewport.Size.y});
    return ImGui::BeginPopupModal(title, nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
}

}  // namespace

void drawOpenDialog(Viewer& viewer) {
    static fs::path listed;
    static std::vector<Entry> entries;
    if (viewer.ui.openDialog) listed.clear();
    if (!beginDialog("Open", viewer.ui.openDialog)) return;
    std::string& path = viewer.ui.openPath;
    ImGui::SetNextItemWidth(-1.0F);
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    const bool entered =
        ImGui::InputTextWithHint("##path", "file or folder", &path, ImGuiInputTextFlags_EnterReturnsTrue);
    viewer.mark("open path");
    const fs::path folder = folderOf(path);
    if (folder != listed) {
        listed = folder;
        entries = entriesOf(folder);
    }
    std::string chosen;
    ImGui::BeginChild("files", {0.0F, -1.6F * ImGui::GetFrameHeight()}, true);
    if (ImGui::Selectable("..")) path = (fs::absolute(folder) / "..").lexically_normal().string();
    for (const Entry& entry : entries) {
        const std::string label = entry.isFolder ? entry.name + "/" : entry.name;
        if (!ImGui::Selectable(label.c_str(), false, ImGuiSelectableFlags_AllowDoubleClick)) continue;
        path = (folder / entry.name).string() + (entry.isFolder ? "/" : "");
        if (!entry.isFolder && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) chosen = path;
    }
    ImGui::EndChild();
    std::error_code ignored;
    if (entered && !fs::is_directory(path, ignored)) chosen = path;
    if (ImGui::Button("Open") && !path.empty()) chosen = path;
    viewer.mark("open button");
    ImGui::SameLine();
    const bool cancelled =
        ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
    viewer.mark("open cancel");
    if (!chosen.empty() || cancelled) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (chosen.empty()) return;
    viewer.preferences.folder = folderOf(chosen).string();
    viewer.open(chosen);
}

void drawSaveDialog(Viewer& viewer) {
    if (!beginDialog("Save picture", viewer.ui.saveDialog)) return;
    ImGui::TextWrapped(
        ".png and .jpg as it is shown; .exr and .hdr linear, .exr with all quantities of the setting "
        "aov; .json the state");
    ImGui::SetNextItemWidth(-1.0F);
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    const bool entered =
        ImGui::InputText("##path", &viewer.ui.savePath, ImGuiInputTextFlags_EnterReturnsTrue);
    const bool save = ImGui::Button("Save") || entered;
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || save || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)))
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (!save || viewer.ui.savePath.empty()) return;
    if (app::lowerExtension(viewer.ui.savePath) == ".json")
        viewer.attempt([&] { saveState(viewer, viewer.ui.savePath); });
    else
        viewer.savePicture(viewer.ui.savePath);
}

}  // namespace lobe::view
