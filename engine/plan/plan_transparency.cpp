// Surfaces that are drawn over what lies behind them, and how those are put in order.
#include <algorithm>

#include "plan/planner.hpp"

namespace lobe {
namespace {

/// Beyond, what is left is drawn object by object: a bound on the time that one picture takes.
constexpr size_t kMostLayers = 256;

}  // namespace

void Planner::peelDefines(Defines& defines) const {
    defines["PEELED"] = "1";
    if (!plan_.reversedDepth) defines["LINEAR_Z"] = "1";
}

void Planner::forwardDefines(Defines& defines, const SurfaceFeatures& features) const {
    defines = surfaceDefines(features);
    if (scattersLight(features.brdf)) {
        const std::pair<LightType, int> types[] = {{LightType::directional, scene_.directionalLights},
                                                   {LightType::point, scene_.pointLights},
                                                   {LightType::spot, scene_.spotLights}};
        for (const auto& [type, lights] : types) {
            if (lights == 0) continue;
            lightDefines(defines, type);
            shadowDefines(defines, type);
        }
    }
    defines.merge(forwardBodyDefines(features.brdf));
    defines.merge(environmentDefines(features.brdf));
    if (plan_.occlusionTextures && features.texture("occlusion") != nullptr && isPrefiltered(features.brdf))
        defines["OCCLUSION_TEXTURES"] = "1";
    if (scene_.fog) {
        defines["FOG"] = "1";
        fogDefines(defines);
    }
    if (plan_.airlightNodes > 0) {
        if (scene_.pointLights > 0) airlightDefines(defines, LightType::point);
        if (scene_.spotLights > 0) airlightDefines(defines, LightType::spot);
    }
}

/// What the forward pass draws into, at once or, where what shows through is coloured, one after the other:
/// OpenGL 3.3 has two outputs of a shader to blend with for one target only.
std::vector<std::string> Planner::forwardTargets() const {
    if (!contributions_) return {"radiance"};
    std::vector<std::string> targets{"contribution.transparent"};
    if (scene_.fog) targets.emplace_back("contribution.fog");
    targets.emplace_back("radiance");  // coverage only
    if (deferred_) targets.emplace_back("transmittance");
    return targets;
}

void Planner::planForward() {
    if (!scene_.blended && deferred_) {
        leaveOut("pass", "forward", "no blended surface");
        return leaveOut("pass", "peel", "no blended surface");
    }
    const bool peeled = scene_.blended && plan_.quality.transparency == Transparency::peeled;
    if (peeled) plan_.mostLayers = static_cast<int>(std::min(kMostLayers, scene_.blendedTriangles));
    PlannedPass pass{"forward", "pass/forward.frag", {}, {"depth"}, forwardTargets(), ""};
    if (contributions_ && deferred_)
        addChannel("transmittance", radianceFormat(), "what blended surfaces let through",
                   "dims each contribution at once");
    // One program writes all targets, unless each needs the two outputs that coloured transmittance takes.
    const bool apart = scene_.transmits && pass.writes.size() > 1;
    for (size_t i = 0; i < plan_.surfaces.size(); ++i) {
        const SurfaceFeatures& features = plan_.surfaces[i];
        if (deferred_ && !features.blended()) continue;
        Defines defines;
        forwardDefines(defines, features);
        if (contributions_) defines["CONTRIBUTIONS"] = "1";
        if (features.blended() && scene_.transmits) defines["COLORED_TRANSMITTANCE"] = "1";
        if (features.blended() && peeled) peelDefines(defines);
        for (size_t t = 0; t < pass.writes.size(); ++t)
            defines["OUT_" + defineName(pass.writes[t])] = std::to_string(t);
        if (!features.blended() || !apart) {
            pass.variants.push_back({features.brdf, static_cast<int>(i), defines});
            continue;
        }
        for (size_t t = 0; t < pass.writes.size(); ++t) {
            Defines one = defines;
            for (const std::string& other : pass.writes)
                one.erase("OUT_" + defineName(other));
            one["OUT_" + defineName(pass.writes[t])] = "0";
            one["ONLY_TARGET"] = std::to_string(t);
            pass.variants.push_back({features.brdf, static_cast<int>(i), one});
        }
    }
    pass.reason = deferred_ ? plural(static_cast<int>(scene_.blendedInstances), "blended instance")
                            : "forward shading is asked for";
    if (scene_.blended)
        pass.reason += peeled ? ", peeled layer by layer from the farthest, at most " +
                                    plural(plan_.mostLayers, "layer") +
                                    "; what is nearer is drawn object by object"
                              : ", drawn back to front";
    planPeel(peeled);
    plan_.passes.push_back(pass);
    if (contributions_ && deferred_) planDim();
}

void Planner::planDim() {
    PlannedPass pass{"dim", "pass/dim.frag",
                     {{}},  {"transmittance"},
                     {},    "what lies behind blended surfaces is dimmed in each contribution"};
    for (const std::string& name : plan_.contributionTargets)
        if (name != "fog" && name != "transparent") pass.writes.push_back("contribution." + name);
    plan_.passes.push_back(pass);
}

/// The pass that finds the next layer. It is run by the forward pass, as often as there are layers.
void Planner::planPeel(bool peeled) {
    if (!peeled)
        return leaveOut("pass", "peel",
                        scene_.blended ? "blended surfaces are sorted by object" : "no blended surface");
    addChannel("layer", "RG32UI", "depth and triangle of a layer",
               "twice: the next one is in front of the last");
    addChannel("layer_depth", "DEPTH_COMPONENT32F", "depth of a layer", "its fragments alone are shaded");
    PlannedPass pass{"peel",
                     "pass/peel.frag",
                     {},
                     {"depth", "layer"},
                     {"layer", "layer_depth"},
                     "finds the blended surfaces' next layer"};
    for (size_t i = 0; i < plan_.surfaces.size(); ++i) {
        const SurfaceFeatures& features = plan_.surfaces[i];
        if (!features.blended()) continue;
        Defines defines = surfaceDefines(features);
        peelDefines(defines);
        pass.variants.push_back({features.brdf, static_cast<int>(i), defines});
    }
    plan_.passes.push_back(pass);
}

}  // namespace lobe
