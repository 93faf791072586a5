#include "options.hpp"

#include <cmath>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "command_line.hpp"

namespace lobe::app {
namespace {

void refuseTwoOnStandardOutput(const CheckOptions& options) {
    const int count =
        (options.junit == "-" ? 1 : 0) + (options.json == "-" ? 1 : 0) + (options.tap == "-" ? 1 : 0);
    if (count > 1) throw UsageError("two of --junit, --json and --tap on standard output; expected one");
    if (options.watch && count > 0)
        throw UsageError("--watch with a report on standard output; expected a file");
}

/// A word that stands where a path is expected and is almost a command's name.
void refuseMistypedCommand(const CheckOptions& options) {
    if (options.paths.empty() || std::filesystem::exists(options.paths[0])) return;
    const std::string hint = didYouMean(options.paths[0], {"eval", "models"});
    if (!hint.empty()) throw UsageError("no file, folder or command '" + options.paths[0] + "'" + hint);
}

}  // namespace

std::optional<CheckOptions> parseCheckOptions(const std::vector<std::string>& arguments) {
    CheckOptions options;
    CommandLine line(
        "lobe-check",
        "Run the tests in GLSL files: those named, and those in folders whose names end in _test.glsl.\n"
        "Other commands: lobe-check eval --help, lobe-check models --help.");
    std::string backend = "auto";
    CLI::App& app = line.app();
    app.add_option("PATH", options.paths, "test files and folders");
    app.add_option("--backend", backend, "auto, egl, osmesa or glfw [auto]")->type_name("NAME");
    app.add_option("--device", options.context.device, "EGL device, as lobe info lists them")->type_name("N");
    app.add_option("--filter", options.filter, "only tests whose name this expression finds")
        ->type_name("REGEX");
    app.add_option("--tag", options.tags, "only tests with one of these tags; may be repeated")
        ->type_name("TAG")
        ->allow_extra_args(false);
    app.add_flag("--list", options.list, "print the tests and run none");
    app.add_flag("--list-tags", options.listTags, "print the tags and run none");
    app.add_option("--repeat", options.repeat, "run each test N times, each time with the next seed [1]")
        ->type_name("N")
        ->check(CLI::Range(int64_t{1}, int64_t{1} << 30));
    app.add_option("--seed", options.seed, "of all random inputs, in place of @seed")->type_name("N");
    app.add_option("--inputs", options.rows, "random inputs a test, in place of @inputs")
        ->type_name("N")
        ->check(CLI::Range(int64_t{1}, int64_t{1} << 32));
    app.add_option("--junit", options.junit, "write JUnit XML; - is standard output")->type_name("FILE");
    app.add_option("--json", options.json, "write JSON; - is standard output")->type_name("FILE");
    app.add_option("--tap", options.tap, "write TAP; - is standard output")->type_name("FILE");
    app.add_flag("--watch", options.watch, "run again whenever a file that was read changes");
    app.add_option("--time-limit", options.timeLimit, "of a test, in seconds [60]")->type_name("S");
    app.add_option("-I", options.folders, "where includes are looked for too; may be repeated")
        ->type_name("DIR")
        ->allow_extra_args(false);
    app.add_flag("--no-color", options.noColor, "no colours; so does NO_COLOR");
    app.add_flag("-q,--quiet", options.quiet, "print failures and the sum only");
    if (!line.parse(arguments)) return std::nullopt;
    options.context.backend = gl::parseBackend(backend);
    if (options.paths.empty()) throw UsageError("no test file or folder; lobe-check --help shows how");
    if (!(options.timeLimit > 0.0 && options.timeLimit <= 1e6))
        throw UsageError("--time-limit " + std::to_string(options.timeLimit) + "; expected 0..1e6 s");
    refuseTwoOnStandardOutput(options);
    refuseMistypedCommand(options);
    return options;
}

}  // namespace lobe::app
