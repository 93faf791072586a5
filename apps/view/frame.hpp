/// What is asked of the drawing thread, and what comes back.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "edits.hpp"
#include "gl/context.hpp"
#include "passes/renderer.hpp"
#include "settings.hpp"
#include "shown.hpp"

namespace lobe::view {

struct FrameRequest {
    uint64_t number = 0;  ///< of the frame that it becomes
    std::filesystem::path file;
    std::shared_ptr<const Scene> base;  ///< as loaded
    std::shared_ptr<const app::Settings> settings;
    Edits edits;
    Shown shown;
    bool moving = false;  ///< soon is better than good: fewer pixels and samples
    bool toFile = false;  ///< with all quantities that the settings ask for, in place of what is shown
};

/// Facts about what is drawn that panels show.
struct DrawnScene {
    FramePlan plan;
    SceneSummary summary;
    std::vector<Material> materials;
    std::vector<Light> lights;
    bool hasEnvironment = false, hasKeyLight = false;
    std::vector<std::string> warnings;
};

struct Frame {
    uint64_t number = 0;
    bool moving = false;
    Shown shown;
    std::shared_ptr<const app::Settings> settings;
    Edits edits;
    int width = 0, height = 0;  ///< that were asked for; of the image too unless moving
    Image image;
    Display display;
    Camera camera;
    std::vector<PassTime> passes;
    double drawMs = 0.0, setMs = 0.0;  ///< on the wall; setting the scene up, where that was needed
    std::shared_ptr<const DrawnScene> drawn;
    std::vector<std::string> warnings;
    std::string error;  ///< why there is no picture; else empty
};

}  // namespace lobe::view
