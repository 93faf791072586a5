// lobe report: how wrong each quality setting is, and what it costs.
#include <filesystem>
#include <iostream>
#include <set>

#include "arguments.hpp"
#include "base/atomic_file.hpp"
#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "commands.hpp"
#include "image/image_files.hpp"
#include "image/tone.hpp"
#include "interrupt.hpp"
#include "lobe_paths.hpp"
#include "measure/against.hpp"
#include "measure/cost.hpp"
#include "measure/errors.hpp"
#include "measure/machine.hpp"
#include "measure/page.hpp"
#include "measure/report_files.hpp"
#include "measure/scene_report.hpp"
#include "quality_goal.hpp"
#include "shot_scene.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kChartWidth = 960, kChartHeight = 640;  // pixels

struct ReportArguments {
    std::vector<std::string> inputs;
    int settings = 40;
    double seconds = 480.0;
    double truthSeconds = 120.0;
    std::string truth, metric = "relmse", against, from, cost;
    bool quiet = false;
};

void addOptions(CLI::App& app, ReportArguments& r) {
    app.add_option("scenes", r.inputs, "glTF scenes (.gltf, .glb), or folders of them")
        ->type_name("SCENE...");
    app.add_option("--max-settings", r.settings, "how many quality settings to measure a scene, at most [40]")
        ->type_name("N")
        ->check(CLI::Range(2, 10000));
    app.add_option("--max-time", r.seconds,
                   "how long to measure a scene, its truth apart; in less time less is measured [480], s")
        ->type_name("S")
        ->check(CLI::Range(1.0, 1e6));
    app.add_option(
           "--truth", r.truth,
           "reference: double precision, with shadows; unshadowed: the same of the scene without shadows; "
           "converged: this engine with 64 samples [reference; converged for models from GLSL files]")
        ->type_name("NAME")
        ->check(CLI::IsMember({"converged", "reference", "unshadowed"}));
    app.add_option("--truth-time", r.truthSeconds, "how long to compute a reference at most [120], s")
        ->type_name("S")
        ->check(CLI::PositiveNumber);
    app.add_option("--error-metric", r.metric, "which error the chart shows [relmse]")
        ->type_name("NAME")
        ->check(CLI::IsMember(measure::errorMetricNames()));
    app.add_option("--against", r.against,
                   "another report.json to compare with: regressions of time and error give exit code 1")
        ->type_name("FILE");
    app.add_option("--from", r.from, "with --against: an earlier report.json, in place of scenes to measure")
        ->type_name("FILE");
    app.add_option(
           "--cost", r.cost,
           "instead: how time grows with lights, pixels, triangles or materials, fitted; the knobs as "
           "set. Writes cost_WHAT.json and .png")
        ->type_name("WHAT");
    app.add_flag("-q,--quiet", r.quiet, "only errors");
}

/// Prints what has changed. Throws Error (checkFailed) if something got worse.
void printChanges(const json& now, const std::string& file) {
    const measure::ReportChanges changes = measure::compareReports(now, measure::readReport(file));
    for (const std::string& line : changes.notes)
        std::cout << "note: " << line << '\n';
    for (const std::string& line : changes.improvements)
        std::cout << "better: " << line << '\n';
    for (const std::string& line : changes.regressions)
        std::cout << "worse: " << line << '\n';
    std::cout << changes.compared << " settings compared, " << changes.regressions.size() << " regressions, "
              << changes.improvements.size() << " improvements\n";
    if (!changes.regressions.empty())
        throw Error(ExitCode::checkFailed,
                    std::to_string(changes.regressions.size()) + " regressions against " + file);
}

/// Writes pictures of a report as they come.
class ReportPictures {
public:
    ReportPictures(fs::path folder, const Settings& settings) : folder_(std::move(folder)) { use(settings); }

    void use(const Settings& settings) {
        exposure_ = static_cast<float>(settings.get("exposure").get<double>());
        toneMapping_ = toneMappingOf(settings);
    }
    void add(const std::string& name, const Image& image) {
        const float black[3] = {0.0f, 0.0f, 0.0f};
        add(name, toDisplay(image, exposure_, toneMapping_, false, black));
    }
    void add(const std::string& name, const Bitmap& bitmap) {
        const std::string file = "pictures/" + name + ".png";
        files_.write(folder_ / file, bitmap, {});
        names_[name] = file;
    }
    const json& names() const { return names_; }

private:
    fs::path folder_;
    float exposure_ = 0.0f;
    ToneMapping toneMapping_ = ToneMapping::none;
    ImageFiles files_;
    json names_ = json::object();
};

/// Settings of each scene.
std::vector<Settings> settingsOf(const std::vector<fs::path>& files, SettingSources sources) {
    // A report's own default, before what the command line says.
    sources.assignments.insert(sources.assignments.begin(), {Assignment::Kind::set, "resolution", "640,360"});
    std::vector<Settings> all;
    for (const fs::path& file : files) {
        all.push_back(sources.resolve(file));
        requireOneCamera(all.back());
    }
    return all;
}

std::string uniqueKey(const std::string& name, std::set<std::string>& used) {
    std::string key = name;
    for (int n = 2; !used.insert(key).second; ++n)
        key = name + "_" + std::to_string(n);
    return key;
}

json headOf(const gl::ContextInfo& info, const std::vector<std::string>& list) {
    std::string command = "lobe report";
    for (const std::string& argument : list)
        command += " " + argument;
    return {{"schema", measure::kReportSchema},
            {"program", "lobe"},
            {"version", paths::kVersion},
            {"machine", measure::machineJson()},
            {"context", measure::contextJson(info, measure::clockOf(info))},
            {"created", measure::utcNow()},
            {"command", command},
            {"knobs", measure::knobsJson()},
            {"scenes", json::array()},
            {"pictures", json::object()}};
}

void writeFiles(const json& report, const fs::path& folder, const std::string& metric) {
    writeAtomically(folder / "report.json",
                    report.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
    writeAtomically(folder / "report.csv", measure::reportCsv(report));
    writeAtomically(folder / "report.png", measure::reportChart(report, metric, kChartWidth, kChartHeight));
    writeReportPage(report, folder);
}

gl::ContextRequest contextOf(const Settings& settings) {
    return {.backend = gl::parseBackend(settings.get("backend").get<std::string>()),
            .device = settings.get("device").get<int>()};
}

struct Work {
    std::vector<fs::path> files;
    std::vector<Settings> settings;
    fs::path folder;
    const ReportArguments& arguments;
    const std::vector<std::string>& list;
    const std::atomic<bool>& interrupted;
};

measure::ReportScene sceneOf(SceneLoader& loader, const Work& work, size_t i, std::set<std::string>& keys) {
    const Settings& settings = work.settings[i];
    measure::ReportScene scene;
    scene.scene = preparedScene(
        std::make_shared<const Scene>(loader.load(work.files[i], loadOptionsOf(settings))), settings);
    if (work.arguments.truth == "unshadowed")
        scene.scene = std::make_shared<const Scene>(withoutShadows(*scene.scene));
    for (const std::string& warning : scene.scene->warnings)
        std::cerr << "lobe: warning: " << scene.scene->file << ": " << warning << '\n';
    scene.camera = cameraOf(*scene.scene, settings, 0);
    const RenderOptions options = renderOptionsOf(settings);
    scene.width = options.width;
    scene.height = options.height;
    scene.key = uniqueKey(scene.scene->name, keys);
    return scene;
}

measure::ReportEvents eventsOf(const Work& work) {
    measure::ReportEvents events;
    events.progress = [&work](const std::string& line) {
        if (!work.arguments.quiet) std::cerr << line << '\n';
    };
    events.stop = &work.interrupted;
    return events;
}

json measureReport(const Work& work, gl::Context& context) {
    ReportPictures pictures(work.folder, work.settings.front());
    json report = headOf(context.info(), work.list);
    const ReportArguments& arguments = work.arguments;
    const measure::TruthSource truth =
        arguments.truth == "converged" ? measure::convergedTruth(context)
        : arguments.truth.empty()      ? measure::bestTruth(context, arguments.truthSeconds, work.interrupted)
                                       : measure::referenceTruth(arguments.truthSeconds, work.interrupted);
    measure::ReportEvents events = eventsOf(work);
    events.picture = [&](const std::string& name, const Image& image) { pictures.add(name, image); };
    events.bitmap = [&](const std::string& name, const Bitmap& bitmap) { pictures.add(name, bitmap); };
    const measure::ReportEffort effort{.settings = arguments.settings, .seconds = arguments.seconds};
    SceneLoader loader;
    std::set<std::string> keys;
    for (size_t i = 0; i < work.files.size() && !work.interrupted; ++i) {
        pictures.use(work.settings[i]);
        json entry = measure::measureScene(context, sceneOf(loader, work, i, keys), truth, effort, events);
        if (entry["settings"].empty()) break;
        report["scenes"].push_back(std::move(entry));
        report["pictures"] = pictures.names();
        // After each scene: what is done stays, whatever comes.
        writeFiles(report, work.folder, work.arguments.metric);
    }
    if (!work.arguments.quiet && !report["scenes"].empty())
        std::cerr << "written: " << (work.folder / "report.json").string()
                  << ", report.csv, report.png, report.html\n";
    return report;
}

void measureCosts(const Work& work, gl::Context& context) {
    const std::string& what = work.arguments.cost;
    json report = headOf(context.info(), work.list);
    for (const char* key : {"scenes", "pictures", "knobs"})
        report.erase(key);
    report["costs"] = json::array();
    SceneLoader loader;
    std::set<std::string> keys;
    for (size_t i = 0; i < work.files.size() && !work.interrupted; ++i) {
        const measure::ReportScene scene = sceneOf(loader, work, i, keys);
        json cost = measure::measureCost(context, scene, qualityOf(work.settings[i]), what,
                                         work.arguments.seconds, eventsOf(work));
        if (cost.is_null()) break;
        const json& fit = cost["fit"];
        std::cout << scene.key << ": time = " << fit["constant_ms"] << " ms + " << fit["factor_ms"]
                  << " ms * " << what << "^" << fit["exponent"] << "; exponent " << fit["exponent_low"]
                  << " to " << fit["exponent_high"] << " (" << fit["confidence"] << "), misfit "
                  << fit["misfit"] << '\n';
        report["costs"].push_back(std::move(cost));
        writeAtomically(work.folder / ("cost_" + what + ".json"),
                        report.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
        writeAtomically(work.folder / ("cost_" + what + ".png"),
                        measure::costChart(report["costs"], kChartWidth, kChartHeight));
    }
}

void requireCostName(const std::string& what) {
    const std::vector<std::string>& names = measure::costNames();
    if (!what.empty() && std::find(names.begin(), names.end(), what) == names.end())
        throw UsageError("--cost " + what + "; expected one of " + listed(names) + didYouMean(what, names));
}

}  // namespace

int reportCommand(const std::vector<std::string>& list) {
    Arguments arguments("report",
                        "Measure error against run time of quality settings, and write report.html, "
                        "report.json, report.csv, report.png and pictures into the folder -o [report].");
    ReportArguments r;
    addOptions(arguments.app(), r);
    arguments.addSettings();
    if (!arguments.parse(list)) return 0;
    requireCostName(r.cost);
    if (!r.cost.empty() && !(r.against.empty() && r.from.empty()))
        throw UsageError("--cost goes without --against and --from");
    if (!r.from.empty()) {
        if (r.against.empty() || !r.inputs.empty())
            throw UsageError("--from goes with --against and without scenes");
        printChanges(measure::readReport(r.from), r.against);
        return 0;
    }
    if (!r.against.empty()) measure::readReport(r.against);  // a wrong one is found before the work
    if (r.inputs.empty()) throw UsageError("nothing to measure; expected scenes");
    const SettingSources sources = arguments.sources();
    if (r.cost.empty()) requireNoKnobs(sources, "a report tries them all");
    const std::vector<fs::path> files = sceneFiles(r.inputs);
    const std::vector<Settings> settings = settingsOf(files, sources);
    const json& output = settings.front().get("output");
    const Work work{files, settings, output.is_null() ? "report" : output.get<std::string>(),
                    r,     list,     catchInterrupts()};
    const auto context = gl::Context::create(contextOf(settings.front()));
    if (!r.cost.empty()) {
        measureCosts(work, *context);
        return work.interrupted ? kInterruptedExit : 0;
    }
    const json report = measureReport(work, *context);
    if (work.interrupted) return kInterruptedExit;
    if (!r.against.empty()) printChanges(report, r.against);
    return 0;
}

}  // namespace lobe::app
