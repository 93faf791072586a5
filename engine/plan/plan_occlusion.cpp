// What keeps the prefiltered environment from surfaces: occlusion textures, and what the depth buffer shows.
// Light that is sampled has rays for that.
#include <algorithm>

#include "plan/planner.hpp"

namespace lobe {
namespace {

/// Planes through the view ray, and looks along each side of one, for each sample of a pixel
/// (docs/environment.md, "What is in the way").
constexpr std::pair<int, int> kLow{2, 6}, kHigh{6, 12};

}  // namespace

bool Planner::isPrefiltered(const std::string& model) const {
    const auto found = plan_.environmentMethods.find(model);
    return found != plan_.environmentMethods.end() && found->second.method == EnvironmentMethod::prefiltered;
}

std::string Planner::whyNoShadowOfEnvironment() const {
    if (scene_.environmentCastsShadow) return whyNoShadow(1);
    return "the scene is drawn as if nothing blocked its environment";
}

/// Why nothing dims what is prefiltered; empty if something may.
std::string Planner::whyNoOcclusion() const {
    if (!scene_.environment) return "the scene has no environment";
    if (const std::string reason = whyNoShadowOfEnvironment(); !reason.empty()) return reason;
    const bool any = std::any_of(scene_.surfaces.begin(), scene_.surfaces.end(),
                                 [this](const SurfaceFeatures& f) { return isPrefiltered(f.brdf); });
    return any ? "" : "no surface shows what is prefiltered of the environment";
}

/// Of the lines about textures (summary.cpp: "NAME: SLOT of N materials, SLOT of ...").
void Planner::leaveOutOcclusionTextures() {
    std::vector<std::string> kept;
    for (const std::string& line : plan_.textures) {
        const size_t colon = line.find(": ");
        std::string uses;
        for (size_t from = colon + 2; from < line.size();) {
            const size_t end = std::min(line.find(", ", from), line.size());
            const std::string use = line.substr(from, end - from);
            if (!use.starts_with("occlusion of")) uses += (uses.empty() ? "" : ", ") + use;
            from = end + 2;
        }
        if (uses.empty())
            leaveOut("texture", line.substr(0, colon), "no material in use reads it");
        else
            kept.push_back(line.substr(0, colon) + ": " + uses);
    }
    plan_.textures = kept;
}

void Planner::planOcclusion() {
    const std::string reason = whyNoOcclusion();
    plan_.occlusionTextures =
        reason.empty() &&
        std::any_of(scene_.surfaces.begin(), scene_.surfaces.end(), [this](const SurfaceFeatures& f) {
            return f.texture("occlusion") != nullptr && isPrefiltered(f.brdf);
        });
    plan_.surroundings = scene_.ambient || (scene_.environment && scene_.environmentCastsShadow);
    if (!scene_.ambient && !plan_.occlusionTextures && !scene_.surfacesWithoutOcclusion.empty()) {
        plan_.surroundings = false;
        plan_.surfaces = scene_.surfacesWithoutOcclusion;
        leaveOutOcclusionTextures();
    }
    if (!plan_.occlusionTextures && !(scene_.ambient && scene_.occlusion))
        leaveOut("texture", "occlusion",
                 !scene_.ambient && !scene_.environment ? "there is no ambient light for it to act on"
                 : !scene_.occlusion                    ? "no material has one"
                                                        : reason);
    const auto opaque = [this](const BrdfFacts& facts) { return isPrefiltered(facts.name); };
    const bool shown = deferred_ && std::any_of(scene_.brdfs.begin(), scene_.brdfs.end(), opaque);
    const AmbientOcclusion quality = plan_.quality.ambientOcclusion;
    const std::string left = !reason.empty() ? reason
                             : !deferred_    ? "forward shading"
                             : !shown        ? "no opaque surface shows what is prefiltered"
                             : quality == AmbientOcclusion::off ? "ambient_occlusion is off"
                                                                : "";
    if (!left.empty()) return leaveOut("pass", "ambient_occlusion", left);
    std::tie(plan_.occlusionSlices, plan_.occlusionSteps) = quality == AmbientOcclusion::low ? kLow : kHigh;
}

/// Of the G-buffer; the picture of what the depth buffer shows is beside it.
void Planner::planOcclusionChannels() {
    const auto textured = [this](const SurfaceFeatures& f) {
        return !f.blended() && f.texture("occlusion") != nullptr && isPrefiltered(f.brdf);
    };
    const bool needed =
        plan_.occlusionTextures && std::any_of(plan_.surfaces.begin(), plan_.surfaces.end(), textured);
    if (needed && deferred_)
        addTarget("occlusion", plan_.quality.gbufferBits == 8 ? "R8" : "R16", "factor of occlusion textures",
                  "keeps the prefiltered environment from surfaces");
    if (plan_.occlusionSlices > 0)
        addChannel("ambient_occlusion", "RGBA16",
                   "share of the environment's light that arrives, octahedral mean direction of it",
                   "the prefiltered environment knows of nothing in its way");
}

void Planner::planOcclusionPass() {
    if (plan_.occlusionSlices == 0) return;
    PlannedPass pass{"ambient_occlusion",
                     "pass/ambient_occlusion.frag",
                     {},
                     {"depth", "normal"},
                     {"ambient_occlusion"},
                     "what the depth buffer shows to be in the way of the prefiltered environment: " +
                         plural(plan_.occlusionSlices, "slice") + " of twice " +
                         plural(plan_.occlusionSteps, "look")};
    if (plan_.channel("linear_z") != nullptr) pass.reads.emplace_back("linear_z");
    Defines defines = commonDefines();
    std::erase_if(defines, [](const auto& entry) {
        return entry.first == "HAS_MATERIAL" || entry.first.starts_with("HAS_PARAMETERS");
    });
    defines["OCCLUSION_SLICES"] = std::to_string(plan_.occlusionSlices);
    defines["OCCLUSION_STEPS"] = std::to_string(plan_.occlusionSteps);
    // One program, drawn where each model is that reads it: others have no use for it, and unlit surfaces no normal.
    for (const PlannedBrdf& brdf : plan_.brdfs)
        if (isPrefiltered(brdf.name)) pass.variants.push_back({brdf.name, -1, defines});
    plan_.passes.push_back(pass);
}

}  // namespace lobe
