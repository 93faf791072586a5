#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "panels.hpp"
#include "style.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

constexpr double kDegreesOfHeight = 180.0;  ///< that the environment turns over the picture's height

struct Rect {
    ImVec2 low, high;
    float width() const { return high.x - low.x; }
    float height() const { return high.y - low.y; }
    bool has(const ImVec2& p) const { return p.x >= low.x && p.x < high.x && p.y >= low.y && p.y < high.y; }
};

/// A pixel a pixel where there is room, else smaller, in the middle.
Rect placeOf(const Viewer& viewer, int width, int height) {
    const float unit = 1.0F / viewer.window.pixelsPerPoint();
    ImVec2 size(static_cast<float>(width) * unit, static_cast<float>(height) * unit);
    const float fit = std::min({1.0F, viewer.pictureWidth / size.x, viewer.pictureHeight / size.y});
    if (fit < 1.0F) size = {size.x * fit, size.y * fit};
    const ImVec2 low(viewer.pictureX + std::floor(0.5F * (viewer.pictureWidth - size.x)),
                     viewer.pictureY + std::floor(0.5F * (viewer.pictureHeight - size.y)));
    return {low, {low.x + size.x, low.y + size.y}};
}

/// Squares behind what is transparent.
void drawCheckers(ImDrawList& list, const Rect& rect) {
    list.AddRectFilled(rect.low, rect.high, IM_COL32(90, 90, 90, 255));
    constexpr float kSquare = 16.0F;
    for (int y = 0; static_cast<float>(y) * kSquare < rect.height(); ++y)
        for (int x = y % 2; static_cast<float>(x) * kSquare < rect.width(); x += 2) {
            const ImVec2 low(rect.low.x + static_cast<float>(x) * kSquare,
                             rect.low.y + static_cast<float>(y) * kSquare);
            list.AddRectFilled(
                low, {std::min(low.x + kSquare, rect.high.x), std::min(low.y + kSquare, rect.high.y)},
                IM_COL32(130, 130, 130, 255));
        }
}

void drawLegend(ImDrawList& list, const Legend& legend, ImVec2 at) {
    if (!legend.used) return;
    const float line = ImGui::GetTextLineHeight(), width = 18.0F * line, height = 0.8F * line;
    list.AddRectFilled({at.x - 8.0F, at.y - 8.0F}, {at.x + width + 8.0F, at.y + height + 2.4F * line},
                       IM_COL32(0, 0, 0, 190), 4.0F);
    constexpr int kSteps = 64;
    for (int i = 0; i < kSteps; ++i) {
        const auto color = falseColor((i + 0.5) / kSteps);
        list.AddRectFilled({at.x + width * static_cast<float>(i) / kSteps, at.y},
                           {at.x + width * static_cast<float>(i + 1) / kSteps, at.y + height},
                           IM_COL32(color[0], color[1], color[2], 255));
    }
    for (int i = 0; i <= 4; ++i) {
        const double share = i / 4.0;
        const double value = legend.logarithmic ? legend.low * std::pow(legend.high / legend.low, share)
                                                : legend.low + (legend.high - legend.low) * share;
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%.3g", value);
        const float x = at.x + width * static_cast<float>(share);
        const float wide = ImGui::CalcTextSize(text.data()).x;
        list.AddText({x - wide * static_cast<float>(share), at.y + height}, IM_COL32_WHITE, text.data());
    }
    list.AddText({at.x, at.y + height + line}, IM_COL32_WHITE, legend.quantity.c_str());
}

std::string titleOfOther(const Viewer& viewer) {
    const Comparison& comparison = viewer.ui.comparison;
    switch (comparison.with) {
        case Comparison::With::kept:
            return "kept";
        case Comparison::With::model:
            return comparison.model;
        case Comparison::With::truth:
        case Comparison::With::error: {
            const TruthState state = viewer.truth.state();
            std::array<char, 96> text{};
            if (!state.running && state.rounds == 0) return "no truth";
            std::snprintf(text.data(), text.size(), "%s, %s%.2g %%",
                          comparison.with == Comparison::With::truth ? "truth" : "error",
                          state.rounds > 0 ? "itself within " : "computing to ",
                          100.0 * (state.rounds > 0 ? state.relativeError : state.aim));
            return text.data();
        }
        case Comparison::With::nothing:
            break;
    }
    return "";
}

void drawTag(ImDrawList& list, ImVec2 at, const std::string& text, bool toTheLeft) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    if (toTheLeft) at.x -= size.x;
    list.AddRectFilled({at.x - 5.0F, at.y - 3.0F}, {at.x + size.x + 5.0F, at.y + size.y + 3.0F},
                       IM_COL32(0, 0, 0, 190), 3.0F);
    list.AddText(at, IM_COL32_WHITE, text.c_str());
}

/// What lies right of the wipe. Returns where the wipe is.
float drawOther(Viewer& viewer, ImDrawList& list, const Rect& rect) {
    const Comparison& comparison = viewer.ui.comparison;
    const float x = std::round(rect.low.x + rect.width() * comparison.wipe);
    if (viewer.otherPicture && !viewer.frame->moving) {
        list.PushClipRect({x, rect.low.y}, rect.high, true);
        list.AddImage(viewer.otherPicture.id(), rect.low, rect.high);
        list.PopClipRect();
    }
    list.AddLine({x, rect.low.y}, {x, rect.high.y}, IM_COL32(255, 255, 255, 220), 2.0F);
    drawTag(list, {x - 10.0F, rect.low.y + 8.0F}, "this", true);
    drawTag(list, {x + 10.0F, rect.low.y + 8.0F},
            titleOfOther(viewer) + (viewer.otherPicture ? "" : " (in work)"), false);
    return x;
}

/// The camera's mouse habits.
void dragCamera(Viewer& viewer, const Rect& rect) {
    const ImGuiIO& io = ImGui::GetIO();
    const double dx = double{io.MouseDelta.x}, dy = double{io.MouseDelta.y}, height = double{rect.height()};
    if (dx == 0.0 && dy == 0.0) return;
    const bool left = ImGui::IsMouseDown(ImGuiMouseButton_Left);
    const bool middle = ImGui::IsMouseDown(ImGuiMouseButton_Middle);
    const bool right = ImGui::IsMouseDown(ImGuiMouseButton_Right);
    if (right && io.KeyShift) {
        const DrawnScene* drawn = viewer.drawn();
        if (drawn == nullptr || !drawn->hasEnvironment) return;
        viewer.attempt([&] {
            const double turn = viewer.document.settings()->get("env_rotation").get<double>();
            viewer.document.change(
                "env_rotation", std::remainder(turn + dx / height * kDegreesOfHeight, 360.0), "env_rotation");
        });
        viewer.lastMoved = viewer.seconds();
        return;
    }
    if (!viewer.takeCamera()) return;
    if ((left && io.KeyShift) || middle)
        viewer.camera.pan(dx, dy, height);
    else if (left)
        viewer.camera.orbit(dx, dy, height);
    else if (right)
        viewer.camera.dolly(-dy / height * 20.0);
}

void useMouse(Viewer& viewer, const Rect& rect, float wipeX) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
    if (!viewer.frame) return;
    const bool comparing = viewer.ui.comparison.with != Comparison::With::nothing;
    static bool wiping = false, handling = false;
    const bool overHandle = drawLightHandles(viewer);
    const bool nearWipe = comparing && std::abs(io.MousePos.x - wipeX) < 8.0F * viewer.window.scale();
    if (hovered && nearWipe) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActivated()) {
        handling = overHandle;
        wiping = nearWipe && !handling && ImGui::IsMouseDown(ImGuiMouseButton_Left);
    }
    if (active && wiping)
        viewer.ui.comparison.wipe = std::clamp((io.MousePos.x - rect.low.x) / rect.width(), 0.0F, 1.0F);
    else if (active && !handling && !overHandle)
        dragCamera(viewer, rect);
    if (hovered && io.MouseWheel != 0.0F && viewer.takeCamera()) viewer.camera.dolly(double{io.MouseWheel});

    if (!hovered || !rect.has(io.MousePos) || wiping || handling) return;
    const double x = double{(io.MousePos.x - rect.low.x) / rect.width()} * viewer.frame->width;
    const double y = double{(io.MousePos.y - rect.low.y) / rect.height()} * viewer.frame->height;
    const bool doubled = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
    const float drag = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0.0F).x;
    static ImVec2 pressed;
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) || ImGui::IsMouseClicked(ImGuiMouseButton_Middle))
        pressed = io.MousePos;
    const bool still = std::abs(io.MousePos.x - pressed.x) + std::abs(io.MousePos.y - pressed.y) < 4.0F &&
                       std::abs(drag) < 4.0F;
    if (doubled || (ImGui::IsMouseReleased(ImGuiMouseButton_Middle) && still))
        viewer.pickAt(x, y, true);
    else if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) && still && !io.KeyShift) {
        if (viewer.ui.inspect)
            viewer.explainPixel(x, y);
        else
            viewer.pickAt(x, y, false);
    }
}

void drawPickMark(const Viewer& viewer, ImDrawList& list, const Rect& rect) {
    if (!viewer.ui.picked || !viewer.ui.panels || viewer.ui.panel != Panel::materials) return;
    const View view = makeView(viewer.frame->camera, viewer.frame->width, viewer.frame->height);
    const glm::dvec4 clip = view.clipFromRelative * glm::dvec4(viewer.ui.picked->position - view.eye, 1.0);
    if (clip.w <= 0.0) return;
    const ImVec2 at(rect.low.x + rect.width() * static_cast<float>(0.5 + 0.5 * clip.x / clip.w),
                    rect.low.y + rect.height() * static_cast<float>(0.5 - 0.5 * clip.y / clip.w));
    list.AddCircle(at, 6.0F, IM_COL32(0, 0, 0, 255), 0, 3.0F);
    list.AddCircle(at, 6.0F, IM_COL32(255, 210, 110, 255), 0, 1.5F);
}

}  // namespace

void drawPictureArea(Viewer& viewer) {
    const ImGuiViewport& viewport = *ImGui::GetMainViewport();
    const float bar = ImGui::GetFrameHeight();
    const float panel = viewer.ui.panels ? viewer.preferences.panelWidth * viewer.window.scale() : 0.0F;
    viewer.pictureX = 0.0F;
    viewer.pictureY = std::ceil(bar);
    viewer.pictureWidth = std::floor(std::max(1.0F, viewport.Size.x - panel));
    viewer.pictureHeight = std::floor(std::max(1.0F, viewport.Size.y - viewer.pictureY - bar));
    const float unit = viewer.window.pixelsPerPoint();
    viewer.document.setWindowSize(static_cast<int>(viewer.pictureWidth * unit),
                                  static_cast<int>(viewer.pictureHeight * unit));
    ImGui::SetNextWindowPos({viewer.pictureX, viewer.pictureY});
    ImGui::SetNextWindowSize({viewer.pictureWidth, viewer.pictureHeight});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
    ImGui::Begin("picture", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoBackground);
    ImGui::PopStyleVar(2);
    if (viewer.ui.startPage) {
        drawStartPage(viewer, viewer.pictureX, viewer.pictureY, viewer.pictureWidth, viewer.pictureHeight);
        ImGui::End();
        return;
    }
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImGui::InvisibleButton("view", {viewer.pictureWidth, viewer.pictureHeight},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    viewer.mark("picture");
    if (viewer.frame) {
        const Rect rect = placeOf(viewer, viewer.frame->width, viewer.frame->height);
        if (viewer.frame->display.bitmap.channels == 4) drawCheckers(list, rect);
        list.AddImage(viewer.picture.id(), rect.low, rect.high);
        viewer.events.place("image", rect.low.x, rect.low.y, rect.width(), rect.height());
        float wipeX = -1e6F;
        if (viewer.ui.comparison.with != Comparison::With::nothing) wipeX = drawOther(viewer, list, rect);
        const float low = rect.high.y - 4.5F * ImGui::GetTextLineHeight();
        drawLegend(list, viewer.frame->display.legend, {rect.low.x + 16.0F, low});
        if (viewer.otherPicture)
            drawLegend(list, viewer.otherLegend,
                       {rect.high.x - 18.0F * ImGui::GetTextLineHeight() - 16.0F, low});
        drawPickMark(viewer, list, rect);
        useMouse(viewer, rect, wipeX);
    }
    if (viewer.ui.shown.aov != Aov::radiance)
        drawTag(list, {viewer.pictureX + 14.0F, viewer.pictureY + 8.0F},
                nameOf(viewer.ui.shown) + "  (B: picture)", false);
    // Work that takes longer than a moment says so where one looks.
    const auto [status, since] = viewer.worker.status();
    const std::string loading = viewer.loading.loading();
    if (!loading.empty() || (!status.empty() && since > 0.4) || status.starts_with("compiling"))
        drawTag(list,
                {viewer.pictureX + 14.0F,
                 viewer.pictureY + viewer.pictureHeight - 2.0F * ImGui::GetTextLineHeight()},
                !loading.empty() ? "loading " + loading + " ..." : status + " ...", false);
    ImGui::End();
}

}  // namespace lobe::view
