// lobe plan: what a scene's frame runs and leaves out, and why.
#include <iostream>

#include "arguments.hpp"
#include "base/error.hpp"
#include "commands.hpp"
#include "passes/renderer.hpp"
#include "plan/plan.hpp"
#include "shot_scene.hpp"

namespace lobe::app {
namespace {

/// Those of a context as it would be rendered with; without one, those that OpenGL 3.3 guarantees, and a
/// note.
Capabilities capabilitiesFor(const Settings& settings) {
    const gl::ContextRequest request{.backend = gl::parseBackend(settings.get("backend").get<std::string>()),
                                     .device = settings.get("device").get<int>()};
    try {
        return capabilitiesOf(gl::Context::create(request)->info());
    } catch (const ContextError& error) {
        if (request.backend != gl::Backend::automatic) throw;
        std::cerr << "lobe: warning: planned for what OpenGL 3.3 guarantees, since there is no context: "
                  << error.what() << '\n';
        return {};
    }
}

}  // namespace

int planCommand(const std::vector<std::string>& list) {
    Arguments arguments(
        "plan",
        "Print each pass, variant, channel, texture and light group of a scene: kept or left out, and why.");
    std::vector<std::string> inputs;
    bool json = false, verbose = false;
    arguments.app().add_option("scene", inputs, "glTF scene")->type_name("SCENE");
    arguments.app().add_flag("--json", json, "for programs");
    arguments.app().add_flag("-v,--verbose", verbose, "where each setting comes from");
    arguments.addSettings();
    if (!arguments.parse(list)) return 0;

    const SettingSources sources = arguments.sources();
    const std::vector<std::filesystem::path> files = sceneFiles(inputs);
    if (files.size() != 1) throw UsageError(std::to_string(files.size()) + " scenes; expected one");
    const Settings settings = sources.resolve(files[0]);
    requireOneCamera(settings);
    if (verbose) std::cerr << settings.chain();

    SceneLoader loader;
    auto scene = preparedScene(std::make_shared<const Scene>(loader.load(files[0], loadOptionsOf(settings))),
                               settings);
    const RenderOptions options = renderOptionsOf(settings);
    if (options.quality.fresnel == FresnelEquations::schlick)
        scene = std::make_shared<const Scene>(withSchlick(*scene));
    const FramePlan plan =
        planFrame(summarise(*scene), options.quality, capabilitiesFor(settings), options.aovs);
    for (const std::string& warning : scene->warnings)
        std::cerr << "lobe: warning: " << scene->file << ": " << warning << '\n';
    std::cout << (json ? toJson(plan) + "\n" : toText(plan));
    return 0;
}

}  // namespace lobe::app
