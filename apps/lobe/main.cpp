// lobe: the batch tool. Errors are one line on standard error and a documented exit code.
#include <fcntl.h>
#include <unistd.h>

#include <CLI/Version.hpp>
#include <cstdio>
#include <exception>
#include <glm/detail/setup.hpp>
#include <iostream>
#include <map>
#include <new>
#include <nlohmann/json.hpp>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "commands.hpp"
#include "lobe_paths.hpp"

namespace {

using Command = int (*)(const std::vector<std::string>&);

constexpr const char* kUsage =
    "usage: lobe COMMAND [OPTION...]\n"
    "  render SCENE... -o out/{model}.png   render glTF scenes\n"
    "  plan SCENE                           what a frame runs and leaves out, and why\n"
    "  models [MODEL...]                    shading models, their parameters and published surfaces\n"
    "  plot KIND -o FILE.svg                lobes, albedo, errors, ... of reflectance models\n"
    "  info                                 OpenGL contexts that can be made here\n"
    "  help [COMMAND]                       every setting, or a command's options\n"
    "  --version                            versions\n"
    "lobe COMMAND --help lists a command's options.\n";

void printVersion() {
    std::cout << "lobe " << lobe::paths::kVersion << "\n"
              << "built with " << __VERSION__ <<
#ifdef NDEBUG
        ", release"
#else
        ", debug"
#endif
              << "; CLI11 " << CLI11_VERSION << ", nlohmann-json " << NLOHMANN_JSON_VERSION_MAJOR << '.'
              << NLOHMANN_JSON_VERSION_MINOR << '.' << NLOHMANN_JSON_VERSION_PATCH << ", GLM "
              << GLM_VERSION_MAJOR << '.' << GLM_VERSION_MINOR << '.' << GLM_VERSION_PATCH << "."
              << GLM_VERSION_REVISION << "\n";
}

/// A standard stream that is closed would be the next file that is opened, and get what is meant for people.
void openStandardStreams() {
    for (int stream = 0; stream <= STDERR_FILENO; ++stream)
        if (fcntl(stream, F_GETFD) < 0) open("/dev/null", stream == STDIN_FILENO ? O_RDONLY : O_WRONLY);
}

int run(const std::vector<std::string>& arguments) {
    static const std::map<std::string, Command> commands = {
        {"render", lobe::app::renderCommand}, {"plan", lobe::app::planCommand},
        {"models", lobe::app::modelsCommand}, {"plot", lobe::app::plotCommand},
        {"info", lobe::app::infoCommand},     {"help", lobe::app::helpCommand}};
    const std::string first = arguments.empty() ? "" : arguments[0];
    if (first == "--version") {
        printVersion();
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

int fail(const std::string& message, lobe::ExitCode code) {
    std::cerr << "lobe: error: " << message << '\n';
    return static_cast<int>(code);
}

}  // namespace

int main(int argc, char** argv) {
    openStandardStreams();
    try {
        const int code = run({argv + 1, argv + argc});
        std::cout.flush();
        return std::cout.good() ? code
                                : fail("standard output: can't be written", lobe::ExitCode::unwritableOutput);
    } catch (const lobe::Error& error) {
        return fail(error.what(), error.exitCode());
    } catch (const std::bad_alloc&) {
        return fail("out of memory", lobe::ExitCode::unreadableInput);
    } catch (const std::exception& error) {
        return fail(std::string("unexpected: ") + error.what(), lobe::ExitCode::checkFailed);
    } catch (...) {
        return fail("unexpected, and without a description", lobe::ExitCode::checkFailed);
    }
}
