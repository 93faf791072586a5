// lobe-bench: each pass of each scene against its floor, both measured in this process, as ratios.
//
//   lobe-bench [--assets DIR] [--json FILE] [--resolution W,H] [--frames N] [--backend NAME]
//   lobe-bench fog [--json FILE] [--rounds N] [--backend NAME]      fog, airlight and the order of blended
//   surfaces lobe-bench models [--json FILE] [--rounds N] [--backend NAME]   every model against its textbook
//   form
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "fog.hpp"
#include "measure/floor.hpp"
#include "models.hpp"
#include "passes/renderer.hpp"
#include "plan/summary.hpp"
#include "scene/load.hpp"
#include "scenes.hpp"

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

void runFog(const std::string& backend, const std::string& json, int rounds) {
    const auto context = gl::Context::create({.backend = gl::parseBackend(backend)});
    std::printf("%s, %s, ns a pixel more than the picture without it, median of %d rounds\n",
                context->info().renderer.c_str(), context->info().version.c_str(), rounds);
    nlohmann::json report = {
        {"schema", 1}, {"renderer", context->info().renderer}, {"results", nlohmann::json::array()}};
    for (const FogCost& cost : fogCosts(*context, rounds)) {
        std::printf("%-40s %8.1f (%.1f to %.1f)   %5.2f x of %s\n", cost.name.c_str(), cost.perPixel,
                    cost.interval.low, cost.interval.high, cost.ratio, cost.base.c_str());
        report["results"].push_back({{"name", cost.name},
                                     {"base", cost.base},
                                     {"ns_per_pixel", cost.perPixel},
                                     {"low", cost.interval.low},
                                     {"high", cost.interval.high},
                                     {"ratio", cost.ratio}});
    }
    writeJson(json, report);
}

int run(int argc, char** argv) {
    CLI::App app("Passes against their floors, measured in one process");
    std::string assets, json, backend = "auto";
    int rounds = 7;
    CLI::App* models = app.add_subcommand("models", "every model's GLSL against its textbook form");
    models->add_option("--json", json, "write the results here as well");
    models->add_option("--backend", backend, "auto, egl or osmesa");
    models->add_option("--rounds", rounds, "times that each is measured")->check(CLI::Range(1, 1000));
    CLI::App* fog = app.add_subcommand("fog", "fog, airlight and the order of blended surfaces");
    fog->add_option("--json", json, "write the results here as well");
    fog->add_option("--backend", backend, "auto, egl or osmesa");
    fog->add_option("--rounds", rounds, "times that each is measured")->check(CLI::Range(1, 1000));
    std::vector<int> resolution = {1280, 720};
    int frames = 9;
    app.add_option("--assets", assets, "folder with DamagedHelmet/ and FlightHelmet/ (glTF sample models)");
    app.add_option("--json", json, "write the results here as well");
    app.add_option("--resolution", resolution, "W,H")->delimiter(',')->expected(2);
    app.add_option("--frames", frames, "frames measured a scene")->check(CLI::Range(1, 1000));
    app.add_option("--backend", backend, "auto, egl or osmesa");
    CLI11_PARSE(app, argc, argv);
    if (fog->parsed()) {
        runFog(backend, json, rounds);
        return 0;
    }
    if (models->parsed()) {
        runModels(backend, json, rounds);
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
