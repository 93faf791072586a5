/// Runs a FramePlan on an OpenGL context: scene in, linear radiance and timings out.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gl/context.hpp"
#include "gl/program.hpp"
#include "image/image.hpp"
#include "plan/plan.hpp"
#include "scene/camera.hpp"
#include "scene/scene.hpp"

namespace lobe {

struct PassTime {
    std::string pass;
    double milliseconds = 0.0;
};

struct Picture {
    /// R,G,B,A: radiance and coverage, or everything asked for as named layers (plan/aov.hpp).
    Image image;
    std::vector<PassTime> passTimes;    ///< summed over the samples of the frame; "readback" included
    std::vector<std::string> warnings;  ///< where the picture falls short of what the plan says
    double milliseconds = 0.0;          ///< wall clock, from the first draw to the pixels being here
};

struct RenderOptions {
    int width = 1280;
    int height = 720;
    Quality quality;
    AovSet aovs = {Aov::radiance};
    bool timePasses = false;  ///< costs a finish a pass on software drivers

    bool operator==(const RenderOptions&) const = default;
};

/// How one picture is drawn, where not as the plan says.
struct RenderRun {
    int samples = 0;                          ///< a pixel; 0: as many as the plan has
    const std::atomic<bool>* stop = nullptr;  ///< once it is set, drawing ends with the present pass
};

/// The GLSL library, with the models that were loaded from files of their own (shading/brdf_file.hpp).
gl::ShaderLibrary shaderLibrary();

/// What planning needs to know of a context.
Capabilities capabilitiesOf(const gl::ContextInfo& info);

/// One a context; knows the models that are registered when it is made; reuses uploads and programs from
/// picture to picture. Throws ShaderError, ContextError.
class Renderer {
public:
    explicit Renderer(gl::Context& context);
    ~Renderer();

    /// Uploads what the plan needs of the scene; textures that are there already stay. The scene is kept
    /// until the next call; it may be changed between pictures if it is set again before the next one.
    /// With `borrow`, maps of the environment that take long to make may be those of a similar scene before.
    void setScene(std::shared_ptr<const Scene> scene, const RenderOptions& options, bool borrow = false);
    /// Whether they are.
    bool borrowed() const;
    /// The plan of the scene and options set last.
    const FramePlan& plan() const;

    /// Pictures of another size from now on, with all else as it is.
    void resize(int width, int height);

    /// Called with the name of each program before it is compiled.
    void onCompile(std::function<void(const std::string&)> callback);

    /// A picture that was stopped has no pixels.
    Picture render(const Camera& camera, const RenderRun& run = {});

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lobe
