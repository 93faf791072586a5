// The environment: by which method each model shows it, its pass, and how it is seen behind surfaces.
#include <algorithm>

#include "base/error.hpp"
#include "plan/planner.hpp"

namespace lobe {
namespace {

const char* nameOf(EnvironmentDiffuse diffuse) {
    switch (diffuse) {
        case EnvironmentDiffuse::sh2:
            return "9 coefficients of spherical harmonics";
        case EnvironmentDiffuse::sh4:
            return "25 coefficients of spherical harmonics";
        case EnvironmentDiffuse::map:
            break;
    }
    return "a map of irradiance";
}

}  // namespace

bool Planner::showsEnvironment(const std::string& model) const {
    return scene_.environment && showsBodies(model);
}

PlannedEnvironment Planner::environmentMethod(const std::string& model) const {
    if (!scattersLight(model)) return {EnvironmentMethod::mirrored, "where the mirrored ray points"};
    if (plan_.quality.envLighting == EnvironmentLighting::sampled)
        return {EnvironmentMethod::sampled, "by directions to it, as env_lighting asks"};
    const auto found = scene_.areaForms.find(model);
    if (found == scene_.areaForms.end() || !found->second.refusal.empty())
        return {EnvironmentMethod::sampled,
                "by directions to it: " +
                    (found == scene_.areaForms.end() ? "its lobe is not split" : found->second.refusal)};
    const AreaForm& form = found->second;
    const std::string diffuse = nameOf(plan_.quality.envDiffuse);
    if (form.request.brdf->area->terms == 0) return {EnvironmentMethod::prefiltered, "by " + diffuse, form};
    const std::string range =
        form.request.widthVaries ? ", for each " + form.request.brdf->area->width + " that is in use" : "";
    return {EnvironmentMethod::prefiltered,
            "by the map blurred by its lobe" + range + ", and " + diffuse + " for Lambert's part", form};
}

/// Rays alone see where the environment is blocked.
void Planner::planEnvironmentShadow() {
    if (!scene_.environment) return;
    bool sought = false;
    for (const SurfaceFeatures& surface : scene_.surfaces) {
        if (!showsEnvironment(surface.brdf)) continue;
        const PlannedEnvironment& how =
            plan_.environmentMethods.try_emplace(surface.brdf, environmentMethod(surface.brdf)).first->second;
        sought |= how.method != EnvironmentMethod::prefiltered ||
                  static_cast<bool>(requireBrdf(surface.brdf).mirror);
    }
    std::string reason = whyNoShadowOfEnvironment();
    if (reason.empty() && !sought)
        reason = plan_.environmentMethods.empty()
                     ? "no surface shows it"
                     : "the map is integrated beforehand, as if nothing blocked it";
    if (reason.empty() && prefersMaps()) reason = "shadow maps have no view of it" + mapsReason();
    if (!reason.empty()) return leaveOut("shadow", "environment", reason);
    requireRays();
    plan_.environmentShadow = PlannedShadow::rays;
    plan_.notes.push_back(
        "shadows of the environment: rays, one in each direction that is drawn or mirrored");
}

void Planner::planEnvironment() {
    if (!scene_.environment) return;
    std::string models;
    bool sampled = false, looked = scene_.environmentSeen && !scene_.environmentOtherSeen;
    for (const auto& [model, how] : plan_.environmentMethods) {
        models += "; " + model + " " + how.reason;
        sampled |= how.method == EnvironmentMethod::sampled;
        looked |= how.method != EnvironmentMethod::prefiltered || requireBrdf(model).mirror;
    }
    const std::string size = std::to_string(scene_.environmentWidth) + " x " +
                             std::to_string(scene_.environmentHeight) + " texels";
    plan_.lightGroups.push_back(
        "environment: " + (scene_.environmentPicture ? size : std::string("constant")) + models);
    for (const std::string& note : scene_.environmentNotes)
        plan_.notes.push_back("environment: " + note);
    const int most = capabilities_.maxTextureSize;
    if (looked && (scene_.environmentWidth > most || scene_.environmentHeight + 2 > most))
        throw ContextError("the environment has " + size + "; expected at most " + std::to_string(most) +
                           " x " + std::to_string(most - 2) + ", what the driver's textures hold");
    plan_.environmentMap = looked;
    if (!looked)
        leaveOut("texture", "environment",
                 "only what is made of it is looked up: nothing mirrors it, draws from it or shows it behind "
                 "surfaces");
    if (!sampled) {
        leaveOut("program part", "directions to the environment",
                 plan_.environmentMethods.empty() ? "no surface shows it" : "no model samples it");
        return;
    }
    plan_.environmentSamples = plan_.environmentSamplesForward = plan_.quality.envSamples;
    plan_.notes.push_back(
        "environment: " + plural(plan_.environmentSamples, "direction") +
        ", half drawn by its brightness, half by the lobe, weighed by the balance heuristic" +
        (plan_.samples > 1 ? "; others in each jittered frame" : ""));
    if (!scene_.blended && deferred_) return;
    const int each = plan_.environmentShadow == PlannedShadow::rays ? kRaysPerForwardDraw : kPointsPerDraw;
    if (plan_.environmentSamples <= each) return;
    plan_.environmentSamplesForward = each;
    plan_.notes.push_back("forward surfaces: " + plural(each, "direction") + " of " +
                          std::to_string(plan_.environmentSamples) +
                          ", as their draw cannot be split and drivers end long loops");
}

Planner::Defines Planner::environmentDefines(const std::string& model) const {
    Defines defines;
    const auto found = plan_.environmentMethods.find(model);
    if (found == plan_.environmentMethods.end()) return defines;
    const PlannedEnvironment& how = found->second;
    const Brdf& brdf = requireBrdf(model);
    defines["ENVIRONMENT_LIGHT"] = "1";
    if (brdf.mirror) defines["ENVIRONMENT_MIRROR"] = "1";
    if (how.method == EnvironmentMethod::sampled) defines["ENVIRONMENT_SAMPLED"] = "1";
    if (plan_.environmentShadow == PlannedShadow::rays &&
        (brdf.mirror || how.method == EnvironmentMethod::sampled)) {
        defines["SHADOWS"] = "1";
        defines["ENVIRONMENT_SHADOWS"] = "1";
        rayDefines(defines);
    }
    if (how.method != EnvironmentMethod::prefiltered) return defines;
    defines["ENVIRONMENT_PREFILTERED"] = "1";
    defines["ENVIRONMENT_TERMS"] = std::to_string(how.form.request.brdf->area->terms);
    if (how.form.request.widthVaries) defines["ENVIRONMENT_WIDTHS"] = "1";
    if (plan_.quality.envDiffuse != EnvironmentDiffuse::map)
        defines["ENVIRONMENT_SH"] = plan_.quality.envDiffuse == EnvironmentDiffuse::sh2 ? "2" : "4";
    return defines;
}

void Planner::planEnvironmentPass() {
    const std::string name = "light.environment";
    if (!scene_.environment) return leaveOut("pass", name, "the scene has no environment");
    if (!deferred_) return leaveOut("pass", name, "forward shading");
    PlannedPass pass = lightPass(name, "environment", "light from all sides, from infinity");
    for (const PlannedBrdf& brdf : plan_.brdfs) {
        if (!showsEnvironment(brdf.name)) continue;
        Defines defines = screenDefines(brdf.name);
        defines.merge(environmentDefines(brdf.name));
        if (const auto area = plan_.areaMethods.find(brdf.name);
            area != plan_.areaMethods.end() && area->second.method == AreaMethod::mirrored) {
            // What a body hides of the environment is not to be seen beside it.
            for (const auto& [type, count] : scene_.bodyLights)
                defines[defineName(nameOf(type)) + "_LIGHTS"] = "1";
            defines["MIRRORED_LIGHTS"] = "1";
            defines["MIRRORED_TYPE"] = "-1";
            defines["ENVIRONMENT_ALONE"] = "1";
            if (plan_.lightImages && defines.contains("RECT_LIGHTS")) defines["RECT_IMAGES"] = "1";
        }
        if (isPrefiltered(brdf.name)) {
            if (plan_.channel("occlusion") != nullptr) defines["OCCLUSION_TEXTURES"] = "1";
            if (plan_.occlusionSlices > 0) defines["AMBIENT_OCCLUSION"] = "1";
        }
        pass.variants.push_back({brdf.name, -1, defines});
    }
    if (pass.variants.empty()) return leaveOut("pass", name, "no opaque surface shows it");
    for (const char* channel : {"occlusion", "ambient_occlusion"})
        if (plan_.channel(channel) != nullptr) pass.reads.emplace_back(channel);
    plan_.passes.push_back(pass);
}

void Planner::planBackground() {
    if (!scene_.environment) return leaveOut("pass", "background", "the scene has no environment");
    if (!scene_.environmentSeen) return leaveOut("pass", "background", "the environment is not to be seen");
    // Of forward surfaces, only those that are blended leave what was there before.
    const char* target = !contributions_ ? "radiance"
                         : deferred_     ? "contribution.environment"
                                         : "contribution.transparent";
    PlannedPass pass{"background",
                     "pass/background.frag",
                     {{}},
                     {},
                     {target},
                     scene_.environmentOtherSeen
                         ? "the environment is seen behind surfaces, as a picture of its own"
                         : "the environment is seen behind surfaces"};
    if (contributions_) pass.writes.emplace_back("radiance");  // coverage only
    if (hasDeferredSurface_) pass.reads.emplace_back("depth");
    plan_.passes.push_back(pass);
}

}  // namespace lobe
