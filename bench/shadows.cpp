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
    struct Method {
        const char* name;
        Shadows shadows;
        ShadowMethod by;
        int more;  ///< lights that make the difference: what a pass costs without any falls out
    };
    constexpr Method kMethods[] = {{"none", Shadows::none, ShadowMethod::automatic, 64},
                                   {"rays", Shadows::hard, ShadowMethod::rays, 2}};
    for (const Scene& scene : scenes)
        for (const auto& [name, type] : kTypes) {
            std::map<std::pair<std::string, int>, std::unique_ptr<Drawing>> drawings;
            for (const Method& method : kMethods)
                for (const int count : {1, 1 + method.more}) {
                    Quality quality{.samples = 1};
                    quality.shadows = method.shadows;
                    quality.shadowMethod = method.by;
                    drawings[{method.name, count}] = std::make_unique<Drawing>(
                        context, withLights(scene, type, count), quality, width, height);
                }
            for (int round = 0; round < rounds; ++round)
                for (auto& [key, drawing] : drawings)
                    drawing->draw();
            const auto each = [&](const Method& method) {
                return (drawings[{method.name, 1 + method.more}]->seconds() -
                        drawings[{method.name, 1}]->seconds()) *
                       1e9 / (method.more * static_cast<double>(width) * height);
            };
            ShadowTime time{scene.name,        name, "rays", scene.triangleCount(), each(kMethods[0]),
                            each(kMethods[1]), 0.0,  0.0};
            time.ratio = time.shadowed / time.plain;
            time.setUp = drawings[{"rays", 1}]->setUp() - drawings[{"none", 1}]->setUp();
            results.push_back(time);
            done(time);
        }
    return results;
}

}  // namespace lobe::bench
