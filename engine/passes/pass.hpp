/// A pass runs what the plan says of it and asks the scene nothing.
#pragma once

#include <memory>
#include <set>
#include <string>

#include "passes/body_lights.hpp"
#include "passes/environment_light.hpp"
#include "passes/light_buffers.hpp"
#include "passes/program_cache.hpp"
#include "passes/ray_scene.hpp"
#include "passes/screen_state.hpp"
#include "passes/shadow_maps.hpp"
#include "passes/surface_draws.hpp"
#include "passes/targets.hpp"

namespace lobe {

/// What passes share; lives as long as the scene is set.
struct FrameResources {
    const Scene& scene;
    const FramePlan& plan;
    ProgramCache& programs;
    Targets& targets;
    SurfaceDraws& surfaces;
    LightBuffers& lights;
    BodyLights& bodies;
    EnvironmentLight& environment;  ///< empty where the plan has none
    ScreenInputs& inputs;
    RayScene& rays;  ///< empty where the plan has none
    ShadowMaps& shadowMaps;
    std::set<std::string> remarks;  ///< what a picture lacks of what the plan says; for people
    int samples = 1;                ///< that the present picture is the mean of
};

class Pass {
public:
    Pass(const PlannedPass& planned, FrameResources& resources) : planned_(planned), resources_(resources) {}
    virtual ~Pass() = default;
    /// Compiles and uploads what run() will need. Throws ShaderError, InputError.
    virtual void prepare() = 0;
    virtual void run(const View& view) = 0;
    const std::string& name() const { return planned_.name; }

protected:
    const FramePlan& plan() const { return resources_.plan; }
    const Targets& targets() const { return resources_.targets; }
    FrameResources& resources() const { return resources_; }
    const PlannedPass& planned_;

private:
    FrameResources& resources_;
};

/// The pass class for a planned pass, by its name.
std::unique_ptr<Pass> makePass(const PlannedPass& planned, FrameResources& resources);

}  // namespace lobe
