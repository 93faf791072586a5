#include "pipeline.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <future>
#include <thread>

#include "base/error.hpp"
#include "bounded_queue.hpp"
#include "image/image_files.hpp"
#include "image/tone.hpp"
#include "record.hpp"
#include "scene/load.hpp"
#include "shot_scene.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

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
        outcome.message = outcome.shot.scene.string() + ": " + error.what();
    }
}

/// A shot on its way through the threads.
struct Job {
    Outcome outcome;
    std::shared_ptr<const Scene> scene;
    nlohmann::json record;
    Image image;
};

/// Keeps the scenes used last: shots of one scene load it once.
class SceneCache {
public:
    std::shared_ptr<const Scene> get(const Shot& shot) {
        const LoadOptions options = loadOptionsOf(shot.settings);
        const nlohmann::json key = {fs::absolute(shot.scene).string(), options.time, shot.settings.get("normals"),
                                    shot.settings.get("brdf"), needsCameraForLight(shot) ? shot.settings.toJson() : nlohmann::json()};
        for (const Entry& entry : entries_)
            if (entry.key == key) return entry.scene;
        const auto base = std::make_shared<const Scene>(loader_.load(shot.scene, options));
        const auto scene = preparedScene(base, shot.settings);
        if (entries_.size() == kEntries) entries_.erase(entries_.begin());
        entries_.push_back({key, scene});
        return scene;
    }

private:
    /// A scene without lights gets one that is placed by the camera: another camera makes another scene.
    static bool needsCameraForLight(const Shot& shot) {
        return !shot.settings.get("camera").is_null() || !shot.settings.get("camera_position").is_null() ||
               !shot.settings.get("camera_azimuth").is_null() || !shot.settings.get("camera_elevation").is_null();
    }
    static constexpr size_t kEntries = 3;
    struct Entry {
        nlohmann::json key;
        std::shared_ptr<const Scene> scene;
    };
    SceneLoader loader_;
    std::vector<Entry> entries_;
};

/// The loading thread's work for one shot.
void load(Job& job, SceneCache& scenes, ImageFiles* files, const gl::ContextInfo& context) {
    attempt(job.outcome, [&] {
        const auto start = Clock::now();
        job.scene = scenes.get(job.outcome.shot);
        job.outcome.loadMs = millisecondsSince(start);
        job.outcome.warnings = job.scene->warnings;
        job.record = recordOf(job.outcome.shot, *job.scene, context);
        const fs::path output = job.outcome.shot.output;
        std::error_code ignored;
        if (files == nullptr || !fs::exists(output, ignored)) return;
        try {
            job.outcome.skipped = recordIn(files->readMetadata(output), output.string()) == job.record;
        } catch (const InputError&) {
            job.outcome.skipped = false;  // damaged or not ours: made again
        }
    });
}

/// Draws a shot. The renderer keeps the scene and its uploads while they stay the same.
class Drawer {
public:
    Drawer(gl::Context& context, bool timePasses) : renderer_(context), timePasses_(timePasses) {}

    void draw(Job& job) {
        attempt(job.outcome, [&] {
            const Shot& shot = job.outcome.shot;
            RenderOptions options = renderOptionsOf(shot.settings);
            options.timePasses = timePasses_;
            const auto start = Clock::now();
            if (job.scene != scene_ || options != options_) {
                scene_.reset();  // stays unset if setting it fails
                renderer_.setScene(job.scene, options);
                scene_ = job.scene;
                options_ = options;
                job.outcome.uploadMs = millisecondsSince(start);
            }
            const Camera camera = cameraOf(*job.scene, shot.settings, shot.frame);
            job.outcome.camera = camera.name;
            Picture picture = renderer_.render(camera);
            job.outcome.renderMs = picture.milliseconds;
            job.outcome.passes = std::move(picture.passTimes);
            job.image = std::move(picture.image);
        });
    }

private:
    Renderer renderer_;
    bool timePasses_;
    std::shared_ptr<const Scene> scene_;
    RenderOptions options_;
};

bool isConstant(const Image& image) {
    const size_t count = image.channelCount();
    for (size_t i = count; i < image.values.size(); ++i)
        if (image.values[i] != image.values[i % count]) return false;
    return true;
}

void copyToStandardOutput(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0)
        throw OutputError("standard output: cannot be written");
}

void writePicture(const Job& job, const fs::path& file, ImageFiles& files) {
    const Settings& settings = job.outcome.shot.settings;
    WriteOptions options;
    options.metadata = metadataOf(job.record);
    options.exrPrecision = settings.get("exr_precision") == "half" ? ExrPrecision::half : ExrPrecision::single;
    options.jpegQuality = settings.get("jpeg_quality").get<int>();
    const auto& linear = ImageFiles::linearExtensions();
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (std::find(linear.begin(), linear.end(), extension) != linear.end()) return files.write(file, job.image, options);
    const Background background = backgroundOf(settings);
    const bool keepAlpha = background.transparent && extension == ".png";
    files.write(file, toDisplay(job.image, static_cast<float>(settings.get("exposure").get<double>()), toneMappingOf(settings), keepAlpha, background.color),
                options);
}

/// The encoding thread's work for one shot.
void encode(Job& job, ImageFiles& files) {
    attempt(job.outcome, [&] {
        const auto start = Clock::now();
        const std::string& output = job.outcome.shot.output;
        job.outcome.nonFinite = countNonFinite(job.image);
        if (isConstant(job.image))
            job.outcome.warnings.push_back(output + ": every pixel has the same value; does the camera see the scene, and is it lit?");
        if (output != "-") {
            writePicture(job, output, files);
        } else {
            const fs::path temporary = fs::temp_directory_path() / ("lobe-" + std::to_string(getpid()) + ".png");
            writePicture(job, temporary, files);
            copyToStandardOutput(temporary);
            fs::remove(temporary);
        }
        job.outcome.encodeMs = millisecondsSince(start);
    });
}

}  // namespace

void runShots(const std::vector<Shot>& shots, const PipelineOptions& options, Reporter& reporter,
              const std::atomic<bool>& interrupted) {
    BoundedQueue<Job> loaded(2), drawn(3);
    std::promise<gl::ContextInfo> contextPromise;
    std::shared_future<gl::ContextInfo> contextInfo = contextPromise.get_future().share();

    std::jthread loading([&] {
        SceneCache scenes;  // starts its workers, which load their libraries while the context is made
        try {
            const gl::ContextInfo context = contextInfo.get();
            const auto files = options.resume ? std::make_unique<ImageFiles>() : nullptr;
            for (const Shot& shot : shots) {
                Job job;
                job.outcome.shot = shot;
                load(job, scenes, files.get(), context);
                if (!loaded.push(std::move(job))) break;
            }
        } catch (const Error&) {
            // No context: the caller's thread reports it.
        }
        loaded.close();
    });
    std::unique_ptr<gl::Context> context;
    try {
        context = gl::Context::create(options.context);
    } catch (...) {
        contextPromise.set_exception(std::current_exception());
        throw;
    }
    contextPromise.set_value(context->info());
    reporter.setContext(context->info().backend + " " + context->info().platform, context->info().renderer);

    std::jthread encoding([&] {
        ImageFiles files;
        while (auto job = drawn.pop()) {
            encode(*job, files);
            reporter.add(job->outcome);
        }
    });
    {
        Drawer drawer(*context, options.timePasses);
        while (auto job = loaded.pop()) {
            drawer.draw(*job);
            job->scene.reset();
            drawn.push(std::move(*job));
            if (interrupted) break;
        }
    }
    loaded.close();
    drawn.close();
    encoding.join();
    loading.join();
}

}  // namespace lobe::app
