// Shadows: for which types of light, and by which method.
#include <algorithm>

#include "base/error.hpp"
#include "plan/planner.hpp"

namespace lobe {
namespace {

/// Triangles up to which rays are taken where the choice is ours: they are exact, and cost little more than
/// maps do (docs/shadows.md, "Which").
constexpr size_t kRaysUpTo = 200000;

}  // namespace

/// Whether maps are to be looked into, as asked or as suits the scene.
bool Planner::prefersMaps() const {
    if (plan_.quality.shadowMethod != ShadowMethod::automatic)
        return plan_.quality.shadowMethod == ShadowMethod::maps;
    // Blended surfaces cast nothing into maps.
    if (scene_.blendedCasters && whyNoRays().empty()) return false;
    return scene_.castingTriangles > kRaysUpTo || !whyNoRays().empty();
}

/// Why maps were taken, where nobody asked for them.
std::string Planner::mapsReason() const {
    if (plan_.quality.shadowMethod == ShadowMethod::maps) return {};
    if (const std::string reason = whyNoRays(); !reason.empty()) return ", as rays cannot be had: " + reason;
    return ", as rays through " + std::to_string(scene_.castingTriangles) + " triangles would take longer";
}

std::string Planner::whyNoShadow(int casting) const {
    if (plan_.quality.shadows == Shadows::none) return "shadows are off";
    if (casting == 0) return "LOBE_shadow says of each of these lights that it casts none";
    if (scene_.castingTriangles == 0) return "no surface of the scene casts any";
    return {};
}

std::string Planner::whyNoRays() const {
    // A pair has one triangle at least; a tree has less than two nodes a leaf, of two texels each; surfaces
    // that are not opaque take 8 texels a pair, others 3.
    const size_t texels = scene_.castingTriangles * (scene_.maskedCasters || scene_.blendedCasters ? 8 : 4);
    const auto most = static_cast<size_t>(capabilities_.maxTextureBufferTexels);
    if (texels <= most) return {};
    return std::to_string(scene_.castingTriangles) + " triangles may take " + std::to_string(texels) +
           " texels of a buffer, and the driver's hold " + std::to_string(most);
}

void Planner::requireRays() {
    if (const std::string reason = whyNoRays(); !reason.empty())
        throw ContextError("shadows by rays: " + reason + "; expected fewer, or shadows none");
    plan_.rays = true;
}

/// `casting`: how many of the lights cast shadows.
PlannedShadow Planner::shadowMethod(LightType type, int lights, int casting) {
    if (const std::string reason = whyNoShadow(casting); !reason.empty()) {
        leaveOut("shadow", nameOf(type), reason);
        return PlannedShadow::none;
    }
    const std::string which = casting == lights ? plural(casting, "light")
                                                : std::to_string(casting) + " of " + plural(lights, "light");
    if (prefersMaps()) {
        plan_.notes.push_back(std::string("shadows of ") + nameOf(type) + " lights: maps, for " + which +
                              mapsReason());
        return PlannedShadow::maps;
    }
    requireRays();
    plan_.notes.push_back(std::string("shadows of ") + nameOf(type) +
                          " lights: rays, exact and without bias, for " + which);
    return PlannedShadow::rays;
}

void Planner::rayDefines(Defines& defines) const {
    if (scene_.maskedCasters || scene_.blendedCasters) defines["RAY_ALPHA"] = "1";
}

void Planner::noteRays() {
    if (!plan_.rays) return leaveOut("buffer", "hierarchy of triangles", "no ray is cast");
    plan_.notes.push_back(
        "hierarchy of triangles for rays: " + std::to_string(scene_.castingTriangles) +
        " triangles, built once a scene; a ray that a driver ends before its way is an error, not a "
        "picture");
    if (!scene_.maskedCasters && !scene_.blendedCasters)
        leaveOut("program part", "holes and dimming of rays", "all surfaces that cast shadows are opaque");
}

/// Points of a body have no common view from which a map could be drawn: each gets a ray, or all together a
/// guess from the map about its centre.
void Planner::planBodyShadows() {
    const bool mirrors = std::any_of(
        scene_.surfaces.begin(), scene_.surfaces.end(),
        [this](const SurfaceFeatures& f) { return showsBodies(f.brdf) && !scattersLight(f.brdf); });
    for (const auto& [type, lights] : scene_.bodyLights) {
        const bool shows = std::any_of(scene_.surfaces.begin(), scene_.surfaces.end(),
                                       [this](const SurfaceFeatures& f) { return showsBodies(f.brdf); });
        std::string reason = whyNoShadow(scene_.castingLights(type));
        if (reason.empty() && !shows) reason = "no surface shows these lights";
        plan_.shadows[type] = reason.empty() ? PlannedShadow::rays : PlannedShadow::none;
        if (!reason.empty()) {
            leaveOut("shadow", nameOf(type), reason);
            continue;
        }
        const bool distant = scene_.distantShadowLights.contains(type);
        if (const std::string none = whyNoRays(); distant && !none.empty()) {
            plan_.shadows[type] = PlannedShadow::none;
            leaveOut("shadow", nameOf(type),
                     "too far away for a cube of maps, and rays cannot be had: " + none +
                         "; a directional light (sun_size 0) has a map of its own");
            continue;
        }
        if (prefersMaps() && !mirrors && !distant) {
            plan_.shadows[type] = PlannedShadow::maps;
            plan_.notes.push_back(
                std::string("shadows of ") + nameOf(type) + " lights: maps about their centres, " +
                (plan_.quality.shadows == Shadows::hard
                     ? "as of points"
                     : "filtered as wide as what blocks them suggests: right for one depth of blockers") +
                mapsReason());
            continue;
        }
        requireRays();
        plan_.notes.push_back(std::string("shadows of ") + nameOf(type) + " lights: rays, " +
                              (!prefersMaps() ? ""
                               : mirrors      ? "as mirrors need them, "
                                              : "as a cube of maps about a light so far away would hold the "
                                                "scene in few texels, ") +
                              (plan_.quality.shadows == Shadows::hard ? "one to the centre of each"
                                                                      : "one to each point on them"));
    }
}

void Planner::planShadows() {
    const std::pair<LightType, int> types[] = {{LightType::directional, scene_.directionalLights},
                                               {LightType::point, scene_.pointLights},
                                               {LightType::spot, scene_.spotLights}};
    for (const auto& [type, lights] : types)
        if (lights > 0) plan_.shadows[type] = shadowMethod(type, lights, scene_.castingLights(type));
    planBodyShadows();
    planEnvironmentShadow();
    noteRays();
}

}  // namespace lobe
