// Passes and the variants of their programs.
#include <algorithm>
#include <cctype>

#include "plan/planner.hpp"

namespace lobe {

std::string defineName(std::string name) {
    std::replace(name.begin(), name.end(), '.', '_');
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return name;
}

Planner::Defines Planner::commonDefines() const {
    Defines defines;
    if (!plan_.reversedDepth) defines["LINEAR_Z"] = "1";
    if (normalBits_ == 32) defines["NORMAL_32F"] = "1";
    if (normalBits_ == 8) defines["NORMAL_8"] = "1";
    if (plan_.channel("normal") != nullptr) defines["HAS_NORMAL"] = "1";
    if (plan_.channel("material") != nullptr) defines["HAS_MATERIAL"] = "1";
    for (int i = 0; plan_.channel("parameters" + std::to_string(i)) != nullptr; ++i)
        defines["HAS_PARAMETERS" + std::to_string(i)] = "1";
    return defines;
}

void Planner::lightDefines(Defines& defines, LightType type) const {
    switch (type) {
        case LightType::directional:
            defines["DIRECTIONAL_LIGHTS"] = "1";
            break;
        case LightType::point:
            if (plan_.globalPointLights > 0) defines["POINT_LIGHTS"] = "1";
            if (plan_.clusteredPoint) defines["POINT_CLUSTERS"] = "1";
            break;
        case LightType::spot:
            if (plan_.globalSpotLights > 0) defines["SPOT_LIGHTS"] = "1";
            if (plan_.clusteredSpot) defines["SPOT_CLUSTERS"] = "1";
            break;
        default:
            break;
    }
}

void Planner::shadowDefines(Defines& defines, LightType type) const {
    static const std::map<LightType, std::string> kNames{
        {LightType::directional, "DIRECTIONAL"}, {LightType::point, "POINT"}, {LightType::spot, "SPOT"}};
    const PlannedShadow method = plan_.shadowOf(type);
    if (method == PlannedShadow::none) return;
    defines["SHADOWS"] = "1";
    defines[kNames.at(type) + "_SHADOWS"] = "1";
    defines[kNames.at(type) + (method == PlannedShadow::rays ? "_SHADOW_RAYS" : "_SHADOW_MAPS")] = "1";
    if (method == PlannedShadow::rays) rayDefines(defines);
    shadowMapDefines(defines, type);
}

Planner::Defines Planner::surfaceDefines(const SurfaceFeatures& features) const {
    Defines defines;
    const auto flag = [&](const char* key, bool on) {
        if (on) defines[key] = "1";
    };
    flag("UV0", features.usesUv(0));
    flag("UV1", features.usesUv(1));
    flag("VERTEX_COLORS", features.vertexColors);
    flag("NORMAL_MAP", features.texture("normal") != nullptr);
    flag("ALPHA_MASK", features.alphaMode == AlphaMode::mask);
    flag("ALPHA_BLEND", features.alphaMode == AlphaMode::blend);
    flag("TRANSMISSION", features.transmits);
    flag("EMISSION", features.emission);
    flag("TANGENTS", features.texture("normal") != nullptr ||
                         (features.brdf != kUnlit && requireBrdf(features.brdf).traits.usesTangent));
    flag("UNLIT", features.brdf == kUnlit);
    flag("AMBIENT", scene_.ambient && features.brdf != kUnlit);
    flag("OCCLUSION", features.texture("occlusion") != nullptr);
    flag("FRESNEL_BANDS", scene_.bandedBrdfs.contains(features.brdf));
    flag("USES_TANGENT", features.brdf != kUnlit && requireBrdf(features.brdf).traits.usesTangent);
    return defines;
}

void Planner::planPasses() {
    planShadowMaps();
    planGbufferPass();
    planCoverage();
    planLightPass(LightType::directional, scene_.directionalLights);
    planLightPass(LightType::point, scene_.pointLights);
    planLightPass(LightType::spot, scene_.spotLights);
    planBodyPasses();
    planOcclusionPass();
    planEnvironmentPass();
    planBackground();
    planFog();
    planAirlight();
    planForward();
    planAccumulation();
    planDataAovs();
}

void Planner::planGbufferPass() {
    if (!needsDeferredTargets_) {
        leaveOut("pass", "gbuffer", deferred_ ? "no opaque surface" : "forward shading");
        return;
    }
    PlannedPass pass{"gbuffer", "pass/gbuffer.frag", {}, {}, plan_.gbufferTargets, ""};
    pass.writes.insert(pass.writes.begin(), "depth");
    for (size_t i = 0; i < plan_.surfaces.size(); ++i) {
        const SurfaceFeatures& features = plan_.surfaces[i];
        if (features.blended()) continue;
        Defines defines = surfaceDefines(features);
        defines.merge(commonDefines());
        defines["GBUFFER"] = "1";
        for (size_t t = 0; t < plan_.gbufferTargets.size(); ++t) {
            defines["OUT_" + defineName(plan_.gbufferTargets[t])] = std::to_string(t);
        }
        pass.variants.push_back({features.brdf, static_cast<int>(i), defines});
    }
    pass.reason = deferred_ ? plural(static_cast<int>(scene_.instances - scene_.blendedInstances),
                                     "opaque or masked instance")
                            : "data AOVs are asked for";
    if (gbufferRadiance_)
        pass.reason += "; emission and ambient light are written here, in place of passes of their own";
    plan_.passes.push_back(pass);
}

void Planner::planCoverage() {
    if (!hasDeferredSurface_) return;
    if (gbufferRadiance_ && !contributions_) {
        leaveOut("pass", "coverage", "the G-buffer pass writes radiance and with it coverage");
        return;
    }
    plan_.passes.push_back({"coverage",
                            "pass/coverage.frag",
                            {{}},
                            {"depth"},
                            {"radiance"},
                            "lighting passes add radiance only; coverage is set once"});
}

PlannedPass Planner::lightPass(const std::string& name, const std::string& kind,
                               const std::string& reason) const {
    PlannedPass pass{
        name,  "pass/light.frag", {}, {"depth"}, {contributions_ ? "contribution." + kind : "radiance"},
        reason};
    for (const char* channel : {"linear_z", "normal", "geometric_normal", "tangent", "material"})
        if (plan_.channel(channel) != nullptr) pass.reads.emplace_back(channel);
    for (int i = 0; plan_.channel("parameters" + std::to_string(i)) != nullptr; ++i)
        pass.reads.push_back("parameters" + std::to_string(i));
    return pass;
}

Planner::Defines Planner::screenDefines(const std::string& model) const {
    Defines defines = commonDefines();
    if (requireBrdf(model).traits.usesTangent) defines["USES_TANGENT"] = "1";
    if (scene_.bandedBrdfs.contains(model)) defines["FRESNEL_BANDS"] = "1";
    return defines;
}

void Planner::planLightPass(LightType type, int count) {
    const std::string kind = nameOf(type), name = "light." + kind;
    if (count == 0) return leaveOut("pass", name, "the scene has no " + kind + " light");
    if (!deferred_) return leaveOut("pass", name, "forward shading");
    PlannedPass pass = lightPass(name, kind, plural(count, kind + " light"));
    for (const PlannedBrdf& brdf : plan_.brdfs) {
        if (!scattersLight(brdf.name)) continue;
        // Lists of clusters are drawn tile by tile, lights that reach everything over the whole picture:
        // two programs.
        Defines lights;
        lightDefines(lights, type);
        for (const auto& [key, value] : lights) {
            Defines defines = screenDefines(brdf.name);
            defines[key] = value;
            shadowDefines(defines, type);
            if (key.ends_with("_CLUSTERS")) defines["TILES"] = "1";
            pass.variants.push_back({brdf.name, -1, defines});
        }
    }
    if (pass.variants.empty()) return leaveOut("pass", name, "no opaque surface shows it");
    plan_.passes.push_back(pass);
}

void Planner::planAccumulation() {
    if (plan_.samples == 1) return leaveOut("pass", "accumulate", "one sample a pixel");
    addChannel("accumulated", "RGBA32F", "sum of jittered frames",
               "anti-aliasing by " + std::to_string(plan_.samples) + " samples");
    Defines defines;
    if (plan_.quality.radianceBits == 16) defines["RADIANCE_16F"] = "1";
    plan_.passes.push_back({"accumulate",
                            "pass/accumulate.frag",
                            {{"", -1, defines}},
                            {"radiance"},
                            {"accumulated"},
                            plural(plan_.samples, "jittered frame") + " averaged"});
}

void Planner::planDataAovs() {
    if (!dataAovs_) return leaveOut("pass", "aov", "no data AOV is asked for");
    static const std::pair<Aov, const char*> kFormats[] = {
        {Aov::depth, "R32F"},     {Aov::position, "RGBA32F"}, {Aov::normal, "RGBA32F"},
        {Aov::albedo, "RGBA32F"}, {Aov::materialId, "R32F"},  {Aov::roughness, "R32F"}};
    PlannedPass pass{
        "aov", "pass/aov.frag", {}, {"depth"}, {}, "data AOVs are asked for; taken at pixel centres"};
    Defines outputs;
    for (const auto& [aov, format] : kFormats) {
        if (!wants(aov)) continue;
        const std::string name = aovNames()[static_cast<size_t>(aov)];
        addChannel("aov." + name, format, name, "asked for as AOV");
        outputs["OUT_" + defineName(name)] = std::to_string(plan_.dataTargets.size());
        plan_.dataTargets.push_back("aov." + name);
        pass.writes.push_back("aov." + name);
    }
    for (const PlannedBrdf& brdf : plan_.brdfs) {
        Defines defines = commonDefines();
        if (brdf.name == kUnlit) defines["UNLIT"] = "1";
        if (scene_.bandedBrdfs.contains(brdf.name)) defines["FRESNEL_BANDS"] = "1";
        defines.insert(outputs.begin(), outputs.end());
        pass.variants.push_back({brdf.name, -1, defines});
    }
    plan_.passes.push_back(pass);
}

}  // namespace lobe
