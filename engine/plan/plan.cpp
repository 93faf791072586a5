#include "plan/plan.hpp"

#include <algorithm>

#include "plan/planner.hpp"

namespace lobe {

std::string plural(int count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

int bytesOfFormat(const std::string& format) {
    static const std::map<std::string, int> sizes = {{"R8", 1},
                                                     {"RG8", 2},
                                                     {"RGBA8", 4},
                                                     {"R16", 2},
                                                     {"RG16", 4},
                                                     {"RGBA16", 8},
                                                     {"R32F", 4},
                                                     {"RG32F", 8},
                                                     {"RGBA16F", 8},
                                                     {"RGBA32F", 16},
                                                     {"R8UI", 1},
                                                     {"R16UI", 2},
                                                     {"R32UI", 4},
                                                     {"RG32UI", 8},
                                                     {"DEPTH_COMPONENT24", 4},
                                                     {"DEPTH_COMPONENT32F", 4},
                                                     {"DEPTH24_STENCIL8", 4},
                                                     {"DEPTH32F_STENCIL8", 8}};
    return sizes.at(format);
}

bool scattersLight(const std::string& model) {
    return model != kUnlit && requireBrdf(model).traits.scattersLight;
}

FramePlan Planner::plan() {
    plan_.samples = plan_.quality.samples;
    plan_.surfaces = scene_.surfaces;
    plan_.ambient = scene_.ambient;
    plan_.textures = scene_.textures;
    plan_.reversedDepth = capabilities_.clipControl;
    deferred_ = plan_.quality.shading == Shading::deferred;
    anyLight_ = scene_.directionalLights + scene_.pointLights + scene_.spotLights > 0 ||
                !scene_.bodyLights.empty() || scene_.environment;
    unlit_ = std::any_of(scene_.brdfs.begin(), scene_.brdfs.end(),
                         [](const BrdfFacts& f) { return f.name == kUnlit; });
    hasDeferredSurface_ = deferred_ && !scene_.brdfs.empty();
    for (Aov aov : aovs_)
        dataAovs_ |= aov != Aov::radiance && aov != Aov::contributions;
    needsDeferredTargets_ = !scene_.brdfs.empty() && (deferred_ || dataAovs_);
    contributions_ = aovs_.contains(Aov::contributions);

    planModels();
    planShadows();
    planOcclusion();
    planTable();
    planGeometryChannels();
    planRadiance();
    planLights();
    planPasses();
    planVertexData();
    for (const std::string& texture : scene_.unusedTextures)
        leaveOut("texture", texture, "no material in use reads it");
    return std::move(plan_);
}

PlannedShadow FramePlan::shadowOf(LightType type) const {
    const auto found = shadows.find(type);
    return found == shadows.end() ? PlannedShadow::none : found->second;
}

bool FramePlan::anyShadow() const {
    return environmentShadow != PlannedShadow::none ||
           std::any_of(shadows.begin(), shadows.end(),
                       [](const auto& entry) { return entry.second != PlannedShadow::none; });
}

const PlannedPass* FramePlan::pass(std::string_view name) const {
    for (const PlannedPass& candidate : passes)
        if (candidate.name == name) return &candidate;
    return nullptr;
}

const Channel* FramePlan::channel(std::string_view name) const {
    for (const Channel& candidate : channels)
        if (candidate.name == name) return &candidate;
    return nullptr;
}

const PlannedBrdf* FramePlan::brdf(std::string_view name) const {
    for (const PlannedBrdf& candidate : brdfs)
        if (candidate.name == name) return &candidate;
    return nullptr;
}

int FramePlan::gbufferBytesPerPixel() const {
    int bytes = channel("depth") != nullptr ? channel("depth")->bytesPerPixel : 0;
    for (const std::string& target : gbufferTargets)
        bytes += channel(target)->bytesPerPixel;
    return bytes;
}

FramePlan planFrame(const SceneSummary& summary, const Quality& quality, const Capabilities& capabilities,
                    const AovSet& aovs) {
    return Planner(summary, quality, capabilities, aovs).plan();
}

}  // namespace lobe
