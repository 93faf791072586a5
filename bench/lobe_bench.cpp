// lobe-bench: each pass of each scene against its floor, both measured in this process, as ratios.
//
//   lobe-bench [--assets DIR] [--json FILE] [--resolution W,H] [--frames N] [--backend NAME]
//   lobe-bench shadows [--scene FILE]... [--json FILE]   a shadowed light against the same light without
//   shadow lobe-bench area [--json FILE]   a light with a body against a point light lobe-bench models
//   [--json FILE] [--rounds N] [--backend NAME]   every model against its textbook form
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "area_lights.hpp"
#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "measure/floor.hpp"
#include "models.hpp"
#include "passes/renderer.hpp"
#include "plan/summary.hpp"
#include "scene/load.hpp"
#include "scenes.hpp"
#include "shadows.hpp"

namespace lobe::bench {
namespace {

double least(const std::vector<double>& values) {
    return *std::min_element(values.begin(), values.end());
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

struct Result {
    std::string scene;
    size_t triangles = 0;
    int lights = 0;
    double frame = 0.0;                                  ///< ms, median
    std::vector<std::pair<std::string, double>> passes;  ///< ms, least: other programs only ever add
    std::map<std::string, double> floors;                ///< ms, least
};

Result measure(gl::Context& context, Scene scene, int width, int height, int frames) {
    Camera camera = scene.cameras.empty() ? framingCamera(scene.bounds(), static_cast<double>(width) / height)
                                          : scene.cameras[0];
    addDefaultLight(scene, camera);
    Result result{scene.name, scene.triangleCount(), static_cast<int>(scene.lights.size()), 0.0, {}, {}};
    RenderOptions options;
    options.width = width;
    options.height = height;
    options.quality = {.samples = 1};
    options.timePasses = true;
    Renderer renderer(context);
    renderer.setScene(std::make_shared<Scene>(std::move(scene)), options);
    std::map<std::string, std::vector<double>> times;
    std::vector<std::string> order;
    std::vector<double> total;
    for (int i = 0; i < frames + 2; ++i) {
        const Picture picture = renderer.render(camera);
        if (i < 2) continue;  // compiles, fills caches
        total.push_back(picture.milliseconds);
        for (const PassTime& time : picture.passTimes) {
            if (!times.contains(time.pass)) order.push_back(time.pass);
            times[time.pass].push_back(time.milliseconds);
        }
    }
    result.frame = median(total);
    for (const std::string& pass : order)
        result.passes.emplace_back(pass, least(times[pass]));
    result.floors = measure::floorTimes(renderer.plan(), context.info(), width, height, frames + 1);
    return result;
}

void print(const Result& result) {
    std::printf("%-16s %8zu triangles %6d lights   frame %8.2f ms\n", result.scene.c_str(), result.triangles,
                result.lights, result.frame);
    for (const auto& [pass, milliseconds] : result.passes) {
        const auto floor = result.floors.find(pass);
        if (floor == result.floors.end())
            std::printf("    %-20s %8.2f ms\n", pass.c_str(), milliseconds);
        else
            std::printf("    %-20s %8.2f ms   floor %7.2f ms   %6.2f x\n", pass.c_str(), milliseconds,
                        floor->second, milliseconds / floor->second);
    }
    std::fflush(stdout);
}

nlohmann::json toJson(const Result& result) {
    nlohmann::json passes = nlohmann::json::array();
    for (const auto& [pass, milliseconds] : result.passes) {
        nlohmann::json entry = {{"pass", pass}, {"ms", milliseconds}};
        if (const auto floor = result.floors.find(pass); floor != result.floors.end()) {
            entry["floor_ms"] = floor->second;
            entry["ratio"] = milliseconds / floor->second;
        }
        passes.push_back(entry);
    }
    return {{"scene", result.scene},
            {"triangles", result.triangles},
            {"lights", result.lights},
            {"frame_ms", result.frame},
            {"passes", passes}};
}

void writeJson(const std::string& file, const nlohmann::json& report) {
    if (!file.empty()) writeAtomically(file, report.dump(2) + "\n");
}

void print(const ModelTime& time) {
    std::printf("%-28s %8.1f %10.1f %8.1f", time.name.c_str(), time.model, time.textbook, time.floor);
    if (time.ratio > 0.0)
        std::printf(" %7.2f", time.ratio);
    else
        std::printf(" %7s", "-");
    std::printf(" %9.2f\n", 100.0 * time.astray);
    std::fflush(stdout);
}

void runModels(const std::string& backend, const std::string& json, int rounds) {
    const auto context = gl::Context::create({.backend = gl::parseBackend(backend)});
    std::printf("%s, %s, ns an evaluation on %s, median of %d rounds, floor taken off\n",
                context->info().renderer.c_str(), context->info().version.c_str(),
                context->info().software ? "one core" : "the GPU", rounds);
    std::printf("%-28s %8s %10s %8s %7s %9s\n", "model", "model", "textbook", "floor", "ratio", "astray %");
    nlohmann::json report = {
        {"schema", 1}, {"renderer", context->info().renderer}, {"results", nlohmann::json::array()}};
    for (const ModelTime& time :
         modelTimes(context->info(), rounds, [](const ModelTime& done) { print(done); })) {
        report["results"].push_back({{"model", time.name},
                                     {"ns", time.model},
                                     {"textbook_ns", time.textbook},
                                     {"floor_ns", time.floor},
                                     {"textbook_astray", time.astray}});
        if (time.ratio > 0.0) report["results"].back()["ratio"] = time.ratio;
    }
    writeJson(json, report);
}

void print(const ShadowTime& time) {
    std::printf("%-28s %9zu %-12s %-6s %9.1f %11.1f %7.2f %9.0f\n", time.scene.c_str(), time.triangles,
                time.light.c_str(), time.method.c_str(), time.plain, time.shadowed, time.ratio, time.setUp);
    std::fflush(stdout);
}

struct ShadowRun {
    std::vector<std::string> scenes;
    std::string json, backend = "auto";
    std::vector<int> resolution = {640, 360};
    int rounds = 5;
};

void runShadows(const ShadowRun& settings) {
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

void runAreaLights(const ShadowRun& settings) {
    const auto context = gl::Context::create({.backend = gl::parseBackend(settings.backend)});
    const int width = settings.resolution[0], height = settings.resolution[1];
    std::printf("%s, %s, %dx%d, ns a light and pixel, least of %d rounds\n", context->info().renderer.c_str(),
                context->info().version.c_str(), width, height, settings.rounds);
    std::printf("%-10s %-8s %-12s %9s %9s %7s\n", "model", "light", "method", "point", "body", "ratio");
    nlohmann::json report = {
        {"schema", 1}, {"renderer", context->info().renderer}, {"results", nlohmann::json::array()}};
    const auto print = [](const AreaLightTime& time) {
        std::printf("%-10s %-8s %-12s %9.1f %9.1f %7.2f\n", time.model.c_str(), time.light.c_str(),
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

int run(int argc, char** argv) {
    CLI::App app("Passes against their floors, measured in one process");
    std::string assets, json, backend = "auto";
    int rounds = 7;
    CLI::App* models = app.add_subcommand("models", "every model's GLSL against its textbook form");
    models->add_option("--json", json, "write the results here as well");
    models->add_option("--backend", backend, "auto, egl or osmesa");
    models->add_option("--rounds", rounds, "times that each is measured")->check(CLI::Range(1, 1000));
    ShadowRun shadowRun;
    CLI::App* shadows = app.add_subcommand("shadows", "a shadowed light against the same light without");
    shadows->add_option("--scene", shadowRun.scenes, "glTF files to measure beside the generated scenes");
    shadows->add_option("--json", shadowRun.json, "write the results here as well");
    shadows->add_option("--backend", shadowRun.backend, "auto, egl or osmesa");
    shadows->add_option("--resolution", shadowRun.resolution, "W,H")->delimiter(',')->expected(2);
    shadows->add_option("--rounds", shadowRun.rounds, "times that each is drawn")->check(CLI::Range(1, 1000));
    ShadowRun areaRun;
    CLI::App* area = app.add_subcommand("area", "a light with a body against a point light");
    area->add_option("--json", areaRun.json, "write the results here as well");
    area->add_option("--backend", areaRun.backend, "auto, egl or osmesa");
    area->add_option("--resolution", areaRun.resolution, "W,H")->delimiter(',')->expected(2);
    area->add_option("--rounds", areaRun.rounds, "times that each is drawn")->check(CLI::Range(1, 1000));
    std::vector<int> resolution = {1280, 720};
    int frames = 9;
    app.add_option("--assets", assets, "folder with DamagedHelmet/ and FlightHelmet/ (glTF sample models)");
    app.add_option("--json", json, "write the results here as well");
    app.add_option("--resolution", resolution, "W,H")->delimiter(',')->expected(2);
    app.add_option("--frames", frames, "frames measured a scene")->check(CLI::Range(1, 1000));
    app.add_option("--backend", backend, "auto, egl or osmesa");
    CLI11_PARSE(app, argc, argv);
    if (models->parsed()) {
        runModels(backend, json, rounds);
        return 0;
    }
    if (shadows->parsed()) {
        runShadows(shadowRun);
        return 0;
    }
    if (area->parsed()) {
        runAreaLights(areaRun);
        return 0;
    }

    const auto context = gl::Context::create({.backend = gl::parseBackend(backend)});
    std::printf("%s, %s, %dx%d, passes: least of %d frames, frame: median, one sample a pixel\n",
                context->info().renderer.c_str(), context->info().version.c_str(), resolution[0],
                resolution[1], frames);
    std::vector<Result> results;
    const auto add = [&](Scene scene) {
        results.push_back(measure(*context, std::move(scene), resolution[0], resolution[1], frames));
        print(results.back());
    };
    add(flat());
    if (!assets.empty()) {
        SceneLoader loader;
        for (const char* file : {"DamagedHelmet/DamagedHelmet.glb", "FlightHelmet/FlightHelmet.gltf"})
            add(loader.load(std::filesystem::path(assets) / file));
    }
    add(hall());
    double one = 0.0;
    for (const int count : {1, 16, 100, 1000, 10000}) {
        add(lightField(count));
        if (count == 1) one = results.back().frame;
        std::printf("    frame against one light's: %.2f x\n", results.back().frame / one);
    }
    nlohmann::json report = {{"schema", 1},
                             {"renderer", context->info().renderer},
                             {"resolution", resolution},
                             {"results", nlohmann::json::array()}};
    for (const Result& result : results)
        report["results"].push_back(toJson(result));
    writeJson(json, report);
    return 0;
}

}  // namespace
}  // namespace lobe::bench

int main(int argc, char** argv) {
    try {
        return lobe::bench::run(argc, argv);
    } catch (const lobe::Error& error) {
        std::cerr << "lobe-bench: " << error.what() << '\n';
        return static_cast<int>(error.exitCode());
    }
}
