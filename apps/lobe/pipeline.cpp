#include "pipeline.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <future>
#include <sstream>

#include "base/error.hpp"
#include "bounded_queue.hpp"
#include "in_order.hpp"
#include "picture_writer.hpp"
#include "record.hpp"
#include "scene_cache.hpp"
#include "shot_scene.hpp"
#include "stage.hpp"
#include "watchdog.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using ContextFuture = std::shared_future<gl::ContextInfo>;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Runs a step of a shot; what it throws becomes the shot's error.
template<class Step>
void attempt(Outcome& outcome, Step step) {
    if (outcome.error || outcome.skipped) return;
    try {
        step();
    } catch (const Error& error) {
        outcome.error = error.exitCode();
        outcome.message = error.what();
    } catch (const std::bad_alloc&) {
        outcome.error = ExitCode::unreadableInput;
        outcome.message = outcome.shot.scene.string() + ": does not fit into memory";
    } catch (const std::exception& error) {
        outcome.error = ExitCode::checkFailed;
        outcome.message = outcome.shot.scene.string() + ": unexpected: " + error.what();
    }
}

/// A shot on its way through the threads.
struct Job {
    size_t number = 0;
    Outcome outcome;
    std::shared_ptr<const Scene> scene;
    Camera camera;
    nlohmann::json record;
    Image image;
};

/// The loading thread.
class Loading {
public:
    Loading(const PipelineOptions& options, ContextFuture context)
        : options_(options), context_(std::move(context)) {
        if (options.resume) files_ = std::make_unique<ImageFiles>();
    }

    void load(Job& job) {
        Outcome& outcome = job.outcome;
        attempt(outcome, [&] {
            const auto start = Clock::now();
            job.scene = scenes_.get(outcome.shot);
            outcome.loadMs = millisecondsSince(start);
            for (const std::string& warning : job.scene->warnings)
                outcome.warnings.push_back(job.scene->file + ": " + warning);
            job.camera = cameraOf(*job.scene, *outcome.shot.settings, outcome.shot.frame);
            outcome.camera = job.camera.name;
        });
        const gl::ContextInfo& context = context_.get();  // outside: no context is no fault of the shot
        attempt(outcome, [&] {
            job.record = recordOf(outcome.shot, *job.scene, job.camera, context);
            if (options_.reproduced != nullptr)
                for (const std::string& line : differences(*options_.reproduced, job.record))
                    outcome.warnings.push_back(line);
            outcome.skipped = files_ && isThere(job);
        });
    }

private:
    bool isThere(const Job& job) {
        const fs::path output = job.outcome.shot.output;
        std::error_code ignored;
        if (!fs::exists(output, ignored)) return false;
        try {
            return recordIn(files_->readMetadata(output), output.string()) == job.record;
        } catch (const InputError&) {
            return false;  // damaged or not ours: made again
        }
    }

    const PipelineOptions& options_;
    ContextFuture context_;
    SceneCache scenes_;  // starts its workers, which load their libraries while the context is made
    std::unique_ptr<ImageFiles> files_;
};

/// Draws shots. The renderer keeps the scene and its uploads while they stay the same.
class Drawer {
public:
    Drawer(gl::Context& context, bool timePasses) : renderer_(context), timePasses_(timePasses) {}

    void draw(Job& job) {
        attempt(job.outcome, [&] {
            RenderOptions options = renderOptionsOf(*job.outcome.shot.settings);
            options.timePasses = timePasses_;
            const auto start = Clock::now();
            if (job.scene != scene_ || options != options_) {
                scene_.reset();  // stays unset if setting it fails
                renderer_.setScene(job.scene, options);
                scene_ = job.scene;
                options_ = options;
                job.outcome.uploadMs = millisecondsSince(start);
            }
            Picture picture = renderer_.render(job.camera);
            job.outcome.renderMs = picture.milliseconds;
            job.outcome.passes = std::move(picture.passTimes);
            job.image = std::move(picture.image);
            for (const std::string& warning : picture.warnings)
                job.outcome.warnings.push_back(job.outcome.shot.output + ": " + warning);
        });
        job.scene.reset();
    }

private:
    Renderer renderer_;
    bool timePasses_;
    std::shared_ptr<const Scene> scene_;
    RenderOptions options_;
};

/// An encoding thread's work for one shot.
void encode(Job& job, ImageFiles& files) {
    attempt(job.outcome, [&] {
        const auto start = Clock::now();
        const Shot& shot = job.outcome.shot;
        job.outcome.nonFinite = countNonFinite(job.image);
        if (isConstant(job.image))
            job.outcome.warnings.push_back(
                shot.output +
                ": every pixel has the same colour; does the camera see the scene, and is it lit?");
        writePicture(shot, job.image, metadataOf(job.record), files);
        job.outcome.encodeMs = millisecondsSince(start);
    });
    job.image = {};
}

/// What becomes of a shot whose drawing did not end.
Outcome overdue(const Shot& shot, double seconds) {
    Outcome outcome;
    outcome.shot = shot;
    outcome.error = ExitCode::shader;
    std::ostringstream message;
    message << shot.output << ": not drawn after " << seconds << " s (--time-limit); an endless loop in "
            << shot.settings->get("brdf_file").dump() << "?";
    outcome.message = message.str();
    return outcome;
}

/// How many pictures may wait to be encoded: few, and fewer of the large ones.
size_t picturesInFlight(const std::vector<Shot>& shots) {
    constexpr size_t kBudget = size_t{1} << 30;
    constexpr size_t kChannelsEach = 4;
    size_t largest = 1;
    const Settings* last = nullptr;
    for (const Shot& shot : shots) {
        if (shot.settings.get() == last) continue;
        last = shot.settings.get();
        const RenderOptions options = renderOptionsOf(*last);
        const size_t pixels = static_cast<size_t>(options.width) * static_cast<size_t>(options.height);
        largest = std::max(largest, pixels * options.aovs.size() * kChannelsEach * sizeof(float));
    }
    return std::clamp<size_t>(kBudget / largest, 1, 8);
}

size_t encoderCount(size_t inFlight) {
    // A software rasteriser wants the cores for itself; half of them keeps up with a hardware one.
    return std::clamp<size_t>(std::thread::hardware_concurrency() / 2, 1, inFlight);
}

}  // namespace

void runShots(const std::vector<Shot>& shots, const PipelineOptions& options, Reporter& reporter,
              const std::atomic<bool>& interrupted) {
    const size_t inFlight = std::min(picturesInFlight(shots), shots.size());
    BoundedQueue<Job> loaded(2), drawn(inFlight);
    InOrder<Outcome> outcomes([&](const Outcome& outcome) { reporter.add(outcome); });
    std::promise<gl::ContextInfo> contextPromise;
    const ContextFuture contextInfo = contextPromise.get_future().share();

    Stage loading(
        [&] {
            Loading loader(options, contextInfo);
            for (size_t i = 0; i < shots.size(); ++i) {
                Job job;
                job.number = i;
                job.outcome.shot = shots[i];
                loader.load(job);
                if (!loaded.push(std::move(job))) break;
            }
        },
        [&] { loaded.close(); });
    std::deque<Stage> encoding;
    // Whatever goes wrong below, nobody waits for a value that will not come.
    const std::unique_ptr<void, std::function<void(void*)>> closer(&loaded, [&](void*) {
        loaded.close();
        drawn.close();
    });

    std::unique_ptr<gl::Context> context;
    try {
        for (size_t i = 0; i < encoderCount(inFlight); ++i)
            encoding.emplace_back(
                [&] {
                    ImageFiles files;  // its helper program starts while the context is made
                    while (auto job = drawn.pop()) {
                        encode(*job, files);
                        outcomes.add(job->number, std::move(job->outcome));
                    }
                },
                [&] { drawn.close(); });
        context = gl::Context::create(options.context);
        reporter.setContext(context->info().backend + " " + context->info().platform,
                            context->info().renderer);
    } catch (...) {
        contextPromise.set_exception(std::current_exception());
        throw;
    }
    contextPromise.set_value(context->info());
    {
        Drawer drawer(*context, options.timePasses);
        std::pair<size_t, Shot> drawing;  // read by the watchdog while a picture is drawn
        std::optional<Watchdog> watchdog;
        if (options.drawLimit)
            watchdog.emplace(*options.drawLimit, [&] {
                drawn.close();
                for (Stage& stage : encoding)
                    stage.finish();
                Outcome outcome = overdue(drawing.second, *options.drawLimit);
                outcomes.add(drawing.first, std::move(outcome));
                const ExitCode code = reporter.finish(true);
                std::fflush(nullptr);
                std::_Exit(static_cast<int>(code));
            });
        while (auto job = loaded.pop()) {
            drawing = {job->number, job->outcome.shot};
            if (watchdog) watchdog->start();
            drawer.draw(*job);
            if (watchdog) watchdog->stop();
            if (!drawn.push(std::move(*job)) || interrupted) break;
        }
    }
    loaded.close();
    drawn.close();
    for (Stage& stage : encoding)
        stage.finish();
    loading.finish();
}

}  // namespace lobe::app
