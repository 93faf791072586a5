// lobe-view: the desktop demo.
#include <cstdio>
#include <iostream>

#include "arguments.hpp"
#include "base/error.hpp"
#include "program.hpp"
#include "viewer.hpp"

namespace lobe::view {
namespace {

std::pair<int, int> sizeOf(const std::string& text) {
    int width = 0, height = 0, used = 0;
    if (std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &used) != 2 ||
        static_cast<size_t>(used) != text.size() || width < 320 || height < 240 || width > 16384 ||
        height > 16384)
        throw UsageError("--window '" + text + "'; expected WxH from 320x240 to 16384x16384");
    return {width, height};
}

int run(const std::vector<std::string>& list) {
    if (list.size() == 1 && list[0] == "--version") {
        app::printVersion("lobe-view");
        return 0;
    }
    app::Arguments arguments("",
                             "Look at scenes, turn them, and change every model, light and setting "
                             "(docs/view.md). Pictures without a display: lobe render.",
                             "lobe-view");
    ViewerOptions options;
    std::string windowSize;
    arguments.app()
        .add_option("scene", options.scene, "glTF scene or folder; without one a gallery")
        ->type_name("SCENE");
    arguments.app()
        .add_option("--window", windowSize, "size of the window; default as it was")
        ->type_name("WxH");
    arguments.app()
        .add_option("--events", options.eventsFile, "write a line of JSON for each thing that happens")
        ->type_name("FILE");
    arguments.addSettings();
    if (!arguments.parse(list)) return 0;
    if (!windowSize.empty()) options.windowSize = sizeOf(windowSize);
    options.sources = arguments.sources();
    const app::Settings settings = options.sources.resolve(options.scene);
    options.context = {.backend = gl::parseBackend(settings.get("backend").get<std::string>()),
                       .device = settings.get("device").get<int>()};
    return Viewer(options).run();
}

}  // namespace
}  // namespace lobe::view

int main(int argc, char** argv) {
    return lobe::app::runProgram("lobe-view", argc, argv, lobe::view::run);
}
