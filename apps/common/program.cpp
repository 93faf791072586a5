#include "program.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <CLI/Version.hpp>
#include <exception>
#include <glm/detail/setup.hpp>
#include <iostream>
#include <new>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "lobe_paths.hpp"

namespace lobe::app {
namespace {

/// A standard stream that is closed would be the next file that is opened, and get what is meant for people.
void openStandardStreams() {
    for (int stream = 0; stream <= STDERR_FILENO; ++stream)
        if (fcntl(stream, F_GETFD) < 0) open("/dev/null", stream == STDIN_FILENO ? O_RDONLY : O_WRONLY);
}

}  // namespace

void printVersion(const std::string& name) {
    std::cout << name << " " << paths::kVersion << "\n"
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

int runProgram(const std::string& name, int argc, char** argv,
               const std::function<int(const std::vector<std::string>&)>& run) {
    const auto fail = [&](const std::string& message, ExitCode code) {
        std::cerr << name << ": error: " << message << '\n';
        return static_cast<int>(code);
    };
    openStandardStreams();
    try {
        const int code = run({argv + 1, argv + argc});
        std::cout.flush();
        return std::cout.good() ? code
                                : fail("standard output: can't be written", ExitCode::unwritableOutput);
    } catch (const Error& error) {
        return fail(error.what(), error.exitCode());
    } catch (const std::bad_alloc&) {
        return fail("out of memory", ExitCode::unreadableInput);
    } catch (const std::exception& error) {
        return fail(std::string("unexpected: ") + error.what(), ExitCode::checkFailed);
    } catch (...) {
        return fail("unexpected, and without a description", ExitCode::checkFailed);
    }
}

}  // namespace lobe::app
