/// One scene's entry in a report: settings searched, measured, and compared with the truth.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "measure/timing.hpp"
#include "measure/truth.hpp"

namespace lobe::measure {

struct ReportScene {
    std::shared_ptr<const Scene> scene;
    Camera camera;
    int width = 640, height = 360;
    /// Names of pictures begin with it; different for each scene of a report.
    std::string key;
};

struct ReportEffort {
    int settings = 40;       ///< measured at most
    double seconds = 480.0;  ///< for the scene, without its truth; less is measured if they are short
    bool passes = true;      ///< also time of each pass, and its floor
};

/// What is told while work goes on.
struct ReportEvents {
    /// A picture of linear radiance; "difference" ones are ready for display.
    std::function<void(const std::string& name, const Image& image)> picture;
    std::function<void(const std::string& name, const Bitmap& bitmap)> bitmap;
    std::function<void(const std::string& line)> progress;
    const std::atomic<bool>* stop = nullptr;  ///< set: what is done becomes the result
};

/// The entry (docs/report.md). Throws Error of what it draws with; the result has no settings if it was
/// stopped before the first.
nlohmann::json measureScene(gl::Context& context, const ReportScene& scene, const TruthSource& truth,
                            const ReportEffort& effort, const ReportEvents& events);

/// The key "knobs" of a report.
nlohmann::json knobsJson();

}  // namespace lobe::measure
