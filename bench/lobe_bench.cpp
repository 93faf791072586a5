// lobe-bench: each pass of each scene against its floor, both measured in this process, as ratios.
//
//   lobe-bench [--assets DIR] [--json FILE] [--resolution W,H] [--frames N] [--backend NAME]
//   lobe-bench COMMAND [--json FILE] [--rounds N] ...   shadows, lights with a body, fog, models: see --help
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "commands.hpp"
#include "measure/floor.hpp"
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
    // What shadows take, lobe-bench shadows says.
    options.quality = {.samples = 1, .shadows = Shadows::none};
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

int run(int argc, char** argv) {
    CLI::App app("Passes against their floors, measured in one process");
    std::string assets, json, backend = "auto";
    addCommands(app);
    std::vector<int> resolution = {1280, 720};
    int frames = 9;
    app.add_option("--assets", assets, "folder with DamagedHelmet/ and FlightHelmet/ (glTF sample models)");
    app.add_option("--json", json, "write the results here as well");
    app.add_option("--resolution", resolution, "W,H")->delimiter(',')->expected(2);
    app.add_option("--frames", frames, "frames measured a scene")->check(CLI::Range(1, 1000));
    app.add_option("--backend", backend, "auto, egl or osmesa");
    CLI11_PARSE(app, argc, argv);
    if (!app.get_subcommands().empty()) return 0;

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
