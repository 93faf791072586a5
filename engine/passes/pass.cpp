#include "passes/pass.hpp"

#include <stdexcept>

#include "passes/fog_passes.hpp"
#include "passes/forward_pass.hpp"
#include "passes/gbuffer_pass.hpp"
#include "passes/light_pass.hpp"
#include "passes/occlusion_pass.hpp"
#include "passes/screen_passes.hpp"
#include "passes/shadow_map_pass.hpp"

namespace lobe {

std::unique_ptr<Pass> makePass(const PlannedPass& planned, FrameResources& resources) {
    if (planned.name == "shadow.maps") return std::make_unique<ShadowMapPass>(planned, resources);
    if (planned.name == "gbuffer") return std::make_unique<GbufferPass>(planned, resources);
    if (planned.name == "coverage") return std::make_unique<CoveragePass>(planned, resources);
    for (LightType type : {LightType::directional, LightType::point, LightType::spot})
        if (planned.name == std::string("light.") + nameOf(type))
            return std::make_unique<PunctualLightPass>(planned, resources, type);
    for (LightType type : {LightType::rect, LightType::disk, LightType::sphere, LightType::tube})
        if (planned.name == std::string("light.") + nameOf(type))
            return std::make_unique<BodyLightPass>(planned, resources, type);
    if (planned.name == "ambient_occlusion") return std::make_unique<OcclusionPass>(planned, resources);
    if (planned.name == "light.environment") return std::make_unique<EnvironmentPass>(planned, resources);
    if (planned.name == "background") return std::make_unique<BackgroundPass>(planned, resources);
    if (planned.name == "fog") return std::make_unique<FogPass>(planned, resources);
    if (planned.name == "airlight") return std::make_unique<AirlightPass>(planned, resources);
    if (planned.name == "dim") return std::make_unique<DimPass>(planned, resources);
    if (planned.name == "forward") return std::make_unique<ForwardPass>(planned, resources);
    if (planned.name == "accumulate") return std::make_unique<AccumulatePass>(planned, resources);
    if (planned.name == "aov") return std::make_unique<AovPass>(planned, resources);
    throw std::logic_error("no pass class for planned pass " + planned.name);
}

}  // namespace lobe
