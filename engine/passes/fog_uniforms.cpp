#include "passes/fog_uniforms.hpp"

#include <algorithm>
#include <cmath>

#include "math/quadrature.hpp"

namespace lobe {
namespace {

/// Of no extinction at all; finite, so that it may be added to.
constexpr double kNoDensity = -1e30;

/// Light whose way is longer than the straight one by so many mean free paths is below 4e-8 of what arrives.
constexpr double kMostPaths = 17.0;
constexpr double kLongestCut = 1e15;

}  // namespace

void setFog(const gl::Program& program, const Scene& scene, const View& view) {
    const Fog& fog = *scene.fog;
    program.set("uFogRadiance", glm::vec3(fog.radiance));
    if (fog.heightFalloff == 0.0) {
        program.set("uFogExtinction", glm::vec3(fog.extinction));
        return;
    }
    const double atEye = -fog.heightFalloff * (view.eye.y - fog.height);
    glm::dvec3 logDensity(kNoDensity);
    for (int c = 0; c < 3; ++c)
        if (fog.extinction[c] > 0.0)
            logDensity[c] = std::clamp(std::log(fog.extinction[c]) + atEye, kNoDensity, -kNoDensity);
    program.set("uFogLogDensity", glm::vec3(logDensity));
    program.set("uFogFalloff", static_cast<float>(fog.heightFalloff));
}

void setAirlight(const gl::Program& program, const Scene& scene, const FramePlan& plan,
                 const LightBuffers& lights) {
    const Fog& fog = *scene.fog;
    glm::dvec3 extinction(0.0);
    double least = HUGE_VAL;
    for (int c = 0; c < 3; ++c)
        if (fog.scattering[c] > 0.0) {
            extinction[c] = fog.extinction[c];
            least = std::min(least, fog.extinction[c]);
        }
    program.set("uAirlightExtinction", glm::vec3(extinction));
    program.set("uAirlightScattering", glm::vec3(fog.scattering));
    program.set("uAirlightAnisotropy", static_cast<float>(fog.anisotropy));
    program.set("uAirlightCut", static_cast<float>(std::min(kMostPaths / least, kLongestCut)));
    const QuadratureRule rule = gaussLegendre(plan.airlightNodes);
    for (size_t i = 0; i < rule.nodes.size(); ++i)
        program.set("uAirlightNodes[" + std::to_string(i) + "]",
                    glm::vec2(0.5 * (1.0 + rule.nodes[i]), 0.5 * rule.weights[i]));
    program.set("uAirlightPointFirst", 0);
    program.set("uAirlightPointEnd", lights.count(LightType::point));
    program.set("uAirlightSpotFirst", 0);
    program.set("uAirlightSpotEnd", lights.count(LightType::spot));
}

}  // namespace lobe
