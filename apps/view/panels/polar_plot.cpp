#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "panels.hpp"
#include "plot/lobes.hpp"
#include "style.hpp"
#include "viewer.hpp"

namespace lobe::view {

void drawPolarPlot(Viewer& viewer, const Brdf& brdf, const Material& material) {
    if (!brdf.fCos) return ImGui::TextDisabled("no plot: the model is GLSL alone, without a twin");
    if (!brdf.traits.scattersLight)
        return ImGui::TextDisabled("no plot: the model mirrors and scatters nothing");
    static std::string plotted;
    static ParameterValues values;
    static plot::Lobes lobes;
    static std::string failure;
    if (plotted != brdf.name || values != material.values) {
        plotted = brdf.name;
        values = material.values;
        failure.clear();
        try {
            plot::LobesRequest request;
            request.models = {plot::Model{&brdf, material.values}};
            lobes = plot::computeLobes(plot::Sampler(), request);
        } catch (const std::exception& error) {
            lobes = {};
            failure = error.what();
        }
    }
    if (!failure.empty()) return ImGui::TextWrapped("%s", failure.c_str());
    double peak = 0.0;
    for (const plot::Lobe& lobe : lobes.lobes)
        peak = std::max(peak, plot::peakOf(lobe.points));
    const float width = ImGui::GetContentRegionAvail().x, line = ImGui::GetTextLineHeight();
    const float radius = std::min(0.5F * width - 4.0F, 13.0F * line);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 foot(at.x + 0.5F * width, at.y + radius + 4.0F);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto point = [&](double angleDeg, double share) {
        const double angle = angleDeg * M_PI / 180.0;
        return ImVec2(foot.x + radius * static_cast<float>(share * std::sin(angle)),
                      foot.y - radius * static_cast<float>(share * std::cos(angle)));
    };
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {
        list.PathClear();
        for (int degrees = -90; degrees <= 90; degrees += 5)
            list.PathLineTo(point(degrees, share));
        list.PathStroke(IM_COL32(90, 90, 95, 255), 0, 1.0F);
    }
    for (int degrees = -90; degrees <= 90; degrees += 30)
        list.AddLine(foot, point(degrees, 1.0), IM_COL32(90, 90, 95, 255));
    const bool root = viewer.ui.polarRoot;
    for (size_t i = 0; i < lobes.lobes.size() && peak > 0.0; ++i) {
        const plot::Lobe& lobe = lobes.lobes[i];
        list.PathClear();
        for (const plot::LobePoint& p : lobe.points) {
            const double share = std::max(p.value, 0.0) / peak;
            list.PathLineTo(point(p.angle, root ? std::sqrt(share) : share));
        }
        list.PathStroke(seriesColor(i), 0, 2.0F);
        list.AddLine(foot, point(-lobe.incidence, 1.0), (seriesColor(i) & 0x00FFFFFFU) | 0x80000000U, 1.5F);
    }
    ImGui::Dummy({width, radius + 8.0F});
    viewer.mark("polar plot");
    for (size_t i = 0; i < lobes.lobes.size(); ++i) {
        if (i > 0) ImGui::SameLine();
        ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(seriesColor(i)), "%g\xC2\xB0",
                           lobes.lobes[i].incidence);
    }
    ImGui::SameLine();
    ImGui::Text("of incidence; outermost %.3g /sr", peak);
    ImGui::Checkbox("square root of the radius", &viewer.ui.polarRoot);
}

}  // namespace lobe::view
