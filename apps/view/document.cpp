#include "document.hpp"

#include <algorithm>
#include <array>
#include <chrono>

#include "base/error.hpp"

namespace lobe::view {
namespace {

using nlohmann::json;

constexpr size_t kMostSteps = 200;
constexpr const char* kOrigin = "window";

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool asksForSize(const app::SettingSources& sources) {
    return std::any_of(sources.assignments.begin(), sources.assignments.end(), [](const auto& assignment) {
        return assignment.kind == app::Assignment::Kind::set && assignment.key == "resolution";
    });
}

json vectorOf(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

}  // namespace

Document::Document(app::SettingSources sources)
    : sources_(std::move(sources)), base_(sources_.resolve({})), sizeAsked_(asksForSize(sources_)) {}

void Document::setScene(const std::filesystem::path& file, std::shared_ptr<const Scene> scene,
                        const std::vector<app::SettingLayer>& layers) {
    const bool another = file != file_ || layers != layers_;
    scene_ = std::move(scene);
    settings_.reset();
    if (!another) return;
    base_ = sources_.resolve(file, layers);
    file_ = file;
    layers_ = layers;
    pose_.reset();
    state_.edits = {};
    for (const char* key : {"camera", "camera_position", "camera_focal_point", "camera_azimuth",
                            "camera_elevation", "camera_view_angle"})
        state_.changes.erase(key);
    undo_.clear();
    redo_.clear();
}

app::Settings Document::settingsOf(const State& state) const {
    app::Settings settings = base_;
    const auto put = [&](const std::string& key, const json& value) {
        settings.reset(key, kOrigin);  // what must win against files does not against a person
        if (!value.is_null()) settings.set(key, value, kOrigin);
    };
    if (!sizeAsked_) put("resolution", {width_, height_});
    for (const auto& [key, value] : state.changes)
        put(key, value);
    if (pose_) {
        for (const char* key : {"camera", "camera_azimuth", "camera_elevation"})
            put(key, nullptr);
        put("camera_position", vectorOf(pose_->position));
        put("camera_focal_point", vectorOf(pose_->focal));
        put("camera_view_angle", pose_->viewAngle);
    }
    return settings;
}

std::shared_ptr<const app::Settings> Document::settings() const {
    if (!settings_) settings_ = std::make_shared<const app::Settings>(settingsOf(state_));
    return settings_;
}

void Document::become(State state, const std::string& tag) {
    if (state == state_) return;
    auto settings = std::make_shared<const app::Settings>(settingsOf(state));  // throws for what is wrong
    const double time = now();
    const bool goesOn = !tag.empty() && tag == lastTag_ && time - lastTime_ < 1.0 && !undo_.empty();
    if (!goesOn) undo_.push_back(state_);
    if (undo_.size() > kMostSteps) undo_.pop_front();
    redo_.clear();
    lastTag_ = tag;
    lastTime_ = time;
    state_ = std::move(state);
    settings_ = std::move(settings);
}

void Document::change(const std::string& key, const json& value, const std::string& tag) {
    const app::Setting& setting = app::requireSetting(key, kOrigin);
    State state = state_;
    state.changes[key] = value.is_null() ? json() : app::parseSetting(setting, value, kOrigin);
    become(std::move(state), tag);
}

void Document::changeAll(const json& object, const std::string& origin) {
    app::Settings().setAll(object, origin);
    State state = state_;
    for (const auto& [given, value] : object.items()) {
        const app::Setting& setting =
            app::requireSetting(given.substr(given.starts_with("!") ? 1 : 0), origin);
        state.changes[setting.key] = app::parseSetting(setting, value, origin);
    }
    // One way to place the camera takes the place of another.
    constexpr std::array kCameraKeys{"camera", "camera_position", "camera_focal_point", "camera_azimuth",
                                     "camera_elevation"};
    if (std::any_of(kCameraKeys.begin(), kCameraKeys.end(),
                    [&](const char* key) { return object.contains(key); })) {
        pose_.reset();
        for (const char* key : kCameraKeys)
            if (!object.contains(key)) state.changes[key] = nullptr;
    }
    settings_.reset();
    become(std::move(state), "");
}

void Document::revert(const std::string& key) {
    State state = state_;
    state.changes.erase(key);
    become(std::move(state), "");
}

void Document::revertAll() {
    become({}, "");
}

void Document::edit(Edits edits, const std::string& tag) {
    State state = state_;
    state.edits = std::move(edits);
    become(std::move(state), tag);
}

void Document::setPose(const std::optional<Pose>& pose) {
    if (pose == pose_) return;
    pose_ = pose;
    settings_.reset();
}

void Document::setWindowSize(int width, int height) {
    width = std::max(width, 1);
    height = std::max(height, 1);
    if (width == width_ && height == height_) return;
    width_ = width;
    height_ = height;
    settings_.reset();
}

bool Document::sizeIsFixed() const {
    return sizeAsked_ || state_.changes.contains("resolution");
}

void Document::undo() {
    if (undo_.empty()) return;
    redo_.push_back(std::exchange(state_, std::move(undo_.back())));
    undo_.pop_back();
    lastTag_.clear();
    settings_.reset();
}

void Document::redo() {
    if (redo_.empty()) return;
    undo_.push_back(std::exchange(state_, std::move(redo_.back())));
    redo_.pop_back();
    lastTag_.clear();
    settings_.reset();
}

}  // namespace lobe::view
