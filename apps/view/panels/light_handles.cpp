#include <imgui.h>

#include <array>
#include <cmath>

#include "panels.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

constexpr float kReach = 9.0F;  ///< points within which the mouse has a handle

/// World to the window's points, for the picture as it lies there.
class Projection {
public:
    explicit Projection(const Viewer& viewer)
        : view_(makeView(viewer.frame->camera, viewer.frame->width, viewer.frame->height)) {
        const float unit = 1.0F / viewer.window.pixelsPerPoint();
        ImVec2 size(static_cast<float>(viewer.frame->width) * unit,
                    static_cast<float>(viewer.frame->height) * unit);
        const float fit = std::min({1.0F, viewer.pictureWidth / size.x, viewer.pictureHeight / size.y});
        size_ = {size.x * fit, size.y * fit};
        low_ = {viewer.pictureX + std::floor(0.5F * (viewer.pictureWidth - size_.x)),
                viewer.pictureY + std::floor(0.5F * (viewer.pictureHeight - size_.y))};
    }
    /// False behind the eye.
    bool at(const glm::dvec3& world, ImVec2& point) const {
        const glm::dvec4 clip = view_.clipFromRelative * glm::dvec4(world - view_.eye, 1.0);
        if (clip.w <= 1e-9) return false;
        point = {low_.x + size_.x * static_cast<float>(0.5 + 0.5 * clip.x / clip.w),
                 low_.y + size_.y * static_cast<float>(0.5 - 0.5 * clip.y / clip.w)};
        return true;
    }
    /// Metres a point of the window, at that place, across the line of sight.
    double metresPerPoint(const glm::dvec3& world) const {
        const double depth = glm::dot(world - view_.eye, view_.forward);
        const double pixel = glm::length(view_.rayDirectionDy) * (view_.orthographic ? 0.0 : depth) +
                             glm::length(view_.rayOriginDy);
        return pixel * view_.height / double{size_.y};
    }
    const View& view() const { return view_; }

private:
    View view_;
    ImVec2 low_, size_;
};

float distance(ImVec2 a, ImVec2 b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

bool hasPlace(const Light& light) {
    return light.type != LightType::directional;
}

bool hasDirection(const Light& light) {
    return light.type == LightType::directional || light.type == LightType::spot ||
           light.type == LightType::rect || light.type == LightType::disk;
}

constexpr int kCenter = 3, kAim = 4;  ///< handles after the three axes

}  // namespace

bool drawLightHandles(Viewer& viewer) {
    const DrawnScene* drawn = viewer.drawn();
    const int index = viewer.ui.light;
    if (!viewer.ui.panels || viewer.ui.panel != Panel::lights || drawn == nullptr || index < 0 ||
        static_cast<size_t>(index) >= drawn->lights.size())
        return false;
    const std::vector<Light>& lights =
        viewer.document.edits().lights ? *viewer.document.edits().lights : drawn->lights;
    if (static_cast<size_t>(index) >= lights.size()) return false;
    Light light = lights[static_cast<size_t>(index)];
    const Projection projection(viewer);
    const glm::dvec3 place = hasPlace(light) ? light.position : viewer.document.scene()->bounds().center();
    ImVec2 origin;
    if (!projection.at(place, origin)) return false;
    const double reach = 70.0 * double{viewer.window.scale()} * projection.metresPerPoint(place);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImGuiIO& io = ImGui::GetIO();
    std::array<ImVec2, 5> points{};
    std::array<bool, 5> there{};
    static constexpr ImU32 kColors[] = {IM_COL32(240, 90, 90, 255), IM_COL32(110, 220, 110, 255),
                                        IM_COL32(110, 150, 255, 255), IM_COL32(255, 255, 255, 255),
                                        IM_COL32(255, 210, 90, 255)};
    for (int axis = 0; axis < 3 && hasPlace(light); ++axis) {
        glm::dvec3 tip = place;
        tip[axis] += reach;
        there[static_cast<size_t>(axis)] = projection.at(tip, points[static_cast<size_t>(axis)]);
    }
    there[kCenter] = hasPlace(light);
    points[kCenter] = origin;
    const glm::dvec3 aim = place + light.direction * (1.6 * reach);
    there[kAim] = hasDirection(light) && projection.at(aim, points[kAim]);

    int hovered = -1;
    for (int i = 4; i >= 0; --i)
        if (there[static_cast<size_t>(i)] &&
            distance(io.MousePos, points[static_cast<size_t>(i)]) < kReach * viewer.window.scale())
            hovered = i;
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) viewer.ui.dragHandle = -1;
    if (ImGui::IsItemActivated() && hovered >= 0) viewer.ui.dragHandle = hovered;
    const int held = viewer.ui.dragHandle;

    for (size_t i = 0; i < points.size(); ++i) {
        if (!there[i]) continue;
        if (i != kCenter) list.AddLine(origin, points[i], kColors[i], 2.0F);
        const bool lit = static_cast<int>(i) == held || (held < 0 && static_cast<int>(i) == hovered);
        list.AddCircleFilled(points[i], (lit ? 8.0F : 6.0F) * viewer.window.scale(), kColors[i]);
        list.AddCircle(points[i], (lit ? 8.0F : 6.0F) * viewer.window.scale(), IM_COL32_BLACK);
        static constexpr const char* kNames[] = {"handle x", "handle y", "handle z", "handle center",
                                                 "handle aim"};
        viewer.events.place(kNames[i], points[i].x, points[i].y, 0.0F, 0.0F);
    }
    if (held < 0 || !ImGui::IsItemActive()) return hovered >= 0;
    if (io.MouseDelta.x == 0.0F && io.MouseDelta.y == 0.0F) return true;

    const View& view = projection.view();
    // In parallel projection rays differ in where they start alone.
    const bool parallel = view.rayDirectionDx == glm::dvec3(0.0);
    const glm::dvec3 right = glm::normalize(parallel ? view.rayOriginDx : view.rayDirectionDx),
                     up = glm::normalize(parallel ? view.rayOriginDy : view.rayDirectionDy);
    const double metres = projection.metresPerPoint(place);
    const glm::dvec3 across =
        right * (double{io.MouseDelta.x} * metres) - up * (double{io.MouseDelta.y} * metres);
    if (held == kCenter) {
        light.position += across;
    } else if (held == kAim) {
        light.direction = glm::normalize(light.direction * (1.6 * reach) + across);
    } else {
        // As far along the axis as its tip runs with the mouse.
        const auto axis = static_cast<size_t>(held);
        const glm::dvec2 way(double{points[axis].x - origin.x}, double{points[axis].y - origin.y});
        const double length = glm::dot(way, way);
        if (length > 1.0)
            light.position[held] +=
                reach * glm::dot(glm::dvec2(double{io.MouseDelta.x}, double{io.MouseDelta.y}), way) / length;
    }
    auto changed = std::make_shared<std::vector<Light>>(lights);
    (*changed)[static_cast<size_t>(index)] = light;
    Edits edits = viewer.document.edits();
    edits.lights = std::move(changed);
    viewer.document.edit(std::move(edits), "light");
    viewer.lastMoved = viewer.seconds();
    return true;
}

}  // namespace lobe::view
