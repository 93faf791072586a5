#include "commands.hpp"

#include <iostream>
#include <nlohmann/json.hpp>

#include "area_lights.hpp"
#include "base/atomic_file.hpp"
#include "environment_commands.hpp"
#include "fog.hpp"
#include "gl/context.hpp"
#include "models.hpp"
#include "scene/camera.hpp"
#include "scene/load.hpp"
#include "shadow_maps.hpp"
#include "shadows.hpp"

namespace lobe::bench {
namespace {

struct Settings {
    std::string json, backend = "auto";
    std::vector<std::string> scenes;
    std::vector<int> resolution = {640, 360};
    int rounds = 7;
};

void print(const ModelTime& time) {
    std::printf("%-28s %8.1f %10.1f %8.1f", time.name.c_str(), time.model, time.textbook, time.floor);
    if (time.ratio > 0.0)
        std::printf(" %7.2f", time.ratio);
    else
        std::printf(" %7s", "-");
    std::printf(" %9.2f\n", 100.0 * time.astray);
    std::fflush(stdout);
}

void runModels(const Settings& settings) {
    const auto context = gl::Context::create({.backend = gl::parseBackend(settings.backend)});
    std::printf("%s, %s, ns an evaluation on %s, median of %d rounds, floor taken off\n",
                context->info().renderer.c_str(), context->info().version.c_str(),
                context->info().software ? "one core" : "the GPU", settings.rounds);
    std::printf("%-28s %8s %10s %8s %7s %9s\n", "model", "model", "textbook", "floor", "ratio", "astray %");
    nlohmann::json report = {
        {"schema", 1}, {"renderer", context->info().renderer}, {"results", nlohmann::json::array()}};
    for (const ModelTime& time :
         modelTimes(context->info(), settings.rounds, [](const ModelTime& done) { print(done); })) {
        report["results"].push_back({{"model", time.name},
                                     {"ns", time.model},
                                     {"textbook_ns", time.textbook},
                                     {"floor_ns", time.floor},
                                     {"textbook_astray", time.astray}});
        if (time.ratio > 0.0) report["results"].back()["ratio"] = time.ratio;
    }
    writeJson(settings.json, report);
}

void print(const ShadowTime& time) {
    std::printf("%-28s %9zu %-12s %-6s %9.1f %11.1f %7.2f %9.0f\n", time.scene.c_str(), time.triangles,
                time.light.c_str(), time.method.c_str(), time.plain, time.shadowed, time.ratio, time.setUp);
    std::fflush(stdout);
}

void runShadows(const Settings& settings) {
    const auto context = gl::Context::create({.backend = gl::parseBackend(settings.backend)});
    std::vector<Scene> scenes;
    SceneLoader loader;
    for (const std::string& file : settings.scenes) {
        Scene scene = loader.load(file);
        if (scene.cameras.empty())
            scene.cameras.push_back(framingCamera(
                scene.bounds(), static_cast<double>(settings.resolution[0]) / settings.resolution[1]));
        scenes.push_back(std::move(scene));
    }
    std::printf("%s, %s, %dx%d, ns a light and pixel, least of %d rounds\n", context->info().renderer.c_str(),
                context->info().version.c_str(), settings.resolution[0], settings.resolution[1],
                settings.rounds);
    std::printf("%-28s %9s %-12s %-6s %9s %11s %7s %9s\n", "scene", "triangles", "light", "method", "plain",
                "shadowed", "ratio", "setup ms");
    nlohmann::json report = {
        {"schema", 1}, {"renderer", context->info().renderer}, {"results", nlohmann::json::array()}};
    for (const ShadowTime& time :
         shadowTimes(*context, scenes, settings.resolution[0], settings.resolution[1], settings.rounds,
                     [](const ShadowTime& done) { print(done); }))
        report["results"].push_back({{"scene", time.scene},
                                     {"triangles", time.triangles},
                                     {"light", time.light},
                                     {"method", time.method},
                                     {"plain_ns", time.plain},
                                     {"shadowed_ns", time.shadowed},
                                     {"ratio", time.ratio},
                                     {"setup_ms", time.setUp}});
    writeJson(settings.json, report);
}

void runShadowMaps(const Settings& settings) {
    const auto context = gl::Context::create({.backend = gl::parseBackend(settings.backend)});
    std::printf("%s, %s, %dx%d, least of %d rounds; look and draw in unshadowed lights of the type\n",
                context->info().renderer.c_str(), context->info().version.c_str(), settings.resolution[0],
                settings.resolution[1], settings.rounds);
    std::printf("%-12s %5s %5s %7s %7s %9s %9s\n", "light", "size", "taps", "look", "draw", "error %",
                "wrong %");
    nlohmann::json report = {
        {"schema", 1}, {"renderer", context->info().renderer}, {"results", nlohmann::json::array()}};
    const auto print = [](const ShadowMapResult& r) {
        std::printf("%-12s %5d %5d %7.2f %7.2f %9.3f %9.3f\n", r.light.c_str(), r.size, r.taps, r.lookUp,
                    r.draw, 100.0 * r.error, 100.0 * r.wrong);
        std::fflush(stdout);
    };
    for (const ShadowMapResult& r :
         shadowMapResults(*context, settings.resolution[0], settings.resolution[1], settings.rounds, print))
        report["results"].push_back({{"light", r.light},
                                     {"size", r.size},
                                     {"taps", r.taps},
                                     {"look_up", r.lookUp},
                                     {"draw", r.draw},
                                     {"error", r.error},
                                     {"wrong", r.wrong}});
    writeJson(settings.json, report);
}

void runAreaLights(const Settings& settings) {
    const auto context = gl::Context::create({.backend = gl::parseBackend(settings.backend)});
    const int width = settings.resolution[0], height = settings.resolution[1];
    std::printf("%s, %s, %dx%d, ns a light and pixel, least of %d rounds\n", context->info().renderer.c_str(),
                context->info().version.c_str(), width, height, settings.rounds);
    std::printf("%-10s %-16s %-12s %9s %9s %7s\n", "model", "light", "method", "point", "body", "ratio");
    nlohmann::json report = {
        {"schema", 1}, {"renderer", context->info().renderer}, {"results", nlohmann::json::array()}};
    const auto print = [](const AreaLightTime& time) {
        std::printf("%-10s %-16s %-12s %9.1f %9.1f %7.2f\n", time.model.c_str(), time.light.c_str(),
                    time.method.c_str(), time.point, time.body, time.ratio);
        std::fflush(stdout);
    };
    for (const AreaLightTime& time : areaLightTimes(*context, width, height, settings.rounds, print))
        report["results"].push_back({{"model", time.model},
                                     {"light", time.light},
                                     {"method", time.method},
                                     {"point_ns", time.point},
                                     {"body_ns", time.body},
                                     {"ratio", time.ratio}});
    writeJson(settings.json, report);
}

void runFog(const Settings& settings) {
    const auto context = gl::Context::create({.backend = gl::parseBackend(settings.backend)});
    std::printf("%s, %s, ns a pixel more than the picture without it, median of %d rounds\n",
                context->info().renderer.c_str(), context->info().version.c_str(), settings.rounds);
    nlohmann::json report = {
        {"schema", 1}, {"renderer", context->info().renderer}, {"results", nlohmann::json::array()}};
    for (const FogCost& cost : fogCosts(*context, settings.rounds)) {
        std::printf("%-40s %8.1f (%.1f to %.1f)   %5.2f x of %s\n", cost.name.c_str(), cost.perPixel,
                    cost.interval.low, cost.interval.high, cost.ratio, cost.base.c_str());
        report["results"].push_back({{"name", cost.name},
                                     {"base", cost.base},
                                     {"ns_per_pixel", cost.perPixel},
                                     {"low", cost.interval.low},
                                     {"high", cost.interval.high},
                                     {"ratio", cost.ratio}});
    }
    writeJson(settings.json, report);
}

}  // namespace

void writeJson(const std::string& file, const nlohmann::json& report) {
    if (!file.empty()) writeAtomically(file, report.dump(2) + "\n");
}

void addCommands(CLI::App& app) {
    addEnvironmentCommand(app);
    struct Command {
        const char* name;
        const char* help;
        void (*run)(const Settings&);
        bool sized = false, scenes = false;
    };
    static constexpr Command kCommands[] = {
        {"models", "every model's GLSL against its textbook form", runModels},
        {"shadows", "a shadowed light against the same light without", runShadows, true, true},
        {"shadow-maps", "cost and error of shadow maps by size and taps", runShadowMaps, true},
        {"area", "a light with a body against a point light", runAreaLights, true},
        {"fog", "fog, airlight and the order of blended surfaces", runFog}};
    for (const Command& command : kCommands) {
        CLI::App* sub = app.add_subcommand(command.name, command.help);
        const auto settings = std::make_shared<Settings>();
        sub->add_option("--json", settings->json, "write the results here as well");
        sub->add_option("--backend", settings->backend, "auto, egl or osmesa");
        sub->add_option("--rounds", settings->rounds, "times that each is measured")
            ->check(CLI::Range(1, 1000));
        if (command.sized)
            sub->add_option("--resolution", settings->resolution, "W,H")->delimiter(',')->expected(2);
        if (command.scenes)
            sub->add_option("--scene", settings->scenes, "glTF files to measure beside the generated scenes");
        sub->callback([settings, run = command.run] { run(*settings); });
    }
}

}  // namespace lobe::bench
