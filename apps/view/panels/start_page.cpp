// The gallery: scenes that come with Lobe and files opened last; and the grid of all models.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "gallery.hpp"
#include "panels.hpp"
#include "shading/brdf.hpp"
#include "style.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

constexpr int kThumbWidth = 256, kThumbHeight = 144;

/// Asks for a scene's thumbnail once.
void requestThumbnail(Viewer& viewer, const std::string& file) {
    if (viewer.thumbnailErrors.contains(file)) return;
    viewer.thumbnailErrors[file] = "";  // in work
    app::Settings settings;
    settings.set("resolution", {kThumbWidth, kThumbHeight}, "gallery");
    settings.set("quality", "draft", "gallery");
    ThumbnailRequest request;
    request.key = file;
    request.frame.file = file;
    request.frame.settings = std::make_shared<const app::Settings>(std::move(settings));
    viewer.worker.make(std::move(request));
}

/// A picture with a name below; true if it is clicked.
bool drawCard(Viewer& viewer, const std::string& key, const std::string& label) {
    const float scale = viewer.window.scale();
    const ImVec2 size(static_cast<float>(kThumbWidth) * 0.8F * scale,
                      static_cast<float>(kThumbHeight) * 0.8F * scale);
    ImGui::PushID(key.c_str());
    ImGui::BeginGroup();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool clicked = ImGui::InvisibleButton("card", size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto found = viewer.thumbnailTextures.find(key);
    if (found != viewer.thumbnailTextures.end()) {
        list.AddImage(found->second.id(), at, {at.x + size.x, at.y + size.y});
    } else {
        list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(32, 32, 36, 255));
        const auto error = viewer.thumbnailErrors.find(key);
        const std::string text =
            error == viewer.thumbnailErrors.end() || error->second.empty() ? "..." : "cannot be shown";
        list.AddText({at.x + 8.0F, at.y + 8.0F}, IM_COL32(170, 170, 170, 255), text.c_str());
    }
    const bool lit = ImGui::IsItemHovered() || ImGui::IsItemFocused();
    list.AddRect(at, {at.x + size.x, at.y + size.y},
                 lit ? IM_COL32(255, 210, 110, 255) : IM_COL32(70, 70, 75, 255), 0.0F, 0, lit ? 2.0F : 1.0F);
    viewer.mark("card " + label);
    if (ImGui::IsItemHovered()) {
        const auto error = viewer.thumbnailErrors.find(key);
        ImGui::SetTooltip("%s%s%s", key.c_str(), error == viewer.thumbnailErrors.end() ? "" : "\n",
                          error == viewer.thumbnailErrors.end() ? "" : error->second.c_str());
    }
    ImGui::TextUnformatted(label.c_str());
    ImGui::EndGroup();
    ImGui::PopID();
    return clicked;
}

/// Cards in as many columns as fit.
template<class Draw>
void drawCards(Viewer& viewer, size_t count, Draw draw) {
    const float card = static_cast<float>(kThumbWidth) * 0.8F * viewer.window.scale() + 12.0F;
    const auto columns = std::max<size_t>(1, static_cast<size_t>(ImGui::GetContentRegionAvail().x / card));
    for (size_t i = 0; i < count; ++i) {
        if (i % columns != 0) ImGui::SameLine(0.0F, 12.0F);
        draw(i);
    }
}

}  // namespace

void drawStartPage(Viewer& viewer, float, float, float width, float height) {
    static const std::vector<std::string> scenes = galleryScenes();
    ImGui::SetCursorPos({16.0F, 12.0F});
    ImGui::BeginChild("start", {width - 24.0F, height - 20.0F}, false, ImGuiWindowFlags_NavFlattened);
    ImGui::TextUnformatted("Drop a scene or a panorama into the window, press Ctrl+O, or choose:");
    std::string chosen;
    if (!viewer.preferences.recent.empty()) {
        ImGui::TextDisabled("Opened last");
        const size_t count = std::min<size_t>(viewer.preferences.recent.size(), 4);
        drawCards(viewer, count, [&](size_t i) {
            const std::string& file = viewer.preferences.recent[i];
            requestThumbnail(viewer, file);
            ImGui::PushID("recent");
            if (drawCard(viewer, file, std::filesystem::path(file).filename().string())) chosen = file;
            ImGui::PopID();
        });
    }
    ImGui::TextDisabled(scenes.empty() ? "The scenes that come with Lobe are not installed" : "Scenes");
    drawCards(viewer, scenes.size(), [&](size_t i) {
        requestThumbnail(viewer, scenes[i]);
        if (drawCard(viewer, scenes[i], galleryName(scenes[i]))) chosen = scenes[i];
    });
    ImGui::EndChild();
    if (!chosen.empty()) viewer.open(chosen);
}

void drawModelGrid(Viewer& viewer) {
    static std::shared_ptr<const app::Settings> made;
    static std::shared_ptr<const Scene> madeOf;
    if (!viewer.ui.modelGrid || !viewer.full || !viewer.document.scene()) return;
    const std::vector<std::string> names = brdfNames();
    if (made != viewer.full->settings || madeOf != viewer.document.scene()) {
        made = viewer.full->settings;
        madeOf = viewer.document.scene();
        viewer.worker.forgetThumbnails();
        for (const std::string& name : names) {
            const std::string key = "model " + name;
            viewer.thumbnailErrors.erase(key);
            viewer.attempt([&] {
                app::Settings settings = *made;
                settings.set("resolution", {kThumbWidth, kThumbHeight}, "grid");
                settings.reset("brdf", "grid");
                settings.set("brdf", name, "grid");
                settings.reset("background", "grid");
                ThumbnailRequest request;
                request.key = key;
                request.frame.file = viewer.document.file();
                request.frame.base = madeOf;
                request.frame.settings = std::make_shared<const app::Settings>(std::move(settings));
                viewer.worker.make(std::move(request));
            });
        }
    }
    const ImGuiViewport& viewport = *ImGui::GetMainViewport();
    ImGui::SetNextWindowPos({0.04F * viewport.Size.x, 0.08F * viewport.Size.y}, ImGuiCond_Appearing);
    ImGui::SetNextWindowSize({0.66F * viewport.Size.x, 0.84F * viewport.Size.y}, ImGuiCond_Appearing);
    if (ImGui::Begin("All models", &viewer.ui.modelGrid, ImGuiWindowFlags_NoSavedSettings)) {
        ImGui::TextDisabled("All materials in each model, from here. A click takes the model for the scene.");
        drawCards(viewer, names.size(), [&](size_t i) {
            if (!drawCard(viewer, "model " + names[i], names[i])) return;
            viewer.attempt([&] { viewer.document.change("brdf", names[i]); });
        });
    }
    ImGui::End();
}

}  // namespace lobe::view
