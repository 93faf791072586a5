// lobe render: scenes in, pictures out.
#include <atomic>
#include <csignal>
#include <iostream>

#include "arguments.hpp"
#include "base/error.hpp"
#include "commands.hpp"
#include "image/image_files.hpp"
#include "pipeline.hpp"
#include "record.hpp"

namespace lobe::app {
namespace {

std::atomic<bool> interrupted = false;
constexpr int kInterruptedExit = 130;

void interrupt(int) {
    // A second one ends the program at once.
    if (interrupted.exchange(true)) std::_Exit(kInterruptedExit);
}

struct RenderArguments {
    std::vector<std::string> inputs;
    std::string batch, shardText, filter, reproduce;
    bool headless = false, resume = false, json = false, list = false, quiet = false, verbose = false;
};

void addOptions(CLI::App& app, RenderArguments& r) {
    app.add_option("scenes", r.inputs, "glTF scenes (.gltf, .glb), or folders of them")->type_name("SCENE...");
    app.add_option("--batch", r.batch, "many shots of many scenes, from a JSON file (docs/batch.md)")->type_name("FILE");
    app.add_option("--shard", r.shardText, "only every Nth shot, from the Ith")->type_name("I/N");
    app.add_option("--filter", r.filter, "only shots whose output or scene matches")->type_name("GLOB");
    app.add_option("--reproduce", r.reproduce, "render a picture again from what is written in it")->type_name("PICTURE");
    app.add_flag("--resume", r.resume, "leave out pictures that are there and were made the same way");
    app.add_flag("--list", r.list, "print the shots and render nothing");
    app.add_flag("--json", r.json, "one JSON object a shot on standard output");
    app.add_flag("-q,--quiet", r.quiet, "only errors");
    app.add_flag("-v,--verbose", r.verbose, "where each setting comes from, and times of passes");
    app.add_flag("--headless", r.headless, "accepted for habit's sake: rendering never needs a display");
}

std::vector<Shot> collect(const RenderArguments& r, const SettingSources& sources) {
    const int kinds = !r.inputs.empty() + !r.batch.empty() + !r.reproduce.empty();
    if (kinds != 1) throw UsageError(kinds == 0 ? "nothing to render; expected scenes, --batch or --reproduce"
                                                : "scenes, --batch and --reproduce exclude each other");
    if (!r.batch.empty()) return shotsOfBatch(r.batch, sources);
    if (r.reproduce.empty()) return shotsOf(sceneFiles(r.inputs), sources);
    ImageFiles files;
    return {shotOf(recordIn(files.readMetadata(r.reproduce), r.reproduce), r.reproduce, sources)};
}

/// The context is one for all shots.
gl::ContextRequest contextOf(const std::vector<Shot>& shots) {
    gl::ContextRequest request;
    const auto backend = shots.front().settings.get("backend");
    const auto device = shots.front().settings.get("device");
    for (const Shot& shot : shots)
        if (shot.settings.get("backend") != backend || shot.settings.get("device") != device)
            throw UsageError("backend and device differ between shots; expected one for all");
    request.backend = gl::parseBackend(backend.get<std::string>());
    request.device = device.get<int>();
    return request;
}

}  // namespace

int renderCommand(const std::vector<std::string>& list) {
    Arguments arguments("render", "Render glTF scenes to PNG, JPEG, EXR or HDR files.");
    RenderArguments r;
    addOptions(arguments.app(), r);
    arguments.addSettings();
    if (!arguments.parse(list)) return 0;

    std::vector<Shot> shots = collect(r, arguments.sources());
    nameOutputs(shots);
    if (!r.filter.empty())
        std::erase_if(shots, [&](const Shot& shot) { return !matchesGlob(r.filter, shot.output) && !matchesGlob(r.filter, shot.scene.string()); });
    if (!r.shardText.empty()) shots = shard(shots, r.shardText);
    if (r.list) {
        for (const Shot& shot : shots)
            std::cout << shot.output << '\t' << shot.scene.string() << '\n';
        return 0;
    }
    if (shots.empty()) {
        if (!r.shardText.empty()) return 0;  // more shards than shots
        throw UsageError("no shot matches --filter '" + r.filter + "'");
    }
    if (r.json && shots.front().output == "-") throw UsageError("--json and output '-' both want standard output; expected one");
    if (r.verbose) std::cerr << shots.front().settings.chain();

    PipelineOptions options;
    options.context = contextOf(shots);
    options.resume = r.resume;
    options.timePasses = r.json || r.verbose;
    Reporter reporter(shots.size(), r.json, r.quiet ? Verbosity::quiet : r.verbose ? Verbosity::verbose : Verbosity::normal);
    std::signal(SIGINT, interrupt);
    std::signal(SIGTERM, interrupt);
    std::signal(SIGPIPE, SIG_IGN);
    runShots(shots, options, reporter, interrupted);
    const ExitCode code = reporter.finish(interrupted);
    return interrupted ? kInterruptedExit : static_cast<int>(code);
}

}  // namespace lobe::app
