// lobe reference: the true picture of a scene, with the error that it still has.
#include <atomic>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>

#include "arguments.hpp"
#include "base/error.hpp"
#include "commands.hpp"
#include "interrupt.hpp"
#include "meter.hpp"
#include "output_name.hpp"
#include "record.hpp"
#include "shot_scene.hpp"
#include "shot_sun.hpp"
#include "truth_store.hpp"

namespace lobe::app {
namespace {

struct ReferenceArguments {
    std::vector<std::string> inputs;
    std::string filter = "point";
    double error = 0.002, seconds = 0.0;
    long long mostRays = 1 << 22;
    bool cache = true, json = false, quiet = false;
};

void addOptions(CLI::App& app, ReferenceArguments& r) {
    app.add_option("scene", r.inputs, "glTF scene; - is standard input")->type_name("SCENE");
    app.add_option(
           "--error", r.error,
           "standard error wanted of each pixel, as a share of its radiance and half the mean [0.002]")
        ->type_name("SHARE")
        ->check(CLI::Range(1e-6, 1.0));
    app.add_option("--time-limit", r.seconds, "stop after so long, with what was reached by then, s")
        ->type_name("S")
        ->check(CLI::PositiveNumber);
    app.add_option("--max-rays", r.mostRays, "a pixel, beyond which it is left as it is [4194304]")
        ->type_name("N")
        ->check(CLI::Range(1LL, 1LL << 40));
    app.add_option(
           "--filter", r.filter,
           "point: the ray through the pixel's centre, as a picture without anti-aliasing has it; box: the "
           "mean over the pixel [point]")
        ->type_name("NAME")
        ->check(CLI::IsMember({"point", "box"}));
    app.add_flag("--cache,!--no-cache", r.cache,
                 "go on from an earlier truth of the same picture, and keep this one (default)");
    app.add_flag("--json", r.json, "what was reached, as JSON on standard output");
    app.add_flag("-q,--quiet", r.quiet, "only errors and warnings");
}

}  // namespace

int referenceCommand(const std::vector<std::string>& list) {
    Arguments arguments(
        "reference",
        "Compute the true picture of a scene in double precision, without OpenGL: direct light of "
        "all lights with their shadows, emission, environment, fog and transparency.");
    ReferenceArguments r;
    addOptions(arguments.app(), r);
    arguments.addSettings();
    if (!arguments.parse(list)) return 0;

    const std::vector<std::filesystem::path> files = sceneFiles(r.inputs);
    if (files.size() != 1) throw UsageError(std::to_string(files.size()) + " scenes; expected one");
    std::vector<Shot> shots = shotsOf(files, arguments.sources());
    if (shots.size() != 1) throw UsageError(std::to_string(shots.size()) + " frames; expected one");
    const Shot& shot = shots.front();
    if (shot.settings->get("output").is_null())
        throw UsageError("no --output; expected a name such as truth.exr");
    nameOutputs(shots);
    if (lowerExtension(shot.output) != ".exr")
        throw UsageError("output '" + shot.output + "': expected .exr, which holds radiance and its errors");

    SceneLoader loader;
    const auto scene =
        preparedScene(std::make_shared<const Scene>(loader.load(shot.scene, loadOptionsOf(*shot.settings))),
                      settingsOfTruth(*shot.settings));
    for (const std::string& warning : scene->warnings)
        std::cerr << "lobe: warning: " << scene->file << ": " << warning << '\n';
    for (const Material& material : scene->materials)
        if (const Brdf* brdf = findBrdf(material.brdf)) requireTwin(*brdf);
    const Camera camera = cameraOf(*scene, *shot.settings, shot.frame);

    const RenderOptions size = renderOptionsOf(*shot.settings);
    reference::TruthRequest request;
    request.width = size.width;
    request.height = size.height;
    request.options.filter = r.filter == "box" ? reference::PixelFilter::box : reference::PixelFilter::point;
    request.options.shadows = truthHasShadows(*shot.settings);
    request.relativeError = r.error;
    request.mostRays = r.mostRays;
    if (r.seconds > 0.0) request.seconds = r.seconds;

    ImageFiles imageFiles;
    TruthStore store = r.cache ? TruthStore() : TruthStore(std::filesystem::path());
    const std::string key = truthKey(*scene, camera, request);
    const Image earlier = store.find(key, imageFiles);
    const std::atomic<bool>& stopped = catchInterrupts();
    Meter meter(!r.quiet);
    const auto start = std::chrono::steady_clock::now();
    const reference::TruthResult truth = reference::computeTruth(
        scene, camera, request, earlier.values.empty() ? nullptr : &earlier, stopped,
        [&](const reference::TruthProgress& progress) {
            meter.show(progress.done, "to " + shortPercent(progress.relativeError));
        },
        [&](const Image& image) { store.keep(key, image, imageFiles); });
    meter.clear();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    store.keep(key, truth.image, imageFiles);
    gl::ContextInfo context;  // there is none
    context.backend = "reference";
    nlohmann::json record = recordOf(shot, *scene, camera, context);
    record["reference"] = {{"relative_error", truth.relativeError},
                           {"filter", r.filter},
                           {"shadows", request.options.shadows},
                           {"seconds", seconds}};
    imageFiles.write(shot.output, truth.image,
                     {.metadata = metadataOf(record), .exrPrecision = ExrPrecision::single});

    if (r.json)
        std::cout << nlohmann::ordered_json{{"schema", 1},
                                            {"output", shot.output},
                                            {"width", request.width},
                                            {"height", request.height},
                                            {"relative_error", truth.relativeError},
                                            {"unfinished_pixels", truth.unfinished},
                                            {"seconds", seconds}}
                         .dump()
                  << '\n';
    else if (!r.quiet)
        std::cerr << shot.output << ": standard error " << shortPercent(truth.relativeError)
                  << " (root mean square), " << truth.unfinished << " pixels above " << shortPercent(r.error)
                  << ", " << seconds << " s\n";
    return stopped ? kInterruptedExit : 0;
}

}  // namespace lobe::app
