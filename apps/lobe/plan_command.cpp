// lobe plan: what a scene's frame runs and leaves out, and why.
#include <iostream>

#include "arguments.hpp"
#include "base/error.hpp"
#include "commands.hpp"
#include "passes/renderer.hpp"
#include "plan/plan.hpp"
#include "shot_scene.hpp"

namespace lobe::app {

int planCommand(const std::vector<std::string>& list) {
    Arguments arguments("plan", "Print each pass, variant, channel, texture and light group of a scene: kept or left out, and why.");
    std::vector<std::string> inputs;
    bool json = false;
    arguments.app().add_option("scene", inputs, "glTF scene")->type_name("SCENE");
    arguments.app().add_flag("--json", json, "for programs");
    arguments.addSettings();
    if (!arguments.parse(list)) return 0;
    if (inputs.size() != 1) throw UsageError(std::to_string(inputs.size()) + " scenes; expected one");

    const Settings settings = arguments.sources().resolve(inputs[0]);
    SceneLoader loader;
    const auto scene = preparedScene(std::make_shared<const Scene>(loader.load(inputs[0], loadOptionsOf(settings))), settings);
    const RenderOptions options = renderOptionsOf(settings);
    const auto context = gl::Context::create({.backend = gl::parseBackend(settings.get("backend").get<std::string>()),
                                              .device = settings.get("device").get<int>()});
    const FramePlan plan = planFrame(summarise(*scene), options.quality, capabilitiesOf(context->info()), options.aovs);
    for (const std::string& warning : scene->warnings)
        std::cerr << "warning: " << warning << '\n';
    std::cout << (json ? toJson(plan) + "\n" : toText(plan));
    return 0;
}

}  // namespace lobe::app
