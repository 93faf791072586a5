#include "quality_goal.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

#include "base/error.hpp"
#include "measure/errors.hpp"
#include "measure/machine.hpp"
#include "measure/report_files.hpp"
#include "measure/scene_report.hpp"
#include "plan/knobs.hpp"
#include "scene_cache.hpp"
#include "shot_scene.hpp"

namespace lobe::app {
namespace {

using nlohmann::json;

/// A calibration draws two pictures with a sixteenth of the pixels: all of the scene, where edges take a
/// larger share than they will, and the middle of the final picture, where textures are as fine as they will
/// be. The worse one counts.
constexpr int kShrink = 4, kLeastSide = 64;
constexpr measure::ReportEffort kCalibration{.settings = 14, .seconds = 20.0, .passes = false};

/// What is seen in the middle of the picture.
Camera middleOf(Camera camera, double shrink) {
    camera.verticalFov = 2.0 * std::atan(std::tan(0.5 * camera.verticalFov) / shrink);
    camera.xMag /= shrink;
    camera.yMag /= shrink;
    return camera;
}

json calibrate(gl::Context& context, const std::shared_ptr<const Scene>& scene, const Shot& shot,
               const std::atomic<bool>& interrupted) {
    const RenderOptions options = renderOptionsOf(*shot.settings);
    measure::ReportScene small;
    small.scene = scene;
    const double shrink = std::max(
        1.0, std::min<double>(kShrink, std::min(options.width, options.height) / double{kLeastSide}));
    small.width = std::max(1, static_cast<int>(options.width / shrink));
    small.height = std::max(1, static_cast<int>(options.height / shrink));
    small.key = scene->name;
    const measure::ReportEvents events{[](const std::string&, const Image&) {},
                                       [](const std::string&, const Bitmap&) {}, [](const std::string&) {},
                                       &interrupted};
    const Camera camera = cameraOf(*scene, *shot.settings, shot.frame);
    json scenes = json::array();
    for (const Camera& view : {camera, middleOf(camera, shrink)}) {
        small.camera = view;
        scenes.push_back(
            measure::measureScene(context, small, measure::convergedTruth(context), kCalibration, events));
    }
    return {{"context", measure::contextJson(context.info(), measure::clockOf(context.info()))},
            {"scenes", scenes}};
}

void say(const Shot& shot, const QualityGoal& goal, const measure::Chosen& chosen, const std::string& how) {
    std::cerr << "lobe: " << shot.scene.string() << ": quality " << chosen.label << "; expect " << goal.metric
              << ' ' << chosen.error << " in " << chosen.milliseconds << " ms a frame (" << chosen.basis
              << ", " << how << ")\n";
}

}  // namespace

void QualityGoal::addOptions(CLI::App& app) {
    app.add_option("--max-error", maxError,
                   "choose the fastest quality with at most this error against the truth (docs/report.md)")
        ->type_name("VALUE")
        ->check(CLI::PositiveNumber);
    app.add_option("--error-metric", metric, "what --max-error measures [relmse]")
        ->type_name("NAME")
        ->check(CLI::IsMember(measure::errorMetricNames()));
    app.add_option("--budget", budget,
                   "choose the least wrong quality that takes at most this time a frame, as 16ms")
        ->type_name("TIME");
    app.add_option("--report", report,
                   "with --max-error or --budget: report.json to choose from; without it a quick calibration")
        ->type_name("FILE");
}

measure::Goal QualityGoal::goal() const {
    measure::Goal goal;
    goal.metric = metric;
    if (maxError > 0.0) goal.maxError = maxError;
    if (!budget.empty()) goal.budget = measure::parseDuration("--budget", budget);
    return goal;
}

void requireNoKnobs(const SettingSources& sources, const std::string& why) {
    const std::vector<std::string> knobs = knobNames();
    for (const Assignment& assignment : sources.assignments)
        if (assignment.kind == Assignment::Kind::set &&
            (assignment.key == "quality" ||
             std::find(knobs.begin(), knobs.end(), assignment.key) != knobs.end()))
            throw UsageError(assignment.key + " is set; expected no quality setting: " + why);
}

void applyGoal(std::vector<Shot>& shots, const QualityGoal& options, const gl::ContextRequest& request,
               bool quiet, const std::atomic<bool>& interrupted) {
    const measure::Goal goal = options.goal();
    json report;
    std::unique_ptr<gl::Context> context;
    if (options.report.empty())
        context = gl::Context::create(request);
    else
        report = measure::readReport(options.report);
    SceneCache scenes;
    std::map<std::pair<std::string, const Settings*>, std::shared_ptr<const Settings>> done;
    for (Shot& shot : shots) {
        std::shared_ptr<const Settings>& settings = done[{shot.scene.string(), shot.settings.get()}];
        if (!settings) {
            const std::shared_ptr<const Scene> scene = scenes.get(shot);
            const RenderOptions size = renderOptionsOf(*shot.settings);
            const json& basis = context ? report = calibrate(*context, scene, shot, interrupted) : report;
            if (interrupted) return;
            const measure::Chosen chosen =
                measure::choose(basis, scene->contentHash, double(size.width) * double(size.height), goal);
            if (!quiet) say(shot, options, chosen, context ? "two small pictures" : options.report);
            auto changed = std::make_shared<Settings>(*shot.settings);
            for (const auto& [name, value] : knobValues(chosen.quality))
                changed->set("!" + name, value, goal.maxError ? "--max-error" : "--budget");
            settings = std::move(changed);
        }
        shot.settings = settings;
    }
}

}  // namespace lobe::app
