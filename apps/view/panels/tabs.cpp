// The side with the panels, and the bar below.
#include <imgui.h>

#include <algorithm>

#include "panels.hpp"
#include "style.hpp"
#include "viewer.hpp"

namespace lobe::view {

void drawPanels(Viewer& viewer) {
    static constexpr void (*kDraw[])(Viewer&) = {drawSettingsPanel, drawMaterialsPanel, drawLightsPanel,
                                                 drawComparePanel,  drawPlanPanel,      drawTimePanel,
                                                 drawPixelPanel,    drawLogPanel};
    const ImGuiViewport& viewport = *ImGui::GetMainViewport();
    const float bar = ImGui::GetFrameHeight(), scale = viewer.window.scale();
    float& width = viewer.preferences.panelWidth;
    width = std::clamp(width, 250.0F, std::max(250.0F, viewport.Size.x / scale - 200.0F));
    const ImVec2 low(viewport.Size.x - width * scale, std::ceil(bar));
    ImGui::SetNextWindowPos(low);
    ImGui::SetNextWindowSize({width * scale, viewport.Size.y - low.y - bar});
    ImGui::Begin("panels", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    // The border to the picture can be dragged.
    const ImVec2 cursor = ImGui::GetCursorPos();
    ImGui::SetCursorPos({0.0F, 0.0F});
    ImGui::InvisibleButton("border", {6.0F * scale, ImGui::GetWindowHeight()});
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActive()) width -= ImGui::GetIO().MouseDelta.x / scale;
    ImGui::SetCursorPos(cursor);
    if (ImGui::BeginTabBar("tabs", ImGuiTabBarFlags_FittingPolicyScroll)) {
        for (size_t i = 0; i < kPanelCount; ++i) {
            const auto panel = static_cast<Panel>(i);
            const bool asked = viewer.ui.panelAsked && viewer.ui.panel == panel;
            const bool open =
                ImGui::BeginTabItem(nameOf(panel), nullptr, asked ? ImGuiTabItemFlags_SetSelected : 0);
            viewer.mark(std::string("tab ") + nameOf(panel));
            if (!open) continue;
            if (!viewer.ui.panelAsked || asked) {
                if (viewer.ui.panelShown != panel) viewer.events.add("panel", {{"name", nameOf(panel)}});
                viewer.ui.panelShown = viewer.ui.panel = panel;
            }
            kDraw[i](viewer);
            ImGui::EndTabItem();
        }
        viewer.ui.panelAsked = false;
        ImGui::EndTabBar();
    }
    ImGui::End();
}

void drawStatusBar(Viewer& viewer) {
    const ImGuiViewport& viewport = *ImGui::GetMainViewport();
    const float bar = ImGui::GetFrameHeight();
    ImGui::SetNextWindowPos({0.0F, viewport.Size.y - bar});
    ImGui::SetNextWindowSize({viewport.Size.x, bar});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8.0F, 2.0F});
    ImGui::Begin("status", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleVar();
    if (viewer.frame) {
        const Frame& frame = *viewer.frame;
        ImGui::Text("%s   %dx%d%s   %.1f ms", viewer.document.file().filename().string().c_str(), frame.width,
                    frame.height, frame.moving ? " (moving)" : "", frame.drawMs);
        ImGui::SameLine(0.0F, 24.0F);
    }
    if (!viewer.messages.list().empty()) {
        const Message& last = viewer.messages.list().back();
        const std::string line = last.text.substr(0, last.text.find('\n'));
        if (last.isError)
            ImGui::TextColored(kErrorColor, "%s", line.c_str());
        else
            ImGui::TextDisabled("%s", line.c_str());
        if (ImGui::IsItemHovered()) {
            ImGui::BeginTooltip();
            ImGui::PushTextWrapPos(ImGui::GetFontSize() * 50.0F);
            ImGui::TextUnformatted(last.text.c_str());
            ImGui::PopTextWrapPos();
            ImGui::EndTooltip();
        }
        if (ImGui::IsItemClicked()) viewer.showPanel(Panel::log);
    }
    ImGui::End();
}

}  // namespace lobe::view
