#include <imgui.h>

#include "panels.hpp"
#include "plan/knobs.hpp"
#include "shading/brdf.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

using With = Comparison::With;

void drawTruth(Viewer& viewer) {
    const TruthState state = viewer.truth.state();
    if (!state.error.empty()) return ImGui::TextWrapped("no truth: %s", state.error.c_str());
    if (state.rounds > 0)
        ImGui::TextWrapped("Truth by rays in double precision, round %d; its own standard error is %.2g %%.",
                           state.rounds, 100.0 * state.relativeError);
    if (state.running) {
        ImGui::Text("computing to %.2g %%", 100.0 * state.aim);
        ImGui::ProgressBar(static_cast<float>(state.done), {-1.0F, 0.0F});
    }
    if (viewer.errorSummary.known) {
        ImGui::Text("relMSE %.3g", viewer.errorSummary.relMse);
        ImGui::Text("error: mean %.3g, largest %.3g of the truth and half its mean", viewer.errorSummary.mean,
                    viewer.errorSummary.largest);
    }
}

void drawShown(Viewer& viewer) {
    if (viewer.drawn() == nullptr) return;
    ImGui::Text("Shown");
    ImGui::SetNextItemWidth(-1.0F);
    if (!ImGui::BeginCombo("##shown", nameOf(viewer.ui.shown).c_str())) return viewer.mark("shown");
    for (const Shown& shown : shownChoices(viewer.drawn()->plan)) {
        if (ImGui::Selectable(nameOf(shown).c_str(), shown == viewer.ui.shown)) viewer.ui.shown = shown;
        viewer.mark("shown " + nameOf(shown));
    }
    ImGui::EndCombo();
}

}  // namespace

void drawComparePanel(Viewer& viewer) {
    drawShown(viewer);
    ImGui::Separator();
    const With with = viewer.ui.comparison.with;
    const auto choice = [&](const char* text, With what) {
        if (ImGui::RadioButton(text, with == what)) {
            Comparison comparison{.with = what};
            if (what == With::kept) {
                comparison.keptSettings = viewer.document.settings();
                comparison.keptEdits = viewer.document.edits();
            }
            if (what == With::model) comparison.model = brdfNames().front();
            viewer.compareWith(comparison);
        }
        viewer.mark(std::string("compare ") + text);
    };
    ImGui::Text("Right of the wipe");
    choice("nothing", With::nothing);
    choice("the picture as it is now, kept", With::kept);
    choice("all in another model", With::model);
    if (with == With::model) {
        ImGui::SameLine();
        ImGui::SetNextItemWidth(-1.0F);
        if (ImGui::BeginCombo("##model", viewer.ui.comparison.model.c_str())) {
            for (const std::string& name : brdfNames())
                if (ImGui::Selectable(name.c_str(), viewer.withModel(name)))
                    viewer.compareWith({.with = With::model, .model = name});
            ImGui::EndCombo();
        }
    }
    choice("the truth", With::truth);
    choice("the error against the truth", With::error);
    if (with == With::truth || with == With::error) drawTruth(viewer);
    if (with != With::nothing) {
        ImGui::SetNextItemWidth(-1.0F);
        ImGui::SliderFloat("##wipe", &viewer.ui.comparison.wipe, 0.0F, 1.0F, "wipe %.2f");
        viewer.mark("wipe");
    }
    ImGui::Separator();
    if (ImGui::Button("All models side by side (M)")) viewer.ui.modelGrid = true;
    viewer.mark("all models");
}

}  // namespace lobe::view
