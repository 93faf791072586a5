#include <imgui.h>

#include "panels.hpp"
#include "style.hpp"
#include "viewer.hpp"

namespace lobe::view {

void drawLogPanel(Viewer& viewer) {
    if (ImGui::Button("Clear")) viewer.messages.clear();
    ImGui::SameLine();
    if (ImGui::Button("Copy")) {
        std::string all;
        for (const Message& message : viewer.messages.list())
            all += message.text + "\n";
        ImGui::SetClipboardText(all.c_str());
    }
    ImGui::BeginChild("messages");
    for (const Message& message : viewer.messages.list()) {
        ImGui::TextDisabled("%7.1f s", message.time);
        ImGui::SameLine();
        if (message.isError) ImGui::PushStyleColor(ImGuiCol_Text, kErrorColor);
        ImGui::TextWrapped("%s", message.text.c_str());
        if (message.isError) ImGui::PopStyleColor();
    }
    if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY()) ImGui::SetScrollHereY(1.0F);
    ImGui::EndChild();
}

void drawPixelPanel(Viewer& viewer) {
    ImGui::Checkbox("Explain the pixel that is clicked (I)", &viewer.ui.inspect);
    viewer.mark("explain");
    ImGui::BeginChild("pixel", {0.0F, 0.0F}, false, ImGuiWindowFlags_HorizontalScrollbar);
    if (viewer.explanation.empty())
        ImGui::TextWrapped(
            "Surface, parameters, each light's share with its terms and visibility, the truth, and "
            "what the picture has, as lobe explain prints them.");
    else
        ImGui::TextUnformatted(viewer.explanation.c_str());
    ImGui::EndChild();
}

}  // namespace lobe::view
