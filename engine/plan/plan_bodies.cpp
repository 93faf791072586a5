// Lights with a body: by which method each model shows them, and their passes.
#include <algorithm>

#include "base/error.hpp"
#include "plan/planner.hpp"

namespace lobe {
namespace {

constexpr LightType kBodies[] = {LightType::rect, LightType::disk, LightType::sphere, LightType::tube};

/// "RECT", as defines begin.
const char* defineOf(LightType type) {
    static const std::map<LightType, const char*> names{{LightType::rect, "RECT"},
                                                        {LightType::disk, "DISK"},
                                                        {LightType::sphere, "SPHERE"},
                                                        {LightType::tube, "TUBE"}};
    return names.at(type);
}

std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts)
        text += (text.empty() ? "" : ", ") + part;
    return text;
}

}  // namespace

const char* nameOf(LightType type) {
    static constexpr const char* kNames[] = {"directional", "point",  "spot", "rect",
                                             "disk",        "sphere", "tube"};
    return kNames[static_cast<size_t>(type)];
}

bool hasClosedForm(const SceneSummary& scene, const std::string& model) {
    const auto form = scene.areaForms.find(model);
    return form != scene.areaForms.end() && form->second.refusal.empty();
}

int Planner::bodyCount(LightType type) const {
    const auto found = scene_.bodyLights.find(type);
    return found == scene_.bodyLights.end() ? 0 : found->second;
}

bool Planner::showsBodies(const std::string& model) const {
    return model != kUnlit && (scattersLight(model) || requireBrdf(model).mirror);
}

PlannedArea Planner::areaMethod(const std::string& model) const {
    if (!scattersLight(model)) return {AreaMethod::mirrored, "where the mirrored ray meets them"};
    if (plan_.quality.areaLights == AreaLights::sampled)
        return {AreaMethod::sampled, "by points on each, as area_lights asks"};
    const auto found = scene_.areaForms.find(model);
    if (found == scene_.areaForms.end()) return {AreaMethod::sampled, "by points on each: it has no fit"};
    const AreaForm& form = found->second;
    if (!form.refusal.empty()) return {AreaMethod::sampled, "by points on each: " + form.refusal};
    if (form.terms == 0) return {AreaMethod::analytic, "in closed form", form};
    const std::string lobes = plural(static_cast<int>(fit::kLobes) * form.terms, "fitted lobe");
    return {AreaMethod::analytic,
            "by " + lobes +
                (form.request.widthVaries ? ", over angle and " + form.request.brdf->area->width
                                          : ", over the angle of view"),
            form};
}

void Planner::planLightImages() {
    const bool shown = std::any_of(scene_.surfaces.begin(), scene_.surfaces.end(),
                                   [&](const SurfaceFeatures& surface) { return showsBodies(surface.brdf); });
    if (scene_.lightImages.empty() || !shown)
        return leaveOut(
            "texture", "images on lights",
            scene_.lightImages.empty() ? "no light shows an image" : "no surface shows light of a body");
    plan_.lightImages = true;
    const bool prefiltered =
        std::any_of(plan_.areaMethods.begin(), plan_.areaMethods.end(),
                    [](const auto& entry) { return entry.second.method != AreaMethod::mirrored; });
    plan_.notes.push_back(
        "images on lights: " + plural(static_cast<int>(scene_.lightImages.size()), "rect") + " (" +
        joined(scene_.lightImages) + "), in one texture" +
        (prefiltered ? "; surfaces show them blurred by what they reflect, from means over its parts, "
                       "points on lights by what each point stands for"
                     : ", looked up where mirrored rays meet them"));
}

void Planner::planBodyLights() {
    if (scene_.bodyLights.empty()) return;
    std::vector<std::string> models;
    for (const SurfaceFeatures& surface : scene_.surfaces)
        if (showsBodies(surface.brdf) && !plan_.areaMethods.contains(surface.brdf)) {
            const PlannedArea area = areaMethod(surface.brdf);
            plan_.areaMethods[surface.brdf] = area;
            models.push_back(surface.brdf + " " + area.reason);
        }
    int all = 0;
    bool soft = false;
    for (const auto& [type, count] : scene_.bodyLights) {
        all += count;
        const bool shadowed = plan_.shadowOf(type) == PlannedShadow::rays;
        soft |= shadowed && plan_.quality.shadows == Shadows::soft;
        plan_.lightGroups.push_back(std::string(nameOf(type)) + ": " + plural(count, "light") +
                                    ", one loop over all" + (models.empty() ? "" : "; " + joined(models)));
        requireFit(nameOf(type), count, type == LightType::rect && !scene_.lightImages.empty() ? 5 : 4);
    }
    planLightImages();
    const bool sampled =
        std::any_of(plan_.areaMethods.begin(), plan_.areaMethods.end(),
                    [](const auto& entry) { return entry.second.method == AreaMethod::sampled; });
    const bool scattered =
        std::any_of(plan_.areaMethods.begin(), plan_.areaMethods.end(),
                    [](const auto& entry) { return entry.second.method != AreaMethod::mirrored; });
    if (!sampled && !(soft && scattered)) {
        leaveOut("program part", "points on lights",
                 !scattered ? "no surface scatters light of a body"
                            : "closed forms need none, and no shadow is soft");
        return;
    }
    plan_.areaPoints = plan_.quality.lightSamples;
    plan_.areaPointsForward = plan_.areaPoints;
    plan_.notes.push_back("lights with a body: " + plural(plan_.areaPoints, "point") + " on each" +
                          (soft ? ", each with a ray for its shadow" : "") +
                          (plan_.samples > 1 ? "; other points in each jittered frame" : ""));
    if (!scene_.blended && deferred_) return;
    // One draw has to do with them all.
    const int most = std::max(1, (soft ? kRaysPerForwardDraw : kPointsPerDraw) / all);
    if (plan_.areaPoints <= most) return;
    plan_.areaPointsForward = most;
    plan_.notes.push_back("forward surfaces: " + plural(most, "point") + " on each light of " +
                          std::to_string(plan_.areaPoints) +
                          ", as their draw cannot be split and drivers end long loops");
}

Planner::Defines Planner::bodyDefines(const std::string& model, LightType type) const {
    Defines defines;
    const PlannedArea& area = plan_.areaMethods.at(model);
    const bool shadowed = plan_.shadowOf(type) != PlannedShadow::none;
    const bool mirrored = area.method == AreaMethod::mirrored;
    const bool hard = plan_.quality.shadows == Shadows::hard;
    for (const auto& [kind, count] : scene_.bodyLights)
        if (kind == type || mirrored) defines[std::string(defineOf(kind)) + "_LIGHTS"] = "1";
    if (plan_.lightImages && defines.contains("RECT_LIGHTS")) defines["RECT_IMAGES"] = "1";
    const bool maps = plan_.shadowOf(type) == PlannedShadow::maps;
    if (maps) {
        defines["SHADOWS"] = "1";
        defines["AREA_MAP_SHADOWS"] = "1";
        if (hard) defines["AREA_POINT_SHADOWS"] = "1";
        shadowMapDefines(defines, type);
    } else if (shadowed) {
        defines["SHADOWS"] = "1";
        defines[mirrored || !hard ? "AREA_SHADOWS" : "AREA_HARD_SHADOWS"] = "1";
        rayDefines(defines);
    }
    if (mirrored) {
        defines["MIRRORED_LIGHTS"] = "1";
        defines["MIRRORED_TYPE"] = std::to_string(static_cast<int>(type) - static_cast<int>(LightType::rect));
        return defines;
    }
    if (area.method == AreaMethod::analytic) {
        defines["AREA_ANALYTIC"] = "1";
        const AreaForm& form = area.form;
        defines["LOBE_COUNT"] = std::to_string(static_cast<int>(fit::kLobes) * form.terms);
        if (form.terms > 0) {
            defines["LOBE_FIRST"] = std::to_string(form.firstRow);
            if (form.request.brdf->area->powerTail) defines["LOBE_COSINES"] = "1";
            if (form.request.widthVaries) defines["LOBE_WIDTHS"] = "1";
            // Colours that do not vary are in the table.
            defines["LOBE_WEIGHTS(w)"] =
                form.request.colorsVary ? "w.first, w.second" : "vec3(1.0), vec3(1.0)";
        }
    }
    if (area.method == AreaMethod::sampled || (shadowed && !maps && !hard)) defines["AREA_SAMPLED"] = "1";
    return defines;
}

Planner::Defines Planner::forwardBodyDefines(const std::string& model) const {
    Defines defines;
    if (!plan_.areaMethods.contains(model)) return defines;
    for (const auto& [type, count] : scene_.bodyLights)
        defines.merge(bodyDefines(model, type));
    if (defines.contains("MIRRORED_TYPE")) defines["MIRRORED_TYPE"] = "-1";
    return defines;
}

void Planner::planBodyPasses() {
    for (LightType type : kBodies)
        planBodyPass(type);
}

void Planner::planBodyPass(LightType type) {
    const std::string kind = nameOf(type), name = "light." + kind;
    const int count = bodyCount(type);
    if (count == 0) return leaveOut("pass", name, "the scene has no " + kind + " light");
    if (!deferred_) return leaveOut("pass", name, "forward shading");
    PlannedPass pass = lightPass(name, kind, plural(count, kind + " light"));
    for (const PlannedBrdf& brdf : plan_.brdfs) {
        if (!showsBodies(brdf.name)) continue;
        Defines defines = screenDefines(brdf.name);
        defines.merge(bodyDefines(brdf.name, type));
        if (defines.contains("AREA_SHADOWS") && defines.contains("AREA_ANALYTIC") &&
            plan_.areaPoints > kRaysPerDraw)
            defines["AREA_SPLIT"] = "1";
        pass.variants.push_back({brdf.name, -1, defines});
    }
    if (pass.variants.empty()) return leaveOut("pass", name, "no opaque surface shows it");
    plan_.passes.push_back(pass);
}

}  // namespace lobe
