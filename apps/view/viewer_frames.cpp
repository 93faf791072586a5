// What the threads have done, and what is asked of them.
#include <imgui.h>

#include <algorithm>

#include "model_files.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

constexpr double kWatchSeconds = 0.5;
constexpr size_t kHistory = 120;

}  // namespace

void Viewer::collect() {
    for (WorkerEvent& event : worker.take()) {
        settle_ = std::max(settle_, 2);
        if (auto* main = std::get_if<MainFrame>(&event)) takeFrame(std::move(main->frame));
        if (auto* second = std::get_if<OtherFrame>(&event)) takeOther(std::move(second->frame));
        if (auto* notice = std::get_if<Notice>(&event)) {
            say(notice->text, notice->isError);
            requested_.reset();  // reloaded shaders may draw another picture
            requestedOther_.reset();
        }
        if (auto* small = std::get_if<Thumbnail>(&event)) {
            if (!small->error.empty()) thumbnailErrors[small->key] = small->error;
            if (!small->bitmap.data.empty()) {
                thumbnailTextures[small->key].set(small->bitmap, true);
                thumbnailErrors.erase(small->key);
            }
        }
    }
    if (std::optional<LoadResult> result = loading.take()) {
        settle_ = std::max(settle_, 2);
        takeLoaded(std::move(*result));
    }
    if (explaining_.valid() && explaining_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        explanation = explaining_.get();
        events.add("explanation", {{"text", explanation}});
        settle_ = std::max(settle_, 2);
    }
    updateTruth();
}

void Viewer::forgetThumbnails() {
    worker.forgetThumbnails();
    std::erase_if(thumbnailErrors,
                  [](const auto& entry) { return entry.second.empty(); });  // to be asked again
}

void Viewer::takeFrame(Frame taken) {
    if (!taken.error.empty()) {
        say(taken.error, true);
        return;
    }
    if (frame && taken.number < frame->number) return;
    for (const std::string& warning : taken.warnings)
        say(warning);
    const bool sceneIsNew = !frame || taken.drawn != frame->drawn;
    if (sceneIsNew)
        for (const std::string& warning : taken.drawn->warnings)
            if (!frame || std::find(frame->drawn->warnings.begin(), frame->drawn->warnings.end(), warning) ==
                              frame->drawn->warnings.end())
                say(warning);
    picture.set(taken.display.bitmap, taken.moving);
    frame = std::move(taken);
    record(*frame);
    if (frame->moving) return;
    full = *frame;
    updateErrorMap();
}

void Viewer::record(const Frame& shownFrame) {
    nlohmann::json passes = nlohmann::json::object();
    for (const PassTime& pass : shownFrame.passes)
        passes[pass.pass] = pass.milliseconds;
    const Bitmap& bitmap = shownFrame.display.bitmap;
    events.add("picture", {{"number", shownFrame.number},
                           {"moving", shownFrame.moving},
                           {"shown", nameOf(shownFrame.shown)},
                           {"width", bitmap.width},
                           {"height", bitmap.height},
                           {"draw_ms", shownFrame.drawMs},
                           {"set_ms", shownFrame.setMs},
                           {"at", seconds()},
                           {"settings", shownFrame.settings->toJson()}});
    if (shownFrame.moving) return;
    if (historyDrawn_ != shownFrame.drawn) history = {};
    historyDrawn_ = shownFrame.drawn;
    const auto keep = [](std::deque<double>& values, double value) {
        values.push_back(value);
        if (values.size() > kHistory) values.pop_front();
    };
    for (const PassTime& pass : shownFrame.passes)
        keep(history.milliseconds[pass.pass], pass.milliseconds);
    keep(history.total, shownFrame.drawMs);
}

void Viewer::takeOther(Frame taken) {
    if (!taken.error.empty()) {
        say("the other picture: " + taken.error, true);
        return;
    }
    if (ui.comparison.with != Comparison::With::kept && ui.comparison.with != Comparison::With::model) return;
    otherPicture.set(taken.display.bitmap, false);
    otherLegend = taken.display.legend;
    events.add("other", {{"number", taken.number}, {"settings", taken.settings->toJson()}});
    other = std::move(taken);
}

void Viewer::takeLoaded(LoadResult result) {
    if (!result.error.empty()) {
        say(result.error, true);
        if (document.scene() == nullptr) ui.startPage = true;
        return;
    }
    const bool another = result.request.file != document.file() || !result.request.again;
    attempt([&] {
        textures.clear();
        document.setScene(result.request.file, std::move(result.scene), result.request.layers);
        loadedKey_ = loadKey();
    });
    if (!another) return;
    frame.reset();  // facts of another scene
    full.reset();
    if (document.scene()->instances.empty())
        say(result.request.file.string() + ": has nothing to draw", true);
    camera.forget();
    ui.startPage = false;
    forgetThumbnails();
    ui.material = ui.light = -1;
    ui.picked.reset();
    ui.shown = {};
    compareWith({});
    preferences.addRecent(std::filesystem::absolute(result.request.file).lexically_normal().string());
    window.setTitle(result.request.file.filename().string() + " - Lobe");
    events.add("scene", {{"file", result.request.file.string()}});
    say("opened " + result.request.file.string() + ": " + std::to_string(document.scene()->triangleCount()) +
        " triangles, " + std::to_string(document.scene()->materials.size()) + " materials, " +
        std::to_string(document.scene()->lights.size()) + " lights");
}

nlohmann::json Viewer::loadKey() const {
    const LoadOptions now = app::loadOptionsOf(*document.settings());
    return {document.file().string(), now.time, static_cast<int>(now.normals),
            document.settings()->get("brdf_file")};
}

void Viewer::loadIfChanged() {
    if (!document.scene()) return;
    const nlohmann::json key = loadKey();
    if (key == loadedKey_) return;
    loadedKey_ = key;  // once, whatever becomes of it
    loading.load({document.file(), app::loadOptionsOf(*document.settings()), {}, true});
}

void Viewer::watchFiles() {
    if (seconds() - lastWatch_ < kWatchSeconds) return;
    lastWatch_ = seconds();
    std::vector<std::filesystem::path> models;
    const nlohmann::json& files = document.settings()->get("brdf_file");
    if (files.is_array())
        for (const nlohmann::json& file : files)
            models.emplace_back(file.get<std::string>());
    shaders.setFiles(models);
    if (!shaders.changed()) return;
    say("shader files changed");
    attempt([&] { whileIdle([] { app::rereadModelFiles(); }); });
    // What was drawn may have other parameters than its models have now.
    const auto old = [](const std::optional<Frame>& drawnBefore) {
        return drawnBefore && drawnBefore->drawn &&
               !std::all_of(drawnBefore->drawn->materials.begin(), drawnBefore->drawn->materials.end(),
                            fitsModel);
    };
    if (old(frame) || old(full)) {
        frame.reset();
        full.reset();
        loadedKey_ = nullptr;  // materials of the file are read again
    }
    worker.reload();
}

void Viewer::requestFrames() {
    if (!document.scene() || document.scene()->instances.empty()) return;
    if (pictureWidth < 1.0F || pictureHeight < 1.0F) return;
    FrameRequest request;
    request.file = document.file();
    request.base = document.scene();
    attempt([&] { request.settings = document.settings(); });
    if (!request.settings) return;
    request.edits = document.edits();
    request.shown = ui.shown;
    const bool changed = !requested_ || requested_->base != request.base ||
                         requested_->settings != request.settings || requested_->edits != request.edits ||
                         requested_->shown != request.shown;
    // What a person turns or drags is drawn at once, and in full when it rests.
    const bool drags = changed && requested_ && requested_->base == request.base && ImGui::IsAnyItemActive();
    if (drags) lastMoved = seconds();
    const bool restless = lastMoved >= 0.0 && seconds() - lastMoved < kSettleSeconds;
    request.moving = restless && (requested_ || frame);
    if (!changed && (request.moving || !requested_->moving)) {
        requestOther();
        return;
    }
    request.number = ++number_;
    requested_ = request;
    worker.draw(std::move(request));
    requestOther();
}

}  // namespace lobe::view
