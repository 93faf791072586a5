#include "area_lights.hpp"

#include <map>

#include "drawing.hpp"
#include "plan/area_forms.hpp"
#include "plan/summary.hpp"
#include "scenes.hpp"
#include "support/scenes.hpp"

namespace lobe::bench {
namespace {

constexpr int kFew = 1, kMany = 3;

struct Kind {
    LightType type;
    const char* name;
    bool image = false;
};

constexpr Kind kBodies[] = {{LightType::rect, "rect"},
                            {LightType::rect, "rect with image", true},
                            {LightType::disk, "disk"},
                            {LightType::sphere, "sphere"},
                            {LightType::tube, "tube"}};
constexpr Kind kPoint = {LightType::point, "point"};

Scene withLights(const Scene& scene, const Kind& kind, int count) {
    const LightType type = kind.type;
    Scene result = scene;
    result.lights.clear();
    if (kind.image)
        test::addImage(result, 256, 128, 3,
                       [](int x, int y, int c) { return (x * 7 + y * 13 + c * 50) % 256; });
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
        if (kind.image) light.image = static_cast<int>(result.images.size()) - 1;
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
        std::map<std::tuple<std::string, std::string, int>, std::unique_ptr<Drawing>> drawings;
        const auto prepare = [&](const Kind& kind, const Method& method) {
            for (int count : {kFew, kMany}) {
                Quality quality{.samples = 1};
                quality.areaLights = method.by;
                quality.shadows = method.shadows;
                drawings[{kind.name, method.name, count}] = std::make_unique<Drawing>(
                    context, withLights(scene, kind, count), quality, width, height);
            }
        };
        prepare(kPoint, kMethods[0]);
        for (const Kind& kind : kBodies)
            for (const Method& method : kMethods)
                prepare(kind, method);
        const auto forms = areaForms(scene);
        const auto form = forms.find(model);
        const bool closed = form != forms.end() && form->second.refusal.empty();
        for (int round = 0; round < rounds; ++round)
            for (auto& [key, drawing] : drawings)
                drawing->draw();
        const auto each = [&](const Kind& kind, const std::string& method) {
            return (drawings.at({kind.name, method, kMany})->seconds() -
                    drawings.at({kind.name, method, kFew})->seconds()) *
                   1e9 / ((kMany - kFew) * static_cast<double>(width) * height);
        };
        const double point = each(kPoint, kMethods[0].name);
        for (const Kind& kind : kBodies)
            for (const Method& method : kMethods) {
                AreaLightTime time{model, kind.name, method.name, point, each(kind, method.name), 0.0};
                // What has no closed form is sampled: the same again.
                if (std::string(method.name) == "analytic" && !closed) continue;
                time.ratio = time.body / time.point;
                results.push_back(time);
                done(time);
            }
    }
    return results;
}

}  // namespace lobe::bench
