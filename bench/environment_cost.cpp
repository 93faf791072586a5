#include "environment_cost.hpp"

#include <memory>

#include "passes/renderer.hpp"
#include "plan/summary.hpp"
#include "scene/made_environment.hpp"
#include "scenes.hpp"
#include "support/scenes.hpp"

namespace lobe::bench {
namespace {

constexpr int kWidth = 640, kHeight = 360;

struct Method {
    std::string name;
    EnvironmentLighting by;
    EnvironmentDiffuse diffuse;
    int samples;
};

}  // namespace

std::vector<EnvironmentCost> environmentCosts(gl::Context& context, const Bitmap& panorama, int rounds,
                                              const std::function<void(const EnvironmentCost&)>& done) {
    const Method methods[] = {
        {"prefiltered, map", EnvironmentLighting::prefiltered, EnvironmentDiffuse::map, 32},
        {"prefiltered, sh2", EnvironmentLighting::prefiltered, EnvironmentDiffuse::sh2, 32},
        {"16 directions", EnvironmentLighting::sampled, EnvironmentDiffuse::map, 16},
        {"64 directions", EnvironmentLighting::sampled, EnvironmentDiffuse::map, 64}};
    struct Entry {
        EnvironmentCost cost;
        std::unique_ptr<Renderer> renderer;
    };
    Scene scene = balls(8);
    scene.lights.push_back(test::point({1.0, 4.0, 2.0}, glm::dvec3(20.0)));
    scene.environment = Environment{};
    scene.environment->image = addPicture(scene, panorama, "panorama");
    scene.environment->background = false;
    const Camera camera = scene.cameras[0];
    std::vector<Entry> entries;
    for (const char* model : {"lambert", "metallic_roughness", "phong", "ward", "ggx"})
        for (const Method& method : methods) {
            RenderOptions options;
            options.width = kWidth;
            options.height = kHeight;
            options.quality.samples = 1;
            options.quality.shadows = Shadows::none;
            options.quality.envLighting = method.by;
            options.quality.envDiffuse = method.diffuse;
            options.quality.envSamples = method.samples;
            options.timePasses = true;
            entries.push_back({{model, method.name, 1e9, 1e9}, std::make_unique<Renderer>(context)});
            entries.back().renderer->setScene(std::make_shared<Scene>(withBrdf(scene, requireBrdf(model))),
                                              options);
            entries.back().renderer->render(camera);
        }
    for (int round = 0; round < rounds; ++round)
        for (Entry& entry : entries)
            for (const PassTime& time : entry.renderer->render(camera).passTimes) {
                const double each = time.milliseconds * 1e6 / (kWidth * kHeight);
                if (time.pass == "light.point") entry.cost.point = std::min(entry.cost.point, each);
                if (time.pass == "light.environment")
                    entry.cost.environment = std::min(entry.cost.environment, each);
            }
    std::vector<EnvironmentCost> costs;
    for (const Entry& entry : entries) {
        costs.push_back(entry.cost);
        done(entry.cost);
    }
    return costs;
}

}  // namespace lobe::bench
