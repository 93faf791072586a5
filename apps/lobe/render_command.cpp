// lobe render: scenes in, pictures out.
#include <atomic>
#include <iostream>

#include "arguments.hpp"
#include "base/error.hpp"
#include "batch.hpp"
#include "commands.hpp"
#include "image/image_files.hpp"
#include "interrupt.hpp"
#include "output_name.hpp"
#include "pipeline.hpp"
#include "quality_goal.hpp"
#include "record.hpp"
#include "shot_scene.hpp"

namespace lobe::app {
namespace {

struct RenderArguments {
    std::vector<std::string> inputs;
    std::string batch, shardText, filter, reproduce;
    double timeLimit = 600.0;
    QualityGoal goal;
    bool headless = false, resume = false, json = false, list = false, quiet = false, verbose = false;
};

void addOptions(CLI::App& app, RenderArguments& r) {
    app.add_option("scenes", r.inputs, "glTF scenes (.gltf, .glb), or folders of them; - is standard input")
        ->type_name("SCENE...");
    app.add_option("--batch", r.batch, "many shots of many scenes, from a JSON file (docs/batch.md)")
        ->type_name("FILE");
    app.add_option("--shard", r.shardText, "only every Nth shot, from the Ith")->type_name("I/N");
    app.add_option("--filter", r.filter, "only shots whose output or scene matches")->type_name("GLOB");
    app.add_option("--reproduce", r.reproduce,
                   "render a picture again from what is written in it; a SCENE given beside it takes the "
                   "place of its own")
        ->type_name("PICTURE");
    app.add_option("--time-limit", r.timeLimit,
                   "with --brdf-file: how long drawing one picture may take before an endless loop is "
                   "assumed [600], s")
        ->type_name("S");
    r.goal.addOptions(app);
    const auto addFlag = [&](const std::string& names, bool& value, const std::string& help) {
        const std::string name = names.substr(names.rfind("--") + 2);
        app.add_flag(names + ",!--no-" + name, value, help);
    };
    addFlag("--resume", r.resume, "leave out pictures that are there and were made the same way");
    addFlag("--list", r.list, "print the shots and render nothing");
    addFlag("--json", r.json, "one JSON object a shot on standard output");
    addFlag("-q,--quiet", r.quiet, "only errors");
    addFlag("-v,--verbose", r.verbose, "where each setting comes from, and times of passes");
    addFlag("--headless", r.headless, "accepted for habit's sake: rendering never needs a display");
}

/// The shot of a picture that is to be made again.
Shot shotOfPicture(const RenderArguments& r, const nlohmann::json& record, const SettingSources& sources) {
    Shot shot = shotOf(record, r.reproduce, sources);
    if (shot.settings->get("output").is_null())
        throw UsageError("--reproduce without --output; expected a name for the new picture");
    if (r.inputs.empty()) return shot;
    const std::vector<std::filesystem::path> scenes = sceneFiles(r.inputs);
    if (scenes.size() != 1)
        throw UsageError(std::to_string(scenes.size()) + " scenes beside --reproduce; expected at most one");
    shot.scene = scenes[0];
    return shot;
}

std::vector<Shot> shotsIn(const RenderArguments& r, const nlohmann::json& record,
                          const SettingSources& sources) {
    if (!r.batch.empty() && !(r.inputs.empty() && r.reproduce.empty()))
        throw UsageError("--batch, and scenes or --reproduce, exclude each other");
    if (!r.batch.empty()) return shotsOfBatch(r.batch, sources);
    if (!r.reproduce.empty()) return {shotOfPicture(r, record, sources)};
    if (r.inputs.empty()) throw UsageError("nothing to render; expected scenes, --batch or --reproduce");
    return shotsOf(sceneFiles(r.inputs), sources);
}

/// The context is one for all shots.
gl::ContextRequest contextOf(const std::vector<Shot>& shots) {
    const auto backend = shots.front().settings->get("backend");
    const auto device = shots.front().settings->get("device");
    for (const Shot& shot : shots)
        if (shot.settings->get("backend") != backend || shot.settings->get("device") != device)
            throw UsageError("backend and device differ between shots; expected one for all");
    gl::ContextRequest request;
    request.backend = gl::parseBackend(backend.get<std::string>());
    request.device = device.get<int>();
    return request;
}

/// Calls once for each run of shots with the same settings.
template<class Action>
void forEachSettings(const std::vector<Shot>& shots, Action action) {
    const Settings* last = nullptr;
    for (const Shot& shot : shots) {
        if (shot.settings.get() == last) continue;
        last = shot.settings.get();
        action(shot);
    }
}

void printList(const std::vector<Shot>& shots, bool asJson) {
    for (const Shot& shot : shots) {
        if (!asJson) {
            std::cout << shot.output << '\t' << shot.scene.string() << '\n';
            continue;
        }
        const nlohmann::ordered_json line = {
            {"schema", 1},           {"output", shot.output}, {"scene", shot.scene.string()},
            {"number", shot.number}, {"frame", shot.frame},   {"settings", shot.settings->toJson()}};
        std::cout << line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
    }
}

}  // namespace

int renderCommand(const std::vector<std::string>& list) {
    Arguments arguments("render", "Render glTF scenes to PNG, JPEG, EXR or HDR files.");
    RenderArguments r;
    addOptions(arguments.app(), r);
    arguments.addSettings();
    if (!arguments.parse(list)) return 0;

    if (!(r.timeLimit > 0.0)) throw UsageError("--time-limit: expected more than 0 seconds");
    if (!r.goal.report.empty() && !r.goal.isSet())
        throw UsageError("--report without --max-error or --budget; expected one of them");
    const SettingSources sources = arguments.sources();
    if (r.goal.isSet()) requireNoKnobs(sources, "--max-error and --budget choose it");
    nlohmann::json record;  // of the picture to reproduce
    if (!r.reproduce.empty()) record = recordIn(ImageFiles().readMetadata(r.reproduce), r.reproduce);
    std::vector<Shot> shots = shotsIn(r, record, sources);
    forEachSettings(shots, [](const Shot& shot) { requireOneCamera(*shot.settings); });
    nameOutputs(shots);
    if (!r.filter.empty()) {
        std::erase_if(shots, [&](const Shot& shot) {
            return !matchesGlob(r.filter, shot.output) && !matchesGlob(r.filter, shot.scene.string());
        });
        if (shots.empty()) throw UsageError("no shot matches --filter '" + r.filter + "'");
    }
    if (!r.shardText.empty()) shots = shard(shots, r.shardText);
    const std::atomic<bool>& interrupted = catchInterrupts();
    if (r.goal.isSet() && !shots.empty()) applyGoal(shots, r.goal, contextOf(shots), r.quiet, interrupted);
    if (r.list) {
        printList(shots, r.json);
        return 0;
    }
    if (shots.empty()) return 0;  // more shards than shots
    if (r.json && shots.front().output == "-")
        throw UsageError("--json and output '-' both want standard output; expected one");
    if (r.verbose)
        forEachSettings(shots, [](const Shot& shot) {
            std::cerr << "settings of " << shot.output << ":\n" << shot.settings->chain();
        });

    PipelineOptions options;
    options.context = contextOf(shots);
    options.resume = r.resume;
    options.timePasses = r.json || r.verbose;
    forEachSettings(shots, [&](const Shot& shot) {
        if (!shot.settings->get("brdf_file").is_null()) options.drawLimit = r.timeLimit;
    });
    if (!record.is_null()) options.reproduced = &record;
    Reporter reporter(shots.size(), r.json,
                      r.quiet     ? Verbosity::quiet
                      : r.verbose ? Verbosity::verbose
                                  : Verbosity::normal);
    runShots(shots, options, reporter, interrupted);
    const ExitCode code = reporter.finish(interrupted);
    return interrupted ? kInterruptedExit : static_cast<int>(code);
}

}  // namespace lobe::app
