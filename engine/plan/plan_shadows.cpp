// Shadows: for which types of light, and by which method.
#include <algorithm>

#include "plan/planner.hpp"

namespace lobe {

/// `casting`: how many of the lights cast shadows.
PlannedShadow Planner::shadowMethod(LightType, int, int) {
    return PlannedShadow::none;
}

/// Points of a body have no common view from which a map could be drawn: each gets a ray.
void Planner::planBodyShadows() {
    for (const auto& [type, lights] : scene_.bodyLights) {
        const bool shows = std::any_of(scene_.surfaces.begin(), scene_.surfaces.end(),
                                       [this](const SurfaceFeatures& f) { return showsBodies(f.brdf); });
        const int casting = scene_.castingLights(type);
        const std::string name = std::string("shadows of ") + nameOf(type) + " lights";
        plan_.shadows[type] = PlannedShadow::none;
        if (plan_.quality.shadows == Shadows::none)
            leaveOut("program part", name, "shadows are off");
        else if (casting == 0 || scene_.castingTriangles == 0)
            leaveOut("program part", name, casting == 0 ? "none casts any" : "no surface casts any");
        else if (!shows)
            leaveOut("program part", name, "no surface shows these lights");
        else
            plan_.shadows[type] = PlannedShadow::rays;
    }
}

void Planner::planShadows() {
    const std::pair<LightType, int> types[] = {{LightType::directional, scene_.directionalLights},
                                               {LightType::point, scene_.pointLights},
                                               {LightType::spot, scene_.spotLights}};
    for (const auto& [type, lights] : types)
        if (lights > 0) plan_.shadows[type] = shadowMethod(type, lights, scene_.castingLights(type));
    planBodyShadows();
}

}  // namespace lobe
