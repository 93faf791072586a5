#include "fog.hpp"

#include <atomic>
#include <memory>

#include "measure/timing.hpp"
#include "support/scenes.hpp"

namespace lobe::bench {
namespace {

using namespace lobe::test;

constexpr int kWidth = 640, kHeight = 360;

struct Case {
    std::string name, base;
    Scene scene;
    Quality quality;
};

Quality plainQuality() {
    Quality quality;
    quality.samples = 1;
    quality.shadows = Shadows::none;
    return quality;
}

/// A floor and a wall behind it, so that half of the rays end soon, and the sky.
Scene yard() {
    Scene scene;
    const int material = addMaterial(scene, "lambert");
    addInstance(scene, addQuad(scene, material, 20.0f),
                glm::rotate(glm::dmat4(1.0), -std::numbers::pi / 2, glm::dvec3(1, 0, 0)));
    addInstance(scene, addQuad(scene, material, 3.0f), glm::translate(glm::dmat4(1.0), glm::dvec3(0, 1, -4)));
    scene.lights.push_back(point({0.5, 1.5, 0.0}, glm::dvec3(4.0)));
    return scene;
}

Scene inFog(Scene scene, double falloff, double scattering) {
    Fog fog;
    fog.extinction = {0.1, 0.1, 0.1};
    fog.radiance = glm::dvec3(0.3);
    fog.heightFalloff = falloff;
    fog.scattering = glm::dvec3(scattering);
    fog.anisotropy = 0.3;
    scene.fog = fog;
    return scene;
}

/// Panes one behind the other, each over the whole picture.
Scene panes(int count) {
    Scene scene = yard();
    const int material = addMaterial(scene, "metallic_roughness");
    Material& pane = scene.materials.back();
    pane.values = {0.6, 0.3, 0.2, 0.0, 0.5};
    pane.alphaMode = AlphaMode::blend;
    pane.alpha = 0.3f;
    const int quad = addQuad(scene, material, 20.0f);
    for (int i = 0; i < count; ++i)
        addInstance(scene, quad, glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 2.0 + 0.1 * i)));
    return scene;
}

std::vector<Case> cases() {
    std::vector<Case> list;
    list.push_back({"no fog", "", yard(), plainQuality()});
    list.push_back({"even fog", "no fog", inFog(yard(), 0.0, 0.0), plainQuality()});
    list.push_back({"fog by height", "no fog", inFog(yard(), 0.4, 0.0), plainQuality()});
    for (const int nodes : {1, 2, 4, 8, 16, 32}) {
        Quality quality = plainQuality();
        quality.airlightNodes = nodes;
        list.push_back({"airlight of a point light, " + std::to_string(nodes) + " nodes", "even fog",
                        inFog(yard(), 0.0, 0.05), quality});
    }
    Scene lantern = yard();
    lantern.lights[0] = spot({0.5, 1.5, 0.0}, {0.0, 0.0, -2.0}, glm::dvec3(4.0), 0.3, 0.6);
    list.push_back({"spot, no airlight", "", inFog(lantern, 0.0, 0.0), plainQuality()});
    list.push_back({"airlight of a spot light, 8 nodes", "spot, no airlight", inFog(lantern, 0.0, 0.05),
                    plainQuality()});
    for (const int count : {1, 4, 16})
        for (const Transparency transparency : {Transparency::sorted, Transparency::peeled}) {
            Quality quality = plainQuality();
            quality.transparency = transparency;
            const bool peeled = transparency == Transparency::peeled;
            const std::string number = std::to_string(count) + (count == 1 ? " pane" : " panes");
            list.push_back({number + (peeled ? ", peeled" : ", sorted"),
                            peeled ? number + ", sorted" : "no fog", panes(count), quality});
        }
    return list;
}

}  // namespace

std::vector<FogCost> fogCosts(gl::Context& context, int rounds) {
    const std::vector<Case> all = cases();
    Camera camera = lookAt({0, 1.2, 5.5}, {0, 0.8, 0}, 0.7);
    camera.zNear = 0.05;
    const measure::Clock clock = measure::clockOf(context.info());
    context.makeCurrent();
    std::vector<std::unique_ptr<Renderer>> renderers;
    for (const Case& one : all) {
        RenderOptions options;
        options.width = kWidth;
        options.height = kHeight;
        options.quality = one.quality;
        options.timePasses = clock == measure::Clock::timerQueries;
        renderers.push_back(std::make_unique<Renderer>(context));
        renderers.back()->setScene(std::make_shared<Scene>(one.scene), options);
        renderers.back()->render(camera);
    }
    measure::Repeats repeats;
    repeats.rounds = rounds;
    const std::atomic<bool> stop{false};
    const std::vector<measure::Samples> samples = measure::interleave(
        all.size(), repeats, [&](size_t i) { renderers[i]->render(camera); },
        [&](size_t i) { return measure::timeFrame(*renderers[i], camera, clock); }, stop);
    std::vector<FogCost> costs;
    for (size_t i = 0; i < all.size(); ++i) {
        if (all[i].base.empty()) continue;
        size_t base = 0;
        while (all[base].name != all[i].base)
            ++base;
        std::vector<double> differences, ratios;
        for (size_t r = 0; r < samples[i].clock.size(); ++r) {
            differences.push_back((samples[i].clock[r] - samples[base].clock[r]) * 1e6 / (kWidth * kHeight));
            ratios.push_back(samples[i].clock[r] / samples[base].clock[r]);
        }
        costs.push_back({all[i].name, all[i].base, measure::median(differences),
                         measure::medianInterval(differences), measure::median(ratios)});
    }
    return costs;
}

}  // namespace lobe::bench
