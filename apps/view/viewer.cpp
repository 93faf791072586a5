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
    if (given.scene.empty()) return;
    open(given.scene);
    if (messages.list().back().isError) ui.startPage = true;
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
    bool waited = false;
    while (!window.shouldClose()) {
        const bool lively = camera.moving() || settle_ > 0;
        const bool waiting = !worker.status().first.empty() || !loading.loading().empty() ||
                             truth.state().running || explaining_.valid();
        if (waited && !waiting) settle_ = std::max(settle_, 2);  // what said so goes
        waited = waiting;
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
        const double passed = std::min(now - lastFrame_, 0.1);  // nothing moves while all is at rest
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
        announceRest();
        window.endFrame(wantsSave);
        if (std::exchange(wantsSave, false)) attempt([this] { saveWindow(); });
    }
    return 0;
}

/// For --events: what is shown is what was asked for.
void Viewer::announceRest() {
    const bool rests = requested_ && !requested_->moving && frame && frame->number == requested_->number &&
                       !camera.moving() && loading.loading().empty() && worker.status().first.empty();
    if (rests && announced_ != frame->number) events.add("rest", {{"number", frame->number}});
    announced_ = rests ? frame->number : 0;
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
