#include "viewer.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/resources.hpp"
#include "commands.hpp"
#include "model_files.hpp"
#include "panels/panels.hpp"
#include "shot_scene.hpp"

namespace lobe::view {
namespace {

constexpr double kSettleSeconds = 0.15;  ///< without a change, after which the picture is drawn in full
constexpr double kWatchSeconds = 0.5;
constexpr size_t kHistory = 120;

Preferences preferencesFor(const ViewerOptions& options) {
    Preferences preferences = Preferences::load();
    if (options.windowSize) std::tie(preferences.width, preferences.height) = *options.windowSize;
    return preferences;
}

}  // namespace

const char* nameOf(Panel panel) {
    static constexpr const char* kNames[] = {"Settings", "Materials", "Lights", "Compare",
                                             "Plan",     "Time",      "Pixel",  "Messages"};
    return kNames[static_cast<size_t>(panel)];
}

Viewer::Viewer(const ViewerOptions& given)
    : options(given),
      preferences(preferencesFor(given)),
      events(given.eventsFile),
      window("Lobe", preferences.width, preferences.height),
      worker(given.context, Window::wake),
      loading(Window::wake),
      truth(Window::wake),
      document(given.sources),
      shaders(shaderDirectory()) {
    ui.panels = preferences.panels;
    ui.startPage = given.scene.empty();
    say(worker.info().backend + " " + worker.info().platform + ": " + worker.info().renderer + ", OpenGL " +
        worker.info().version);
    if (!given.scene.empty()) open(given.scene);
}

Viewer::~Viewer() {
    preferences.panels = ui.panels;
    if (!options.windowSize) std::tie(preferences.width, preferences.height) = window.size();
    preferences.save();
    truth.stop();
}

double Viewer::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Viewer::say(const std::string& text, bool isError) {
    messages.add(text, isError, seconds());
    events.add("message", {{"text", text}, {"error", isError}});
}

void Viewer::attempt(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::exception& error) {
        say(error.what(), true);
    }
}

void Viewer::whileIdle(const std::function<void()>& action) {
    truth.stopAndWait();
    if (explaining_.valid()) explaining_.wait();
    worker.whileIdle(action);
    requested_.reset();  // what was in work was given up
    requestedOther_.reset();
}

void Viewer::mark(const std::string& control) {
    if (!events.used()) return;
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    if (ImGui::IsItemVisible()) events.place(control, low.x, low.y, high.x - low.x, high.y - low.y);
}

void Viewer::showPanel(Panel panel) {
    ui.panels = true;
    ui.panel = panel;
    ui.panelAsked = true;
}

int Viewer::run() {
    lastFrame_ = seconds();
    while (!window.shouldClose()) {
        const bool lively = camera.moving() || settle_ > 0;
        const bool waiting = !worker.status().first.empty() || !loading.loading().empty() ||
                             truth.state().running || explaining_.valid();
        const bool preliminary =
            requested_ && requested_->moving;  // the full picture is still to be asked for
        const std::vector<std::string> dropped = window.wait(lively        ? 0.004
                                                             : preliminary ? 0.03
                                                             : waiting     ? 0.1
                                                                           : 0.25);
        if (window.takeInput() || window.hasKeys()) settle_ = 4;
        for (const std::string& file : dropped)
            open(file);
        collect();
        watchFiles();
        const double now = seconds();
        if (settle_ == 0 && !waiting && !preliminary && !camera.moving() && !wantsSave) continue;
        settle_ = std::max(0, settle_ - 1);
        const double passed = now - lastFrame_;
        lastFrame_ = now;

        window.beginFrame();
        handleKeys(*this, passed);
        drawInterface();
        if (camera.moving()) {
            camera.advance(passed);
            document.setPose(camera.pose());
            lastMoved = now;
        }
        loadIfChanged();
        requestFrames();
        window.endFrame(wantsSave);
        if (std::exchange(wantsSave, false)) attempt([this] { saveWindow(); });
    }
    return 0;
}

void Viewer::drawInterface() {
    drawMenus(*this);
    if (ui.panels) drawPanels(*this);
    drawStatusBar(*this);
    drawPictureArea(*this);
    drawCheatSheet(*this);
    drawOpenDialog(*this);
    drawSaveDialog(*this);
    drawModelGrid(*this);
}

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

bool Viewer::withModel(const std::string& model) const {
    return ui.comparison.with == Comparison::With::model && ui.comparison.model == model;
}

void Viewer::requestOther() {
    const Comparison& comparison = ui.comparison;
    const bool drawnOne =
        comparison.with == Comparison::With::kept || comparison.with == Comparison::With::model;
    if (!drawnOne || !requested_ || requested_->moving) return;
    FrameRequest request = *requested_;
    attempt([&] {
        app::Settings settings =
            comparison.with == Comparison::With::kept ? *comparison.keptSettings : *document.settings();
        // Ours in all that is about where one looks from.
        for (const char* key : {"resolution", "camera", "camera_position", "camera_focal_point",
                                "camera_view_angle", "camera_azimuth", "camera_elevation"}) {
            settings.reset(key, "window");
            const nlohmann::json& value = document.settings()->get(key);
            if (!value.is_null()) settings.set(key, value, "window");
        }
        if (comparison.with == Comparison::With::model) settings.set("brdf", comparison.model, "window");
        request.settings = std::make_shared<const app::Settings>(std::move(settings));
        request.edits = comparison.with == Comparison::With::kept ? comparison.keptEdits : Edits{};
    });
    if (requestedOther_ && requestedOther_->base == request.base && requestedOther_->shown == request.shown &&
        requestedOther_->edits == request.edits &&
        requestedOther_->settings->toJson() == request.settings->toJson())
        return;
    request.number = ++number_;
    requestedOther_ = request;
    worker.drawOther(std::move(request));
}

void Viewer::compareWith(Comparison comparison) {
    const bool truthWas =
        ui.comparison.with == Comparison::With::truth || ui.comparison.with == Comparison::With::error;
    comparison.wipe = ui.comparison.wipe;
    ui.comparison = std::move(comparison);
    const bool truthIs =
        ui.comparison.with == Comparison::With::truth || ui.comparison.with == Comparison::With::error;
    worker.drawOther({});
    requestedOther_.reset();
    other.reset();
    otherPicture = {};
    otherLegend = {};
    errorSummary = {};
    truthRounds_ = 0;
    errorOf_ = 0;
    if (truthWas && !truthIs) truth.stop();
    if (truthIs) startTruth();
}

void Viewer::startTruth() {
    if (!document.scene()) return;
    const TruthSubject subject{document.scene(), document.settings(), document.edits()};
    if (truth.subject() == subject) return;
    truthRounds_ = 0;
    otherPicture = {};
    errorSummary = {};
    truth.start(subject);
}

void Viewer::updateTruth() {
    const bool wanted =
        ui.comparison.with == Comparison::With::truth || ui.comparison.with == Comparison::With::error;
    if (!wanted || !document.scene()) return;
    // It is of what is shown; while that changes, there is none.
    const bool restless = camera.moving() || (lastMoved >= 0.0 && seconds() - lastMoved < kSettleSeconds);
    if (!restless) startTruth();
    const TruthState state = truth.state();
    if (!state.error.empty() && truthRounds_ >= 0) {
        say("no truth: " + state.error, true);
        truthRounds_ = -1;
    }
    if (state.rounds <= truthRounds_) return;
    truthRounds_ = state.rounds;
    events.add("truth", {{"rounds", state.rounds}, {"relative_error", state.relativeError}});
    if (ui.comparison.with == Comparison::With::truth)
        attempt([&] { otherPicture.set(displayOf(*state.image, {}, *document.settings()).bitmap, true); });
    else
        updateErrorMap();
    settle_ = std::max(settle_, 2);
}

void Viewer::updateErrorMap() {
    if (ui.comparison.with != Comparison::With::error || !full) return;
    const TruthState state = truth.state();
    if (!state.image || truth.subject().settings != full->settings) return;
    const Image& test = full->image;
    const Image& right = *state.image;
    if (test.width != right.width || test.height != right.height) return;
    const size_t stride = right.channelCount(), mine = test.channelCount();
    double mean = 0.0;
    for (size_t i = 0; i < right.pixelCount(); ++i)
        for (size_t c = 0; c < 3; ++c)
            mean += static_cast<double>(right.values[i * stride + c]);
    mean /= 3.0 * static_cast<double>(right.pixelCount());
    Bitmap bitmap{test.width, test.height, 3, ComponentType::u8, {}};
    bitmap.data.resize(3 * test.pixelCount());
    ErrorSummary summary{true, 0.0, 0.0, 0.0};
    constexpr double kLow = 1e-3, kHigh = 1.0;
    for (size_t i = 0; i < test.pixelCount(); ++i) {
        double worst = 0.0;
        for (size_t c = 0; c < 3; ++c) {
            const auto x = static_cast<double>(test.values[i * mine + c]);
            const auto t = static_cast<double>(right.values[i * stride + c]);
            const double share = std::abs(x - t) / (std::abs(t) + 0.5 * mean + 1e-30);
            worst = std::max(worst, share);
            summary.relMse += (x - t) * (x - t) / (t * t + 0.01);
        }
        summary.mean += worst;
        summary.largest = std::max(summary.largest, worst);
        const double at = std::log(std::max(worst, kLow) / kLow) / std::log(kHigh / kLow);
        const std::array<uint8_t, 3> color = falseColor(at);
        for (size_t c = 0; c < 3; ++c)
            bitmap.data[3 * i + c] = static_cast<std::byte>(color[c]);
    }
    summary.mean /= static_cast<double>(test.pixelCount());
    summary.relMse /= 3.0 * static_cast<double>(test.pixelCount());
    errorSummary = summary;
    otherLegend = {true, true, kLow, kHigh, "error / (truth + half its mean)"};
    otherPicture.set(bitmap, false);
    events.add("error", {{"relmse", summary.relMse}, {"mean", summary.mean}, {"largest", summary.largest}});
}

double Viewer::pictureAspect() const {
    const nlohmann::json& size = document.settings()->get("resolution");
    return size[0].get<double>() / size[1].get<double>();
}

bool Viewer::takeCamera() {
    if (!frame || !document.scene()) return false;
    if (camera.adopted()) return true;
    const Bounds bounds = document.scene()->bounds();
    attempt([&] { camera.adopt(app::cameraOf(*document.scene(), *document.settings(), 0), bounds); });
    return camera.adopted();
}

void Viewer::resetCamera() {
    camera.forget();
    document.setPose({});
    for (const char* key : {"camera", "camera_position", "camera_focal_point", "camera_azimuth",
                            "camera_elevation", "camera_view_angle"})
        if (document.isChanged(key)) document.revert(key);
}

void Viewer::pickAt(double x, double y, bool pivot) {
    if (!document.scene() || !frame) return;
    attempt([&] {
        ui.picked = pick(document.scene(), frame->camera, frame->width, frame->height, x, y);
        if (!ui.picked) return;
        ui.material = ui.picked->material;
        events.add("picked", {{"material", ui.picked->material}, {"instance", ui.picked->instance}});
        if (pivot && takeCamera()) camera.setPivot(ui.picked->position);
    });
}

}  // namespace lobe::view
