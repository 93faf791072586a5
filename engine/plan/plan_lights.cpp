// Lights: which are listed by cluster, and whether all fit.
#include <cmath>
#include <sstream>

#include "base/error.hpp"
#include "plan/planner.hpp"

namespace lobe {

void Planner::requireFit(const char* type, int count, int texelsEach) const {
    const int most = capabilities_.maxTextureBufferTexels / texelsEach;
    if (count > most)
        throw ContextError("the scene has " + plural(count, std::string(type) + " light") +
                           "; expected at most " + std::to_string(most) + ", what the driver's buffers hold");
}

void Planner::requireForwardLoop(const char* type, int global) const {
    constexpr int kMost = 65000;
    if (global > kMost && (scene_.blended || !deferred_))
        throw InputError("the scene has " + plural(global, std::string(type) + " light") +
                         " without range over blended surfaces; expected at most " + std::to_string(kMost));
}

/// With f_r cos(theta) <= P, a light of intensity I adds at most I P / d^2 at distance d. Each may take its
/// share w / W of the threshold T, w = I^(3/5): it is left out from d = sqrt(I P W / (w T)) on, and what all
/// lights take together stays below T.
void Planner::planReach() {
    const int threshold = plan_.quality.lightThreshold;
    if (threshold == 0 || scene_.pointLights + scene_.spotLights == 0) return;
    const std::string none = "light_threshold: no light is left out, since ";
    if (plan_.quality.clusterFrom == 0) return plan_.notes.push_back(none + "clusters are off");
    if (!scene_.unbounded.empty())
        return plan_.notes.push_back(none + "what " + scene_.unbounded + " reflects has no bound");
    const double most = threshold / 1000.0;
    plan_.lightReach = std::sqrt(scene_.peak * scene_.reachWeight / most);
    std::ostringstream note;
    note << "light_threshold: lights are left out where they show less than their share; all that is left "
            "out of a "
            "pixel adds up to at most "
         << most << ", as no surface reflects more than " << scene_.peak
         << " /sr of a direction: a light of 1 W/sr reaches " << plan_.lightReach << " m";
    plan_.notes.push_back(note.str());
}

void Planner::planLights() {
    planEnvironment();
    planReach();
    const bool reach = plan_.lightReach > 0.0;
    const int from = plan_.quality.clusterFrom;
    const auto clustered = [&](const char* type, int count, int ranged, int& global) {
        if (count == 0) return false;
        const bool use = from > 0 && ranged >= from && count >= from;
        global = use ? count - ranged : count;
        std::string line =
            std::string(type) + ": " + plural(count, "light") +
            (use ? ", " + std::to_string(ranged) + " of them in clusters of 64 x 64 px and 24 slices of depth"
                 : ", one loop over all");
        if (!use)
            line += from == 0       ? " (clusters are off)"
                    : ranged < from ? " (fewer than " + std::to_string(from) + " with a range)"
                                    : "";
        plan_.lightGroups.push_back(line);
        return use;
    };
    if (scene_.directionalLights > 0)
        plan_.lightGroups.push_back("directional: " + plural(scene_.directionalLights, "light") +
                                    ", one loop over all");
    plan_.clusteredPoint =
        clustered("point", scene_.pointLights, reach ? scene_.pointLights : scene_.rangedPointLights,
                  plan_.globalPointLights);
    plan_.clusteredSpot =
        clustered("spot", scene_.spotLights, reach ? scene_.spotLights : scene_.rangedSpotLights,
                  plan_.globalSpotLights);
    requireFit("directional", scene_.directionalLights, 2);
    requireFit("point", scene_.pointLights, 2);
    requireFit("spot", scene_.spotLights, plan_.shadowOf(LightType::spot) == PlannedShadow::none ? 3 : 4);
    requireForwardLoop("directional", scene_.directionalLights);
    requireForwardLoop("point", plan_.globalPointLights);
    requireForwardLoop("spot", plan_.globalSpotLights);
    planBodyLights();
    if (!plan_.clusteredPoint && !plan_.clusteredSpot)
        leaveOut("buffer", "light clusters", "no light type has enough ranged lights for lists to pay");
}

}  // namespace lobe
