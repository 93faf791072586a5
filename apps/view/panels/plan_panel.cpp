#include <imgui.h>

#include "panels.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

void drawLines(const char* title, const std::vector<std::string>& lines) {
    if (lines.empty() || !ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen)) return;
    for (const std::string& line : lines) {
        ImGui::Bullet();
        ImGui::TextWrapped("%s", line.c_str());
    }
}

void drawReason(const std::string& name, const std::string& detail, const std::string& reason) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", name.c_str());
    if (!detail.empty()) ImGui::TextDisabled("%s", detail.c_str());
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", reason.c_str());
}

bool beginReasons(const char* title) {
    if (!ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen)) return false;
    if (!ImGui::BeginTable(title, 2, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_RowBg)) return false;
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch, 0.36F);
    ImGui::TableSetupColumn("why", ImGuiTableColumnFlags_WidthStretch, 0.64F);
    return true;
}

}  // namespace

void drawPlanPanel(Viewer& viewer) {
    const DrawnScene* drawn = viewer.drawn();
    if (drawn == nullptr) return ImGui::TextDisabled("no picture yet");
    const FramePlan& plan = drawn->plan;
    ImGui::Text("%zu passes, %d samples a pixel, G-buffer %d bytes a pixel", plan.passes.size(), plan.samples,
                plan.gbufferBytesPerPixel());
    ImGui::BeginChild("plan");
    if (beginReasons("Runs")) {
        for (const PlannedPass& pass : plan.passes)
            drawReason(pass.name,
                       pass.variants.size() > 1 ? std::to_string(pass.variants.size()) + " variants" : "",
                       pass.reason);
        ImGui::EndTable();
    }
    viewer.mark("plan runs");
    if (beginReasons("Left out")) {
        for (const LeftOut& left : plan.leftOut)
            drawReason(left.name, left.kind, left.reason);
        ImGui::EndTable();
    }
    if (beginReasons("Channels")) {
        for (const Channel& channel : plan.channels)
            drawReason(channel.name, channel.format + ", " + std::to_string(channel.bytesPerPixel) + " bytes",
                       channel.holds + "; " + channel.reason);
        ImGui::EndTable();
    }
    drawLines("Lights", plan.lightGroups);
    drawLines("Textures", plan.textures);
    drawLines("Notes", plan.notes);
    ImGui::EndChild();
}

}  // namespace lobe::view
