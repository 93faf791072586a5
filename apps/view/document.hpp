/// What is shown: a scene with settings and edits, and the way back.
#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "edits.hpp"
#include "pose.hpp"
#include "shots.hpp"

namespace lobe::view {

class Document {
public:
    /// `sources`: configuration and command line, on which changes lie.
    explicit Document(app::SettingSources sources);

    /// Shows another scene, or the same one loaded anew (then edits and camera stay). `layers` are what a
    /// batch file says of it.
    void setScene(const std::filesystem::path& file, std::shared_ptr<const Scene> scene,
                  const std::vector<app::SettingLayer>& layers = {});
    const std::filesystem::path& file() const { return file_; }
    const std::shared_ptr<const Scene>& scene() const { return scene_; }  ///< as loaded; null at first

    /// All settings as they are now. The same object until something changes.
    std::shared_ptr<const app::Settings> settings() const;
    const Edits& edits() const { return state_.edits; }
    bool isChanged(const std::string& key) const { return state_.changes.contains(key); }

    /// Changes that come within a second under one `tag` are undone as one. Throws UsageError, and then
    /// nothing has changed.
    void change(const std::string& key, const nlohmann::json& value, const std::string& tag = "");
    void changeAll(const nlohmann::json& object, const std::string& origin);
    void revert(const std::string& key);  ///< to what configuration and command line say
    void revertAll();                     ///< settings and edits
    void edit(Edits edits, const std::string& tag = "");

    /// The camera, which undoing leaves alone. Without a pose it is the settings'.
    void setPose(const std::optional<Pose>& pose);
    const std::optional<Pose>& pose() const { return pose_; }

    /// Size of the picture where the settings do not fix it.
    void setWindowSize(int width, int height);
    bool sizeIsFixed() const;

    bool canUndo() const { return !undo_.empty(); }
    bool canRedo() const { return !redo_.empty(); }
    void undo();
    void redo();

private:
    struct State {
        std::map<std::string, nlohmann::json> changes;
        Edits edits;
        bool operator==(const State&) const = default;
    };
    app::Settings settingsOf(const State& state) const;
    void become(State state, const std::string& tag);

    app::SettingSources sources_;
    std::vector<app::SettingLayer> layers_;
    std::filesystem::path file_;
    std::shared_ptr<const Scene> scene_;
    app::Settings base_;
    State state_;
    std::deque<State> undo_, redo_;
    std::string lastTag_;
    double lastTime_ = 0.0;
    std::optional<Pose> pose_;
    int width_ = 1280, height_ = 720;
    bool sizeAsked_ = false;
    mutable std::shared_ptr<const app::Settings> settings_;
};

}  // namespace lobe::view
