// lobe: the batch tool. Errors are one line on standard error and a documented exit code.
#include <CLI/Version.hpp>
#include <cstdio>
#include <exception>
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
    "  info                                 OpenGL contexts that can be made here\n"
    "  help                                 every setting\n"
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
              << "; CLI11 " << CLI11_VERSION << ", nlohmann-json " << NLOHMANN_JSON_VERSION_MAJOR << '.' << NLOHMANN_JSON_VERSION_MINOR
              << '.' << NLOHMANN_JSON_VERSION_PATCH << "\nMIT licence\n";
}

int run(const std::vector<std::string>& arguments) {
    static const std::map<std::string, Command> commands = {{"render", lobe::app::renderCommand},
                                                            {"plan", lobe::app::planCommand},
                                                            {"info", lobe::app::infoCommand},
                                                            {"help", lobe::app::helpCommand}};
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
        for (const auto& [name, function] : commands)
            names.push_back(name);
        throw lobe::UsageError("unknown command '" + first + "'" + lobe::didYouMean(first, names));
    }
    return command->second({arguments.begin() + 1, arguments.end()});
}

int fail(const std::string& message, lobe::ExitCode code) {
    std::cerr << "lobe: error: " << message << '\n';
    return static_cast<int>(code);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const int code = run({argv + 1, argv + argc});
        std::cout.flush();
        return std::cout.good() ? code : fail("standard output: cannot be written", lobe::ExitCode::unwritableOutput);
    } catch (const lobe::Error& error) {
        return fail(error.what(), error.exitCode());
    } catch (const std::bad_alloc&) {
        return fail("out of memory", lobe::ExitCode::unreadableInput);
    } catch (const std::exception& error) {
        return fail(std::string("unexpected: ") + error.what(), lobe::ExitCode::checkFailed);
    }
}
