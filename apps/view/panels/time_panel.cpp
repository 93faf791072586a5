#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "measure/choose.hpp"
#include "panels.hpp"
#include "plan/knobs.hpp"
#include "style.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

using nlohmann::json;

double percentile(std::deque<double> values, double share) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

/// A bar of the latest time, with marks of the median and the 95th percentile.
void drawBar(const std::deque<double>& values, double latest, double longest, size_t color) {
    const double median = percentile(values, 0.5), high = percentile(values, 0.95);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetTextLineHeight();
    const auto x = [&](double value) {
        return at.x + width * static_cast<float>(std::min(1.0, value / std::max(longest, 1e-9)));
    };
    list.AddRectFilled(at, {x(latest), at.y + height}, seriesColor(color), 2.0F);
    list.AddLine({x(median), at.y}, {x(median), at.y + height}, IM_COL32_WHITE, 2.0F);
    list.AddLine({x(high), at.y + 0.3F * height}, {x(high), at.y + 0.7F * height}, IM_COL32_WHITE, 2.0F);
    ImGui::Dummy({width, height});
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("latest %.2f ms, median %.2f ms, 95th percentile %.2f ms of %zu pictures", latest,
                          median, high, values.size());
}

void drawHistory(const std::deque<double>& total) {
    std::vector<float> values;
    values.reserve(total.size());
    for (const double value : total)
        values.push_back(static_cast<float>(value));
    if (values.empty()) return;
    const float highest = *std::max_element(values.begin(), values.end());
    ImGui::PlotLines("##history", values.data(), static_cast<int>(values.size()), 0, nullptr, 0.0F,
                     1.1F * highest, {-1.0F, 3.5F * ImGui::GetTextLineHeight()});
}

/// What a report holds of the scene that is shown, or of its first scene.
const json* entryOf(const json& report, const std::string& hash, bool& isOurs) {
    if (!report.contains("scenes") || report["scenes"].empty()) return nullptr;
    for (const json& scene : report["scenes"])
        if (scene.value("content_hash", "") == hash) {
            isOurs = true;
            return &scene;
        }
    isOurs = false;
    return &report["scenes"].front();
}

struct ReportPoint {
    double milliseconds, error;
    std::string label;
};

/// readReport() has seen that they are there.
std::vector<ReportPoint> pointsOf(const json& scene) {
    std::vector<ReportPoint> points;
    for (const json& setting : scene["settings"]) {
        const json& error = setting["error"]["relmse"];
        if (error.is_number())
            points.push_back({std::max(setting["time"]["wall_ms"].get<double>(), 1e-6), error.get<double>(),
                              setting["label"].get<std::string>()});
    }
    return points;
}

void drawChart(const std::vector<ReportPoint>& points) {
    if (points.empty()) return ImGui::TextDisabled("the report has no times with relmse");
    double x0 = HUGE_VAL, x1 = 0.0, y0 = HUGE_VAL, y1 = 0.0;
    for (const ReportPoint& point : points) {
        x0 = std::min(x0, point.milliseconds);
        x1 = std::max(x1, point.milliseconds);
        y0 = std::min(y0, std::max(point.error, 1e-12));
        y1 = std::max(y1, std::max(point.error, 1e-12));
    }
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, 12.0F * ImGui::GetTextLineHeight());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(20, 20, 22, 255));
    ImGui::InvisibleButton("chart", size);
    const auto share = [](double v, double low, double high) {
        return high > low ? static_cast<float>(std::log(v / low) / std::log(high / low)) : 0.5F;
    };
    const ReportPoint* nearest = nullptr;
    float best = 10.0F;
    for (const ReportPoint& point : points) {
        const ImVec2 p(
            at.x + 10.0F + (size.x - 20.0F) * share(point.milliseconds, x0, x1),
            at.y + size.y - 10.0F - (size.y - 20.0F) * share(std::max(point.error, 1e-12), y0, y1));
        list.AddCircleFilled(p, 4.0F, seriesColor(1));
        const float away = std::hypot(ImGui::GetIO().MousePos.x - p.x, ImGui::GetIO().MousePos.y - p.y);
        if (away < best) {
            best = away;
            nearest = &point;
        }
    }
    if (nearest != nullptr)
        ImGui::SetTooltip("%s\n%.3g ms, relmse %.3g", nearest->label.c_str(), nearest->milliseconds,
                          nearest->error);
    ImGui::TextDisabled("error %.2g to %.2g (up) against %.3g to %.3g ms (right), both logarithmic", y0, y1,
                        x0, x1);
}

void useChoice(Viewer& viewer, const measure::Goal& goal) {
    viewer.attempt([&] {
        const json& size = viewer.document.settings()->get("resolution");
        const measure::Chosen chosen = measure::choose(viewer.ui.report, viewer.document.scene()->contentHash,
                                                       size[0].get<double>() * size[1].get<double>(), goal);
        viewer.document.changeAll(app::knobsOf(chosen.quality), "report");
        std::array<char, 160> text{};
        std::snprintf(text.data(), text.size(), ": expect error %.3g in %.3g ms; ", chosen.error,
                      chosen.milliseconds);
        viewer.ui.reportAnswer = chosen.label + text.data() + chosen.basis;
        viewer.say(viewer.ui.reportAnswer);
    });
}

void drawReport(Viewer& viewer) {
    if (!ImGui::CollapsingHeader("Error against time", ImGuiTreeNodeFlags_DefaultOpen)) return;
    if (viewer.ui.report.is_null())
        return ImGui::TextWrapped(
            "Open a report.json, which lobe report writes, to see the error of each quality "
            "setting against its time, and to choose by them.");
    if (!viewer.document.scene()) return ImGui::TextDisabled("no scene is open");
    bool isOurs = false;
    const json* scene = entryOf(viewer.ui.report, viewer.document.scene()->contentHash, isOurs);
    if (scene == nullptr) return ImGui::TextDisabled("the report has no scene");
    ImGui::TextWrapped("%s: %s%s", viewer.ui.reportFile.c_str(), scene->value("scene", "").c_str(),
                       isOurs ? "" : " (not the scene that is shown)");
    drawChart(pointsOf(*scene));
    const float width = 90.0F * viewer.window.scale();
    ImGui::SetNextItemWidth(width);
    ImGui::InputDouble("##error", &viewer.ui.reportError, 0.0, 0.0, "%.3g");
    ImGui::SameLine();
    if (ImGui::Button("Fastest within this relmse")) useChoice(viewer, {.maxError = viewer.ui.reportError});
    ImGui::SetNextItemWidth(width);
    ImGui::InputDouble("##budget", &viewer.ui.reportBudget, 0.0, 0.0, "%.3g ms");
    ImGui::SameLine();
    if (ImGui::Button("Best within this time")) useChoice(viewer, {.budget = viewer.ui.reportBudget});
    if (!viewer.ui.reportAnswer.empty()) ImGui::TextWrapped("%s", viewer.ui.reportAnswer.c_str());
}

}  // namespace

void drawTimePanel(Viewer& viewer) {
    ImGui::BeginChild("time");
    if (!viewer.full) {
        ImGui::TextDisabled("no picture yet");
    } else {
        const Frame& frame = *viewer.full;
        ImGui::Text("%.1f ms a picture of %dx%d, %d samples a pixel", frame.drawMs, frame.width, frame.height,
                    frame.drawn->plan.samples);
        ImGui::TextDisabled("%s", viewer.worker.info().reliableTimers
                                      ? "passes by the GPU's clock, the whole by the wall's"
                                      : "by the wall's clock: a software rasteriser has no other");
        drawHistory(viewer.history.total);
        double longest = 0.0, sum = 0.0;
        for (const PassTime& pass : frame.passes) {
            longest = std::max(longest, pass.milliseconds);
            sum += pass.milliseconds;
        }
        for (const auto& [name, values] : viewer.history.milliseconds)
            longest = std::max(longest, percentile(values, 0.95));
        if (ImGui::BeginTable("passes", 3, ImGuiTableFlags_SizingStretchProp)) {
            ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch, 0.34F);
            ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthStretch, 0.18F);
            ImGui::TableSetupColumn("bar", ImGuiTableColumnFlags_WidthStretch, 0.48F);
            size_t color = 0;
            for (const PassTime& pass : frame.passes) {
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(pass.pass.c_str());
                ImGui::TableNextColumn();
                ImGui::Text("%.2f", pass.milliseconds);
                ImGui::TableNextColumn();
                drawBar(viewer.history.milliseconds[pass.pass], pass.milliseconds, longest, color++);
            }
            ImGui::EndTable();
        }
        viewer.mark("pass times");
        ImGui::Text("passes together %.1f ms; setting up took %.1f ms", sum, frame.setMs);
        ImGui::TextDisabled("white line: median; short line: 95th percentile");
        if (viewer.frame && viewer.frame->moving)
            ImGui::Text("moving: %dx%d, %.1f ms", viewer.frame->image.width, viewer.frame->image.height,
                        viewer.frame->drawMs);
    }
    drawReport(viewer);
    ImGui::EndChild();
}

}  // namespace lobe::view
