// lobe-check PATH...: runs the tests in GLSL files.
#include <chrono>
#include <iostream>
#include <memory>
#include <set>
#include <thread>

#include "base/error.hpp"
#include "commands.hpp"
#include "harness/unit/unit_worker.hpp"
#include "options.hpp"
#include "printer.hpp"
#include "run_report.hpp"
#include "selection.hpp"
#include "watch.hpp"

namespace lobe::app {
namespace {

using harness::TestCase;
using harness::TestFile;
using harness::UnitResult;

harness::UnitWorkerSettings workerSettings(const CheckOptions& options) {
    harness::UnitWorkerSettings settings;
    settings.context = options.context;
    for (const auto& folder : options.folders)
        settings.folders.push_back(std::filesystem::absolute(folder));
    settings.timeLimit = std::chrono::milliseconds(static_cast<int64_t>(options.timeLimit * 1000.0));
    return settings;
}

/// All repetitions; the first that does not pass is the result.
UnitResult runRepeatedly(harness::UnitClient& client, const TestFile& file, const TestCase& test,
                         const CheckOptions& options) {
    harness::RunSettings settings{options.rows, options.seed, 0};
    UnitResult result = client.run(file, test, settings);
    while (result.status == UnitResult::Status::passed &&
           ++settings.repetition < static_cast<uint64_t>(options.repeat)) {
        const UnitResult before = std::move(result);
        result = client.run(file, test, settings);
        result.milliseconds += before.milliseconds;
        result.rows += before.rows;
        result.skipped += before.skipped;
    }
    return result;
}

RunReport runAll(const Selection& selection, const CheckOptions& options) {
    const auto started = std::chrono::steady_clock::now();
    RunReport report;
    Printer printer(options);
    const auto take = [&](const UnitResult& result) {
        printer.result(result);
        report.results.push_back(result);
    };
    for (const UnitResult& result : selection.unreadable)
        take(result);
    if (selection.chosen() > 0) {
        harness::UnitClient client(workerSettings(options));
        for (const TestFile& file : selection.files)
            for (const TestCase& test : file.tests)
                take(runRepeatedly(client, file, test, options));
        report.backend = client.backend();
        report.renderer = client.renderer();
    }
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    printer.sum(report);
    writeReport(options.junit, junitXml(report));
    writeReport(options.json, jsonText(report));
    writeReport(options.tap, tapText(report));
    return report;
}

void printList(const Selection& selection, bool tagsOnly) {
    std::set<std::string> tags;
    for (const TestFile& file : selection.files)
        for (const TestCase& test : file.tests) {
            tags.insert(test.tags.begin(), test.tags.end());
            if (tagsOnly) continue;
            std::cout << file.name << ":" << test.place.line << ": " << test.name;
            for (const std::string& tag : test.tags)
                std::cout << " [" << tag << "]";
            std::cout << "\n";
        }
    if (tagsOnly)
        for (const std::string& tag : tags)
            std::cout << tag << "\n";
}

/// Everything that tests read: their files, what these include, their tables.
std::vector<std::filesystem::path> filesRead(const Selection& selection, const CheckOptions& options) {
    std::vector<std::filesystem::path> files;
    const gl::ShaderLibrary library = harness::unitLibrary(workerSettings(options).folders);
    for (const UnitResult& result : selection.unreadable)
        files.emplace_back(result.file);
    for (const TestFile& file : selection.files) {
        files.push_back(file.path);
        files.insert(files.end(), file.csvFiles.begin(), file.csvFiles.end());
        try {
            const gl::ShaderSource source = library.source(std::filesystem::absolute(file.path).string(), {});
            files.insert(files.end(), source.files.begin(), source.files.end());
        } catch (const ShaderError&) {  // the run reported it
        }
    }
    return files;
}

[[noreturn]] void watch(const CheckOptions& options) {
    constexpr auto kPause = std::chrono::milliseconds(200);
    // Its own view of what is there now: files appear, vanish, are wrong for a while.
    const auto look = [&]() -> std::pair<std::optional<Selection>, FileTimes> {
        try {
            Selection selection = select(options);
            FileTimes times(filesRead(selection, options));
            return {std::move(selection), std::move(times)};
        } catch (const Error& error) {
            return {std::nullopt, FileTimes({})};
        }
    };
    for (;;) {
        const auto [selection, times] = look();
        if (selection) runAll(*selection, options);
        std::cout << "Waiting for changes; Ctrl-C ends." << std::endl;
        do
            std::this_thread::sleep_for(kPause);
        while (look().second == times);
    }
}

}  // namespace

int testCommand(const std::vector<std::string>& arguments) {
    const std::optional<CheckOptions> options = parseCheckOptions(arguments);
    if (!options) return 0;
    const Selection selection = select(*options);
    if (options->list || options->listTags) {
        printList(selection, options->listTags);
        for (const UnitResult& result : selection.unreadable)
            throw InputError(result.message);
        return 0;
    }
    if (options->watch) watch(*options);
    return static_cast<int>(runAll(selection, *options).exitCode());
}

}  // namespace lobe::app
