// Menus and the cheat sheet, from the table of commands.
#include <imgui.h>

#include <filesystem>

#include "commands.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

/// Named views of the scene, kept between runs.
void drawViews(Viewer& viewer) {
    if (!ImGui::BeginMenu("Kept views", viewer.document.scene() != nullptr)) return;
    auto& views = viewer.preferences
                      .views[std::filesystem::absolute(viewer.document.file()).lexically_normal().string()];
    if (ImGui::MenuItem("Keep this view", nullptr, false, viewer.frame.has_value()) && viewer.takeCamera()) {
        size_t number = 1;
        while (views.contains("view " + std::to_string(number)))
            ++number;
        views["view " + std::to_string(number)] = viewer.camera.pose();
    }
    viewer.mark("menu Keep this view");
    ImGui::Separator();
    std::string removed;
    for (const auto& [name, pose] : views) {
        if (ImGui::MenuItem(name.c_str()) && viewer.frame) {
            viewer.camera.adopt(pose, viewer.document.scene()->bounds());
            viewer.document.setPose(pose);
        }
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("right click: forget");
        if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) removed = name;
    }
    views.erase(removed);
    ImGui::EndMenu();
}

}  // namespace

void drawMenus(Viewer& viewer) {
    if (!ImGui::BeginMainMenuBar()) return;
    for (const char* menu : {"File", "Edit", "View", "Compare", "Panels", "Help"}) {
        const bool open = ImGui::BeginMenu(menu);
        viewer.mark(std::string("menu ") + menu);
        if (!open) continue;
        for (const Command& command : commandTable()) {
            if (command.menu != menu) continue;
            const std::string reason = command.reasonAgainst(viewer);
            const bool on = command.isOn && command.isOn(viewer);
            if (ImGui::MenuItem(command.name.c_str(), command.keyText().c_str(), on, reason.empty())) {
                command.run(viewer);
                viewer.events.add("command", {{"name", command.name}, {"done", true}});
            }
            viewer.mark("menu " + command.name);
            if (!reason.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
                ImGui::SetTooltip("%s", reason.c_str());
        }
        if (std::string(menu) == "File" && ImGui::BeginMenu("Recent", !viewer.preferences.recent.empty())) {
            for (const std::string& file : std::vector<std::string>(viewer.preferences.recent))
                if (ImGui::MenuItem(file.c_str())) viewer.open(file);
            ImGui::EndMenu();
        }
        if (std::string(menu) == "View") drawViews(viewer);
        ImGui::EndMenu();
    }
    ImGui::EndMainMenuBar();
}

void drawCheatSheet(Viewer& viewer) {
    if (!viewer.ui.help) return;
    const ImVec2 center = ImGui::GetMainViewport()->GetCenter();
    ImGui::SetNextWindowPos(center, ImGuiCond_Always, {0.5F, 0.5F});
    if (ImGui::Begin("Keys and mouse", &viewer.ui.help,
                     ImGuiWindowFlags_NoResize | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove)) {
        static const std::pair<const char*, const char*> mouse[] = {
            {"Left drag", "turn about the pivot"},
            {"Shift+left or middle drag", "move sideways"},
            {"Right drag, wheel", "nearer, farther"},
            {"Shift+right drag", "turn the environment"},
            {"Click", "choose the material"},
            {"Double click, middle click", "turn about that point"},
            {"W A S D, E Q", "fly, up and down; with Shift faster"},
            {"Ctrl+click on a slider", "type its value"},
            {"Right click on a setting", "take its change back"},
            {"Drop files", "scene, panorama, .glsl model, .binary table, settings, batch, report"}};
        if (ImGui::BeginTable("mouse", 2, ImGuiTableFlags_SizingFixedFit)) {
            for (const auto& [what, does] : mouse) {
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(what);
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(does);
            }
            ImGui::EndTable();
        }
        ImGui::Separator();
        if (ImGui::BeginTable("keys", 4, ImGuiTableFlags_SizingFixedFit)) {
            for (const Command& command : commandTable()) {
                if (command.key == 0) continue;
                const bool on = command.isOn && command.isOn(viewer);
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(command.keyText().c_str());
                ImGui::TableNextColumn();
                ImGui::BeginDisabled(!command.reasonAgainst(viewer).empty());
                ImGui::Text("%s%s   ", command.name.c_str(), on ? " (on)" : "");
                ImGui::EndDisabled();
            }
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

}  // namespace lobe::view
