/// Pictures of one scene after another on one context, with as little set up anew as the change allows.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>

#include "frame.hpp"

namespace lobe::view {

class PictureMaker {
public:
    /// `compiling` is called with the name of each program before it is compiled.
    PictureMaker(gl::Context& context, std::function<void(const std::string&)> compiling);

    /// The picture, with `scale` times the width and height that are asked for, and one sample a pixel if the
    /// request is moving. Nothing if `stop` was set meanwhile, which is looked at between programs that are
    /// compiled and between passes. Throws Error; the next call starts afresh then.
    std::optional<Frame> make(const FrameRequest& request, double scale, const std::atomic<bool>& stop);

    /// Compiles all programs from their files again. Throws ShaderError, and then goes on with the old ones.
    void reload();

    const Scene& scene() const { return *scene_; }

private:
    struct Stopped {};
    std::optional<Frame> tryToMake(const FrameRequest& request, double scale, const std::atomic<bool>& stop);
    void compose(const FrameRequest& request);
    void set(const RenderOptions& options, bool moving);
    std::unique_ptr<Renderer> freshRenderer();

    gl::Context& context_;
    std::function<void(const std::string&)> compiling_;
    std::unique_ptr<Renderer> renderer_;
    const std::atomic<bool>* stop_ = nullptr;  ///< of the present picture

    std::shared_ptr<const Scene> base_;
    std::shared_ptr<Scene> scene_;  ///< nobody else's, so that it may change
    nlohmann::json changes_, keyLight_;
    std::vector<Material> materials_;  ///< before they were edited
    std::vector<Light> lights_;
    std::optional<Environment> environment_;  ///< before it was turned
    nlohmann::json turn_;                     ///< settings that turn it and make it brighter
    Edits edits_;
    bool changed_ = true;  ///< since the renderer was given the scene

    RenderOptions options_;
    std::shared_ptr<const DrawnScene> drawn_;
};

}  // namespace lobe::view
