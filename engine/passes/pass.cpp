#include "passes/pass.hpp"

#include <stdexcept>

#include "passes/body_light_pass.hpp"
#include "passes/forward_pass.hpp"
#include "passes/gbuffer_pass.hpp"
#include "passes/light_pass.hpp"
#include "passes/screen_passes.hpp"

namespace lobe {

std::unique_ptr<Pass> makePass(const PlannedPass& planned, FrameResources& resources) {
    if (planned.name == "gbuffer") return std::make_unique<GbufferPass>(planned, resources);
    if (planned.name == "coverage") return std::make_unique<CoveragePass>(planned, resources);
    if (planned.name == "light.directional")
        return std::make_unique<LightPass>(planned, resources, LightType::directional);
    if (planned.name == "light.point")
        return std::make_unique<LightPass>(planned, resources, LightType::point);
    if (planned.name == "light.spot") return std::make_unique<LightPass>(planned, resources, LightType::spot);
    for (LightType body : {LightType::rect, LightType::disk, LightType::sphere, LightType::tube})
        if (planned.name == std::string("light.") + nameOf(body))
            return std::make_unique<BodyLightPass>(planned, resources, body);
    if (planned.name == "forward") return std::make_unique<ForwardPass>(planned, resources);
    if (planned.name == "accumulate") return std::make_unique<AccumulatePass>(planned, resources);
    if (planned.name == "aov") return std::make_unique<AovPass>(planned, resources);
    throw std::logic_error("no pass class for planned pass " + planned.name);
}

}  // namespace lobe
