// Fog over the opaque picture, and the light of lamps that it scatters.
#include <algorithm>

#include "base/error.hpp"
#include "plan/planner.hpp"

namespace lobe {
namespace {

/// Software drivers end loops, nested ones together, at 65535 rounds.
constexpr int kMostRounds = 65000;

}  // namespace

void Planner::fogDefines(Defines& defines) const {
    if (scene_.fogFallsOff) defines["FOG_HEIGHT"] = "1";
}

/// Loops over all lights of a type, in one draw of a blended surface.
void Planner::requireAirlightLoop(const char* type, int count) const {
    const int most = kMostRounds / plan_.airlightNodes;
    if (count > most && scene_.blended)
        throw InputError("the scene has " + plural(count, std::string(type) + " light") +
                         " in fog that scatters, with blended surfaces; expected at most " +
                         std::to_string(most) + " for " + std::to_string(plan_.airlightNodes) + " nodes");
}

void Planner::airlightDefines(Defines& defines, LightType type) const {
    defines["AIRLIGHT_NODES"] = std::to_string(plan_.airlightNodes);
    if (scene_.fogGrey) defines["AIRLIGHT_GREY"] = "1";
    defines[type == LightType::point ? "AIRLIGHT_POINTS" : "AIRLIGHT_SPOTS"] = "1";
    if (type == LightType::spot)
        defines["AIRLIGHT_SPOT_TEXELS"] = plan_.shadowOf(LightType::spot) == PlannedShadow::none ? "3" : "4";
}

/// One variant for where surfaces are, one for the endless way behind them.
void Planner::addFogVariants(PlannedPass& pass, const Defines& defines) const {
    if (hasDeferredSurface_) {
        Defines surface = defines;
        if (!plan_.reversedDepth) surface["LINEAR_Z"] = "1";
        pass.variants.push_back({"", -1, surface});
    }
    Defines background = defines;
    background["FOG_BACKGROUND"] = "1";
    pass.variants.push_back({"", -1, background});
}

/// What is in each contribution by now, of surfaces and of the environment behind them, is dimmed as the sum
/// is.
void Planner::addFogDims(PlannedPass& pass) const {
    std::vector<Variant> dimmed;
    if (hasDeferredSurface_) dimmed.push_back(pass.variants.front());
    if (scene_.environmentSeen) dimmed.push_back(pass.variants.back());
    if (dimmed.empty()) return;
    for (Variant& variant : dimmed) {
        variant.defines["FOG_DIMS"] = "1";
        pass.variants.push_back(variant);
    }
    // Where all surfaces are drawn forward, the environment behind them is with what is transparent.
    for (const std::string& name : plan_.contributionTargets)
        if (name != "fog" && (name == "transparent") != deferred_)
            pass.writes.push_back("contribution." + name);
}

void Planner::planFog() {
    if (!scene_.fog) return leaveOut("pass", "fog", "the scene has no fog");
    PlannedPass pass{"fog",
                     "pass/fog.frag",
                     {},
                     {},
                     {contributions_ ? "contribution.fog" : "radiance"},
                     scene_.fogFallsOff ? "fog whose density falls off with height, in closed form"
                                        : "fog, in closed form"};
    if (hasDeferredSurface_) pass.reads.emplace_back(plan_.reversedDepth ? "depth" : "linear_z");
    pass.reason += hasDeferredSurface_ ? "; blended surfaces have it in the forward pass"
                                       : "; surfaces have it in the forward pass";
    Defines defines;
    fogDefines(defines);
    addFogVariants(pass, defines);
    if (contributions_) addFogDims(pass);
    plan_.passes.push_back(pass);
}

void Planner::planAirlight() {
    const int lamps = scene_.pointLights + scene_.spotLights;
    const std::string reason = !scene_.fog                        ? "the scene has no fog"
                               : !scene_.fogScatters              ? "the fog scatters no light"
                               : lamps == 0                       ? "no point or spot light in the fog"
                               : plan_.quality.airlightNodes == 0 ? "airlight_nodes is 0"
                                                                  : "";
    if (!reason.empty()) return leaveOut("pass", "airlight", reason);
    plan_.airlightNodes = plan_.quality.airlightNodes;
    requireAirlightLoop("point", scene_.pointLights);
    requireAirlightLoop("spot", scene_.spotLights);
    PlannedPass pass{"airlight",
                     "pass/airlight.frag",
                     {},
                     {},
                     {contributions_ ? "contribution.fog" : "radiance"},
                     "light of " + plural(lamps, "lamp") + " that the fog scatters once, " +
                         plural(plan_.airlightNodes, "node") + " a light, without shadows"};
    if (hasDeferredSurface_) pass.reads.emplace_back(plan_.reversedDepth ? "depth" : "linear_z");
    for (const auto& [type, count] :
         {std::pair(LightType::point, scene_.pointLights), std::pair(LightType::spot, scene_.spotLights)}) {
        if (count == 0) continue;
        Defines defines;
        airlightDefines(defines, type);
        addFogVariants(pass, defines);
    }
    plan_.passes.push_back(pass);
}

}  // namespace lobe
