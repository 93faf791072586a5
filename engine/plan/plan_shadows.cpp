// Shadows: for which types of light, and by which method.
#include "plan/planner.hpp"

namespace lobe {

/// `casting`: how many of the lights cast shadows.
PlannedShadow Planner::shadowMethod(LightType, int, int casting) {
    const bool sought = plan_.quality.shadows != Shadows::none && casting > 0 && scene_.castingTriangles > 0;
    return sought && plan_.quality.shadowMethod == ShadowMethod::maps ? PlannedShadow::maps
                                                                      : PlannedShadow::none;
}

void Planner::planShadows() {
    const std::pair<LightType, int> types[] = {{LightType::directional, scene_.directionalLights},
                                               {LightType::point, scene_.pointLights},
                                               {LightType::spot, scene_.spotLights}};
    for (const auto& [type, lights] : types)
        if (lights > 0) plan_.shadows[type] = shadowMethod(type, lights, scene_.castingLights(type));
}

}  // namespace lobe
