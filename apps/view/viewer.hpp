/// The application: what is shown, how far the threads are, and what the person is at. Panels read and change
/// it through its members; none of them draws or loads by itself.
#pragma once

#include <chrono>
#include <deque>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "camera_controller.hpp"
#include "document.hpp"
#include "events_file.hpp"
#include "file_watch.hpp"
#include "messages.hpp"
#include "pick.hpp"
#include "preferences.hpp"
#include "render_worker.hpp"
#include "scene_loading.hpp"
#include "texture.hpp"
#include "truth_worker.hpp"
#include "window.hpp"

namespace lobe::view {

struct ViewerOptions {
    std::string scene;  ///< file or folder; empty: the start page
    app::SettingSources sources;
    gl::ContextRequest context;
    std::string eventsFile;
    std::optional<std::pair<int, int>> windowSize;  ///< points
};

enum class Panel : uint8_t { settings, materials, lights, compare, plan, time, pixel, log };
inline constexpr size_t kPanelCount = 8;
const char* nameOf(Panel panel);

/// What is beside the picture, right of the wipe.
struct Comparison {
    enum class With : uint8_t { nothing, kept, model, truth, error } with = With::nothing;
    std::string model = {};                                  ///< With::model
    std::shared_ptr<const app::Settings> keptSettings = {};  ///< With::kept
    Edits keptEdits = {};
    float wipe = 0.5F;  ///< share of the picture that is ours
};

/// Numbers of the error map.
struct ErrorSummary {
    bool known = false;
    double relMse = 0.0, mean = 0.0, largest = 0.0;  ///< of |x - t| / (t + half the mean of t)
};

/// Times of one plan's pictures.
struct PassHistory {
    std::map<std::string, std::deque<double>> milliseconds;  ///< by pass
    std::deque<double> total;
};

struct Ui {
    bool panels = true, help = false, startPage = false, openDialog = false, saveDialog = false,
         modelGrid = false, inspect = false;
    Panel panel = Panel::settings;
    bool panelAsked = false;  ///< by a command: its tab comes to the front
    std::optional<Panel> panelShown;
    std::string openPath, savePath;
    std::string settingFilter;
    int material = -1, light = -1;
    std::optional<Picked> picked;
    Shown shown;
    Comparison comparison;
    bool polarRoot = true;
    int dragHandle = -1;  ///< of the light's gizmo
    nlohmann::json report;
    std::string reportFile;
    double reportError = 0.01, reportBudget = 16.0;
    std::string reportAnswer;
};

/// Seconds without a change after which the picture is drawn in full.
inline constexpr double kSettleSeconds = 0.15;

struct Viewer {
    explicit Viewer(const ViewerOptions& options);
    ~Viewer();
    int run();

    // Files, by what they are: scene, folder, panorama, GLSL model, MERL table, settings, batch, report. What
    // is wrong becomes a message, and what was shown stays.
    void open(const std::string& file);
    void openNeighbour(int step);  ///< of the scene, in its folder or batch
    void reloadScene();

    /// Runs `action` while no thread uses the registry of models, which it may change.
    void whileIdle(const std::function<void()>& action);
    void say(const std::string& text, bool isError = false);
    /// Runs `action`; what it throws becomes a message.
    void attempt(const std::function<void()>& action);
    /// Marks the last item of ImGui under a name for --events.
    void mark(const std::string& control);
    void showPanel(Panel panel);

    // The camera, which settings place until a person moves it.
    bool takeCamera();  ///< false where there is no picture yet
    void resetCamera();
    double pictureAspect() const;

    std::string stateText() const;    ///< the settings as they are now, as JSON
    std::string commandLine() const;  ///< that makes the same picture
    void useState(const std::string& text, const std::string& origin);
    void savePicture(const std::filesystem::path& file);
    void saveWindow();
    std::filesystem::path freeName(const std::string& suffix);

    void startTruth();
    void explainPixel(double x, double y);
    void forgetThumbnails();                      ///< those in work, which would keep other pictures waiting
    void pickAt(double x, double y, bool pivot);  ///< pixels of the picture
    void compareWith(Comparison comparison);

    double seconds() const;  ///< since the start
    /// The scene as drawn, once there is a picture.
    const DrawnScene* drawn() const { return frame ? frame->drawn.get() : nullptr; }

    ViewerOptions options;
    Preferences preferences;
    EventsFile events;
    Window window;
    RenderWorker worker;
    SceneLoading loading;
    TruthWorker truth;
    Document document;
    CameraController camera;
    Messages messages;
    FileWatch shaders;
    Ui ui;

    std::optional<Frame> frame, other;  ///< shown last; without moving ones for `full`
    std::optional<Frame> full;
    WindowTexture picture, otherPicture;
    Legend otherLegend;
    ErrorSummary errorSummary;
    PassHistory history;
    std::map<std::string, WindowTexture> thumbnailTextures;
    std::map<std::string, std::string> thumbnailErrors;
    std::map<int, WindowTexture> textures;  ///< small, of the scene's images
    std::string explanation;
    std::vector<app::Shot> batch;
    size_t batchIndex = 0;

    // Where the picture is, in points of ImGui, and how much room it has.
    float pictureX = 0.0F, pictureY = 0.0F, pictureWidth = 0.0F, pictureHeight = 0.0F;
    double lastMoved = -1.0;  ///< when something was changed that makes pictures preliminary
    bool wantsSave = false;   ///< the window, with the next frame
    bool withModel(const std::string& model) const;

private:
    std::set<std::string> namesGiven_;  ///< of pictures and states, also those that are still to be written
    void collect();
    void takeFrame(Frame taken);
    void takeOther(Frame taken);
    void takeLoaded(LoadResult result);
    void watchFiles();
    void requestFrames();
    void requestOther();
    void updateTruth();
    void updateErrorMap();
    void loadIfChanged();
    nlohmann::json loadKey() const;
    void drawInterface();
    void announceRest();
    void record(const Frame& shownFrame);

    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::optional<FrameRequest> requested_, requestedOther_;
    uint64_t number_ = 0;
    nlohmann::json loadedKey_;
    double lastWatch_ = 0.0;
    int truthRounds_ = 0;
    uint64_t errorOf_ = 0;
    std::future<std::string> explaining_;
    const FramePlan* historyPlan_ = nullptr;
    std::shared_ptr<const DrawnScene> historyDrawn_;
    int settle_ = 3;  ///< frames that ImGui needs after input
    double lastFrame_ = 0.0;
    uint64_t announced_ = 0;  ///< the frame at which all was at rest; 0: it is not
};

}  // namespace lobe::view
