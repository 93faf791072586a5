// lobe: the batch tool. Errors are one line on standard error and a documented exit code.
#include <iostream>
#include <map>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "commands.hpp"
#include "program.hpp"

namespace {

using Command = int (*)(const std::vector<std::string>&);

constexpr const char* kUsage =
    "usage: lobe COMMAND [OPTION...]\n"
    "  render SCENE... -o out/{model}.png   render glTF scenes\n"
    "  reference SCENE -o truth.exr         the true picture, with the error that it still has\n"
    "  plan SCENE                           what a frame runs and leaves out, and why\n"
    "  report SCENE... -o report/           error against run time of quality settings\n"
    "  models [MODEL...]                    shading models, their parameters and published surfaces\n"
    "  plot KIND -o FILE.svg                lobes, albedo, errors, ... of reflectance models\n"
    "  explain SCENE --pixel X,Y            surface, lights and terms behind one pixel, and a test of it\n"
    "  bake ENV -o DIR                      an environment prefiltered for models, for other programs\n"
    "  compare A B                          how far picture A is from B, the truth\n"
    "  info                                 OpenGL contexts that can be made here\n"
    "  help [COMMAND]                       every setting, or a command's options\n"
    "  --version                            versions\n"
    "lobe COMMAND --help lists a command's options.\n";

int run(const std::vector<std::string>& arguments) {
    static const std::map<std::string, Command> commands = {
        {"render", lobe::app::renderCommand},   {"reference", lobe::app::referenceCommand},
        {"compare", lobe::app::compareCommand}, {"explain", lobe::app::explainCommand},
        {"plan", lobe::app::planCommand},       {"models", lobe::app::modelsCommand},
        {"plot", lobe::app::plotCommand},       {"info", lobe::app::infoCommand},
        {"report", lobe::app::reportCommand},   {"help", lobe::app::helpCommand},
        {"bake", lobe::app::bakeCommand}};
    const std::string first = arguments.empty() ? "" : arguments[0];
    if (first == "--version") {
        lobe::app::printVersion("lobe");
        return 0;
    }
    if (first == "--help" || first == "-h") {
        std::cout << kUsage;
        return 0;
    }
    if (first.empty()) {
        std::cerr << kUsage;
        return static_cast<int>(lobe::ExitCode::usage);
    }
    const auto command = commands.find(first);
    if (command == commands.end()) {
        std::vector<std::string> names;
        names.reserve(commands.size());
        for (const auto& [name, function] : commands)
            names.push_back(name);
        throw lobe::UsageError("unknown command '" + first + "'" + lobe::didYouMean(first, names));
    }
    std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
    if (first == "help" && rest.size() == 1 && commands.contains(rest[0]))
        return commands.at(rest[0])({"--help"});
    return command->second(rest);
}

}  // namespace

int main(int argc, char** argv) {
    return lobe::app::runProgram("lobe", argc, argv, run);
}
