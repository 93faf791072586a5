#include "measure/scene_report.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "measure/errors.hpp"
#include "measure/floor.hpp"
#include "measure/knob_space.hpp"
#include "measure/sweep.hpp"
#include "plan/knobs.hpp"

namespace lobe::measure {
namespace {

using nlohmann::json;
using SteadyClock = std::chrono::steady_clock;

double secondsSince(SteadyClock::time_point start) {
    return std::chrono::duration<double>(SteadyClock::now() - start).count();
}

/// Shares of a scene's time: the search, then timing; passes and floors take what is left.
constexpr double kSearchShare = 0.5, kTimingEnd = 0.85;
/// Frames of each pass's times, and runs of its floor.
constexpr int kPassFrames = 3, kFloorRuns = 3;

struct Setting {
    Choice choice;
    Quality quality;
    json error;
    json passes = json::array();
    std::string picture;
};

class SceneMeasurement {
public:
    SceneMeasurement(gl::Context& context, const ReportScene& scene, const ReportEffort& effort,
                     const ReportEvents& events)
        : info_(context.info()),
          clock_(clockOf(info_)),
          scene_(scene),
          effort_(effort),
          events_(events),
          summary_(summarise(*scene.scene)),
          space_(summary_),
          renderer_(context),
          start_(SteadyClock::now()) {}

    json run(const Truth& truth) {
        search(truth);
        time();
        if (effort_.passes) timePasses();
        return toJson(truth);
    }

private:
    bool stopped() const { return *events_.stop; }

    void prepare(const Quality& quality, bool timePasses) {
        RenderOptions options;
        options.width = scene_.width;
        options.height = scene_.height;
        options.quality = quality;
        options.timePasses = timePasses;
        renderer_.setScene(scene_.scene, options);
    }

    void search(const Truth& truth) {
        std::vector<Choice> presets;
        for (const std::string& name : qualityPresetNames())
            presets.push_back(space_.choiceOf(qualityPreset(name)));
        Search search(space_.sizes(), space_.choiceOf(qualityPreset("converged")), presets,
                      [&](const Choice& choice) { return space_.canonical(choice); });
        possible_ = search.possible();
        while (static_cast<int>(settings_.size()) < effort_.settings && !stopped()) {
            const std::optional<Choice> choice = search.next(points_);
            if (!choice) break;
            tryOut(*choice, truth);
            events_.progress(scene_.key + ": setting " + std::to_string(settings_.size()) + " of at most " +
                             std::to_string(effort_.settings) + ": " + labelOf(settings_.back()));
            if (secondsSince(start_) > kSearchShare * effort_.seconds) break;
        }
    }

    /// Its picture, its error, and roughly its time.
    void tryOut(const Choice& choice, const Truth& truth) {
        Setting setting;
        setting.choice = choice;
        setting.quality = space_.qualityOf(choice);
        prepare(setting.quality, clock_ == Clock::timerQueries);
        const Image image = renderer_.render(scene_.camera).image;  // compiles and warms
        const double time = timeFrame(renderer_, scene_.camera, clock_).clock;
        PictureError error = pictureError(image, truth.image);
        setting.error = std::move(error.values);
        setting.picture = scene_.key + "_settings_" + std::to_string(settings_.size());
        events_.picture(setting.picture, image);
        events_.bitmap(setting.picture + "_diff", error.map);
        leftOut_ = renderer_.plan().leftOut;
        points_.push_back({choice, std::max(time, 1e-6), error.relativeSquare});
        settings_.push_back(std::move(setting));
    }

    void time() {
        Repeats repeats;
        repeats.seconds = std::max(0.0, kTimingEnd * effort_.seconds - secondsSince(start_));
        int prepared = 0;
        const auto ready = [&](size_t i) {
            const auto count = static_cast<int>(settings_.size());
            if (prepared % count == 0)
                events_.progress(scene_.key + ": timing " + std::to_string(count) + " settings, round " +
                                 std::to_string(prepared / count + 1) + " of at most " +
                                 std::to_string(repeats.rounds));
            ++prepared;
            prepare(settings_[i].quality, clock_ == Clock::timerQueries);
            renderer_.render(scene_.camera);
        };
        const auto frame = [&](size_t) { return timeFrame(renderer_, scene_.camera, clock_); };
        samples_ = interleave(settings_.size(), repeats, ready, frame, *events_.stop);
        if (samples_.empty() || !samples_[0].clock.empty()) return;
        // Stopped in the first round: the rough times stand, one each.
        for (size_t i = 0; i < samples_.size(); ++i)
            samples_[i] = {{points_[i].time}, {points_[i].time}, {points_[i].time}};
    }

    void timePasses() {
        for (size_t i = 0; i < settings_.size() && !stopped() && secondsSince(start_) < effort_.seconds;
             ++i) {
            Setting& setting = settings_[i];
            prepare(setting.quality, true);
            renderer_.render(scene_.camera);
            std::vector<std::string> order;
            std::map<std::string, std::vector<double>> times;
            for (int frame = 0; frame < kPassFrames; ++frame)
                for (const PassTime& time : renderer_.render(scene_.camera).passTimes) {
                    if (!times.contains(time.pass)) order.push_back(time.pass);
                    times[time.pass].push_back(time.milliseconds);
                }
            const FramePlan plan = renderer_.plan();
            const std::map<std::string, double> floors =
                floorTimes(plan, info_, scene_.width, scene_.height, kFloorRuns);
            for (const std::string& pass : order)
                setting.passes.push_back(passJson(plan, pass, median(times[pass]), floors));
        }
    }

    static json passJson(const FramePlan& plan, const std::string& name, double milliseconds,
                         const std::map<std::string, double>& floors) {
        json entry = {
            {"pass", name}, {"median_ms", milliseconds}, {"floor_ms", nullptr}, {"bytes_per_pixel", nullptr}};
        if (const PlannedPass* pass = plan.pass(name)) {
            int bytes = 0;
            for (const std::vector<std::string>* channels : {&pass->reads, &pass->writes})
                for (const std::string& channel : *channels)
                    if (const Channel* found = plan.channel(channel)) bytes += found->bytesPerPixel;
            entry["bytes_per_pixel"] = bytes * plan.samples;
        }
        if (const auto floor = floors.find(name); floor != floors.end())
            entry["floor_ms"] = floor->second * plan.samples;
        return entry;
    }

    std::string presetOf(const Setting& setting) const {
        for (const std::string& name : qualityPresetNames())
            if (space_.canonical(space_.choiceOf(qualityPreset(name))) == setting.choice) return name;
        return {};
    }

    std::string labelOf(const Setting& setting) const {
        const std::string preset = presetOf(setting);
        return preset.empty() ? space_.label(setting.choice) : preset;
    }

    json toJson(const Truth& truth) {
        const Noise noise = judgeNoise(samples_);
        std::vector<double> errors;
        for (const Point& point : points_)
            errors.push_back(point.error);
        const std::vector<size_t> front = paretoFront(
            errors, [&](size_t i, size_t j) { return noise.order[i][j]; },
            truth.standardError * truth.standardError);
        json settings = json::array();
        for (size_t i = 0; i < settings_.size(); ++i) {
            json entry = settingJson(i, noise);
            entry["front"] = std::find(front.begin(), front.end(), i) != front.end();
            settings.push_back(std::move(entry));
        }
        json leftOut = json::array();
        for (const LeftOut& left : leftOut_)
            leftOut.push_back({{"kind", left.kind}, {"name", left.name}, {"reason", left.reason}});
        return {{"scene", scene_.scene->name},
                {"file", scene_.scene->file},
                {"content_hash", scene_.scene->contentHash},
                {"camera", scene_.camera.name},
                {"width", scene_.width},
                {"height", scene_.height},
                {"triangles", scene_.scene->triangleCount()},
                {"lights", scene_.scene->lights.size()},
                {"knobs_without_effect", space_.withoutEffectJson()},
                {"left_out", leftOut},
                {"settings", settings},
                {"noise",
                 {{"verdict", !noise.known  ? "unknown"
                              : noise.noisy ? "noisy"
                                            : "quiet"},
                  {"detail", noise.detail}}},
                {"search",
                 {{"tried", settings_.size()},
                  {"possible", possible_},
                  {"method",
                   "presets; each knob alone from converged; combinations that minimise error + lambda time "
                   "for one lambda over all knobs; neighbours of the front"}}}};
    }

    json settingJson(size_t i, const Noise& noise) const {
        const Setting& setting = settings_[i];
        const TimeSummary time = summariseTime(samples_[i]);
        json knobs = json::object();
        for (const auto& [name, value] : knobValues(setting.quality))
            knobs[name] = value;
        json ties = json::array();
        for (size_t j = 0; j < settings_.size(); ++j)
            if (j != i && noise.order[i][j] == Order::tie) ties.push_back(j);
        const std::string preset = presetOf(setting);
        return {{"id", i},
                {"label", labelOf(setting)},
                {"preset", preset.empty() ? json() : json(preset)},
                {"knobs", knobs},
                {"time",
                 {{"median_ms", time.median},
                  {"low_ms", time.interval.low},
                  {"high_ms", time.interval.high},
                  {"confidence", time.interval.confidence},
                  {"repeats", time.repeats},
                  {"minimum_ms", time.minimum},
                  {"mad_ms", time.mad},
                  {"wall_ms", time.wall},
                  {"cpu_ms", time.cpu}}},
                {"passes", setting.passes},
                {"error", setting.error},
                {"picture", setting.picture},
                {"difference", setting.picture + "_diff"},
                {"tied_with", ties}};
    }

    gl::ContextInfo info_;
    Clock clock_;
    const ReportScene& scene_;
    const ReportEffort& effort_;
    const ReportEvents& events_;
    SceneSummary summary_;
    KnobSpace space_;
    Renderer renderer_;
    SteadyClock::time_point start_;
    std::vector<Setting> settings_;
    std::vector<Point> points_;
    std::vector<Samples> samples_;
    std::vector<LeftOut> leftOut_;
    double possible_ = 0.0;
};

}  // namespace

json measureScene(gl::Context& context, const ReportScene& scene, const TruthSource& truthSource,
                  const ReportEffort& effort, const ReportEvents& events) {
    events.progress(scene.key + ": truth");
    const Truth truth = truthSource(scene.scene, scene.camera, scene.width, scene.height);
    const std::string picture = scene.key + "_truth";
    events.picture(picture, truth.image);
    json entry = SceneMeasurement(context, scene, effort, events).run(truth);
    entry["truth"] = {{"method", truth.method},
                      {"picture", picture},
                      {"standard_error", truth.standardError},
                      {"seconds", truth.seconds},
                      {"note", truth.note}};
    return entry;
}

json knobsJson() {
    json knobs = json::array();
    for (const Knob& knob : knobTable())
        knobs.push_back({{"name", knob.name},
                         {"title", knob.title},
                         {"values", knob.values},
                         {"unit", ""},
                         {"description", knob.help}});
    return knobs;
}

}  // namespace lobe::measure
