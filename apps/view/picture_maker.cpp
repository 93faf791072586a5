#include "picture_maker.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/error.hpp"
#include "shot_environment.hpp"
#include "shot_scene.hpp"

namespace lobe::view {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

PictureMaker::PictureMaker(gl::Context& context, std::function<void(const std::string&)> compiling)
    : context_(context), compiling_(std::move(compiling)), renderer_(freshRenderer()) {}

std::unique_ptr<Renderer> PictureMaker::freshRenderer() {
    auto renderer = std::make_unique<Renderer>(context_);
    renderer->onCompile([this](const std::string& name) {
        if (stop_ != nullptr && *stop_) throw Stopped();  // what was compiled is kept
        if (compiling_) compiling_(name);
    });
    return renderer;
}

void PictureMaker::compose(const FrameRequest& request) {
    nlohmann::json changes = app::changesOf(*request.base, *request.settings);
    const nlohmann::json keyLight = changes.value("key_light", nlohmann::json());
    changes.erase("key_light");
    // Turning the environment needs none of its texels, unless a blurred picture was made of them.
    nlohmann::json turn = nlohmann::json::object();
    if (changes.value("env_background", "") != "blur")
        for (const char* key : {"env_rotation", "env_intensity"})
            if (changes.contains(key)) {
                turn[key] = changes[key];
                changes.erase(key);
            }
    const bool anew = request.base != base_ || changes != changes_ || scene_ == nullptr;
    if (anew) {
        base_.reset();
        app::Settings unturned = *request.settings;
        for (const auto& [key, value] : turn.items())
            unturned.reset(key, "window");
        scene_ = composedScene(request.base, unturned, {});
        environment_ = scene_->environment;
        materials_ = scene_->materials;
        lights_ = scene_->lights;
        base_ = request.base;
        changes_ = std::move(changes);
    } else if (keyLight != keyLight_) {
        // Lobe's own light stands where the camera wants it.
        scene_->lights = base_->lights;
        scene_->ambientRadiance = base_->ambientRadiance;
        if (!keyLight.is_null()) addDefaultLight(*scene_, app::cameraOf(*base_, *request.settings, 0));
        lights_ = scene_->lights;
    }
    if (!anew && keyLight == keyLight_ && request.edits == edits_ && turn == turn_) return;
    scene_->environment = environment_;
    scene_->lights = lights_;  // its sun is among them
    if (!turn.empty()) app::placeEnvironment(*scene_, *request.settings);
    turn_ = std::move(turn);
    scene_->materials = materials_;
    applyEdits(*scene_, request.edits);
    keyLight_ = keyLight;
    edits_ = request.edits;
    changed_ = true;
}

void PictureMaker::set(const RenderOptions& options, bool moving) {
    RenderOptions sized = options;
    sized.width = options_.width;
    sized.height = options_.height;
    if (drawn_ && !changed_ && sized == options_ && (moving || !renderer_->borrowed())) {
        if (options != options_) renderer_->resize(options.width, options.height);
        options_ = options;
        return;
    }
    drawn_.reset();  // stays so if this fails
    renderer_->setScene(scene_, options, moving);
    options_ = options;
    changed_ = false;
    auto drawn = std::make_shared<DrawnScene>();
    drawn->plan = renderer_->plan();
    drawn->summary = summarise(*scene_);
    drawn->materials = scene_->materials;
    drawn->lights = scene_->lights;
    drawn->hasEnvironment = scene_->environment.has_value();
    drawn->hasKeyLight = !keyLight_.is_null();
    drawn->warnings = scene_->warnings;
    drawn_ = std::move(drawn);
}

std::optional<Frame> PictureMaker::make(const FrameRequest& request, double scale,
                                        const std::atomic<bool>& stop) {
    stop_ = &stop;
    try {
        std::optional<Frame> frame = tryToMake(request, scale, stop);
        stop_ = nullptr;
        return frame;
    } catch (const Stopped&) {
        stop_ = nullptr;
        return {};
    } catch (...) {
        stop_ = nullptr;
        throw;
    }
}

std::optional<Frame> PictureMaker::tryToMake(const FrameRequest& request, double scale,
                                             const std::atomic<bool>& stop) {
    Frame frame;
    frame.number = request.number;
    frame.moving = request.moving;
    frame.shown = request.shown;
    frame.settings = request.settings;
    frame.edits = request.edits;
    app::requireOneCamera(*request.settings);
    frame.camera = app::cameraOf(*request.base, *request.settings, 0);
    const auto start = Clock::now();
    compose(request);
    RenderOptions options = app::renderOptionsOf(*request.settings);
    if (!request.toFile) options.aovs = {Aov::radiance, request.shown.aov};
    options.timePasses = true;
    frame.width = options.width;
    frame.height = options.height;
    if (scale < 1.0) {
        options.width = std::max(1, static_cast<int>(std::lround(scale * options.width)));
        options.height = std::max(1, static_cast<int>(std::lround(scale * options.height)));
    }
    if (stop) return {};
    set(options, request.moving);
    frame.setMs = millisecondsSince(start);
    frame.drawn = drawn_;
    const auto drawing = Clock::now();
    Picture picture = renderer_->render(frame.camera, {request.moving ? 1 : 0, &stop});
    if (picture.image.values.empty()) return {};
    frame.drawMs = millisecondsSince(drawing);
    frame.image = std::move(picture.image);
    frame.passes = std::move(picture.passTimes);
    frame.warnings = std::move(picture.warnings);
    if (!request.toFile) frame.display = displayOf(frame.image, request.shown, *request.settings);
    return frame;
}

void PictureMaker::reload() {
    // A model's file may have other parameters than when the scene was made.
    if (scene_ && !std::all_of(scene_->materials.begin(), scene_->materials.end(), fitsModel)) scene_.reset();
    if (!scene_ || !drawn_) {
        renderer_ = freshRenderer();
        drawn_.reset();
        return;
    }
    auto fresh = freshRenderer();
    fresh->setScene(scene_, options_);
    renderer_ = std::move(fresh);
}

}  // namespace lobe::view
