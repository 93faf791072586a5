#include "area_lights.hpp"

#include <map>

#include "drawing.hpp"
#include "plan/summary.hpp"
#include "scenes.hpp"

namespace lobe::bench {
namespace {

constexpr int kFew = 1, kMany = 3;

Scene withLights(const Scene& scene, LightType type, int count) {
    Scene result = scene;
    result.lights.clear();
    const Bounds bounds = scene.bounds();
    const glm::dvec3 half = (bounds.upper - bounds.lower) * 0.5;
    const double size = 0.2 * half.x;
    for (int i = 0; i < count; ++i) {
        Light light;
        light.type = type;
        light.position = bounds.center() + half * glm::dvec3(0.3 - 0.2 * i, 0.0, 0.35 - 0.1 * i) +
                         glm::dvec3(0.0, std::max(0.8 * half.y, 0.25 * half.x), 0.0);
        light.direction = {0.0, -1.0, 0.0};
        light.axis = {1.0, 0.0, 0.0};
        light.width = 2.0 * size;
        light.height = light.length = size;
        light.radius = type == LightType::tube ? 0.1 * size : 0.5 * size;
        light.intensity = glm::dvec3(1.0);
        result.lights.push_back(light);
    }
    return result;
}

struct Method {
    const char* name;
    AreaLights by;
    Shadows shadows;
};

constexpr Method kMethods[] = {{"analytic", AreaLights::analytic, Shadows::none},
                               {"sampled 16", AreaLights::sampled, Shadows::none},
                               {"shadowed 16", AreaLights::analytic, Shadows::soft}};

}  // namespace

std::vector<AreaLightTime> areaLightTimes(gl::Context& context, int width, int height, int rounds,
                                          const std::function<void(const AreaLightTime&)>& done) {
    std::vector<AreaLightTime> results;
    for (const char* model : {"lambert", "ggx", "phong"}) {
        const Scene scene = withBrdf(balls(8), requireBrdf(model));
        std::map<std::tuple<LightType, std::string, int>, std::unique_ptr<Drawing>> drawings;
        for (LightType type :
             {LightType::point, LightType::rect, LightType::disk, LightType::sphere, LightType::tube})
            for (const Method& method : kMethods)
                for (int count : {kFew, kMany}) {
                    Quality quality{.samples = 1};
                    quality.areaLights = method.by;
                    quality.shadows = method.shadows;
                    if (type == LightType::point && method.shadows != Shadows::none) continue;
                    drawings[{type, method.name, count}] = std::make_unique<Drawing>(
                        context, withLights(scene, type, count), quality, width, height);
                }
        for (int round = 0; round < rounds; ++round)
            for (auto& [key, drawing] : drawings)
                drawing->draw();
        const auto each = [&](LightType type, const std::string& method) {
            return (drawings.at({type, method, kMany})->seconds() -
                    drawings.at({type, method, kFew})->seconds()) *
                   1e9 / ((kMany - kFew) * static_cast<double>(width) * height);
        };
        const double point = each(LightType::point, "analytic");
        for (LightType type : {LightType::rect, LightType::disk, LightType::sphere, LightType::tube})
            for (const Method& method : kMethods) {
                AreaLightTime time{model, nameOf(type), method.name, point, each(type, method.name), 0.0};
                // What has no closed form is sampled: the same again.
                if (std::string(method.name) == "analytic" && std::string(model) != "lambert") continue;
                time.ratio = time.body / time.point;
                results.push_back(time);
                done(time);
            }
    }
    return results;
}

}  // namespace lobe::bench
