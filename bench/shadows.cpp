#include "shadows.hpp"

#include <algorithm>
#include <map>
#include <memory>

#include "drawing.hpp"
#include "scenes.hpp"

namespace lobe::bench {
namespace {

constexpr std::pair<const char*, LightType> kTypes[] = {
    {"directional", LightType::directional}, {"point", LightType::point}, {"spot", LightType::spot}};

/// The scene's lights replaced by `count` of one type.
Scene withLights(const Scene& scene, LightType type, int count) {
    Scene result = scene;
    result.lights.clear();
    const Bounds bounds = scene.bounds();
    const glm::dvec3 half = (bounds.upper - bounds.lower) * 0.5;
    for (int i = 0; i < count; ++i) {
        Light light;
        light.type = type;
        light.position = bounds.center() + half * glm::dvec3(0.3 - 0.2 * i, 0.0, 0.35 - 0.1 * i) +
                         glm::dvec3(0.0, std::max(0.8 * half.y, 0.25 * half.x), 0.0);
        light.direction = glm::normalize(glm::dvec3(-0.3 + 0.2 * i, -0.8, -0.35 + 0.1 * i));
        light.intensity = glm::dvec3(type == LightType::directional ? 1.0 : glm::dot(half, half));
        light.innerConeAngle = 1.0;
        light.outerConeAngle = 1.2;
        result.lights.push_back(light);
    }
    return result;
}

}  // namespace

std::vector<ShadowTime> shadowTimes(gl::Context& context, const std::vector<Scene>& extra, int width,
                                    int height, int rounds,
                                    const std::function<void(const ShadowTime&)>& done) {
    std::vector<Scene> scenes = {balls(8), balls(53)};
    scenes.insert(scenes.end(), extra.begin(), extra.end());
    std::vector<ShadowTime> results;
    // One light more makes the difference: what a pass costs without any falls out.
    constexpr int kFew = 1, kMany = 3;
    for (const Scene& scene : scenes)
        for (const auto& [name, type] : kTypes) {
            std::map<std::pair<std::string, int>, std::unique_ptr<Drawing>> drawings;
            for (const auto& [method, shadows, by] :
                 {std::tuple("none", Shadows::none, ShadowMethod::automatic),
                  std::tuple("rays", Shadows::hard, ShadowMethod::rays)})
                for (const int count : {kFew, kMany}) {
                    Quality quality{.samples = 1};
                    quality.shadows = shadows;
                    quality.shadowMethod = by;
                    drawings[{method, count}] = std::make_unique<Drawing>(
                        context, withLights(scene, type, count), quality, width, height);
                }
            for (int round = 0; round < rounds; ++round)
                for (auto& [key, drawing] : drawings)
                    drawing->draw();
            const auto each = [&](const std::string& method) {
                return (drawings[{method, kMany}]->seconds() - drawings[{method, kFew}]->seconds()) * 1e9 /
                       ((kMany - kFew) * static_cast<double>(width) * height);
            };
            ShadowTime time{scene.name,   name,         "rays", scene.triangleCount(),
                            each("none"), each("rays"), 0.0,    0.0};
            time.ratio = time.shadowed / time.plain;
            time.setUp = drawings[{"rays", kFew}]->setUp() - drawings[{"none", kFew}]->setUp();
            results.push_back(time);
            done(time);
        }
    return results;
}

}  // namespace lobe::bench
