#include "truth_worker.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "shot_scene.hpp"

namespace lobe::view {
namespace {

constexpr int kFirstPart = 4;  ///< of width and height
constexpr double kRounds[] = {0.2, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};

}  // namespace

TruthWorker::TruthWorker(std::function<void()> wake) : wake_(std::move(wake)), thread_([this] { run(); }) {}

TruthWorker::~TruthWorker() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
        stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void TruthWorker::start(const TruthSubject& subject) {
    {
        const std::lock_guard lock(mutex_);
        subject_ = subject;
        next_ = subject;
        state_ = {};
        state_.running = true;
        stop_ = true;  // of the one in work
    }
    changed_.notify_all();
}

void TruthWorker::stop() {
    const std::lock_guard lock(mutex_);
    subject_ = {};
    next_.reset();
    state_ = {};
    stop_ = true;
}

void TruthWorker::stopAndWait() {
    stop();
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !working_; });
}

TruthState TruthWorker::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

void TruthWorker::run() {
    for (;;) {
        TruthSubject subject;
        {
            std::unique_lock lock(mutex_);
            working_ = false;
            changed_.notify_all();
            changed_.wait(lock, [this] { return ended_ || next_; });
            if (ended_) return;
            subject = *next_;
            next_.reset();
            stop_ = false;
            working_ = true;
        }
        compute(subject);
    }
}

/// Nothing once another truth is wanted, whose state it is then.
void TruthWorker::change(const std::function<void(TruthState&)>& action) {
    {
        const std::lock_guard lock(mutex_);
        if (stop_) return;
        action(state_);
    }
    wake_();
}

void TruthWorker::compute(const TruthSubject& subject) {
    try {
        const std::shared_ptr<const Scene> scene =
            composedScene(subject.base, *subject.settings, subject.edits);
        for (const Material& material : scene->materials)
            if (const Brdf* brdf = findBrdf(material.brdf)) requireTwin(*brdf);
        const Camera camera = app::cameraOf(*subject.base, *subject.settings, 0);
        const RenderOptions options = app::renderOptionsOf(*subject.settings);
        reference::TruthRequest request;
        request.width = options.width;
        request.height = options.height;
        // What the picture is the mean of: one ray, or the pixel.
        request.options.filter =
            options.quality.samples > 1 ? reference::PixelFilter::box : reference::PixelFilter::point;
        request.options.shadows = app::truthHasShadows(*subject.settings);
        request.threads = std::max(1u, std::thread::hardware_concurrency() - 1);  // one is the window's
        const auto give = [&](std::shared_ptr<const Image> image, double error) {
            change([&](TruthState& state) {
                state.image = std::move(image);
                state.relativeError = error;
                ++state.rounds;
            });
        };
        const auto round = [&](double error, const Image* earlier) {
            request.relativeError = error;
            return reference::computeTruth(
                scene, camera, request, earlier, stop_,
                [&](const reference::TruthProgress& progress) {
                    change([&](TruthState& state) {
                        state.aim = error;
                        state.done = progress.done;
                    });
                },
                [](const Image&) {});
        };
        // A small one first, for something to look at.
        request.width = std::max(1, options.width / kFirstPart);
        request.height = std::max(1, options.height / kFirstPart);
        reference::TruthResult first = round(kRounds[0], nullptr);
        if (!stop_) give(std::make_shared<const Image>(std::move(first.image)), first.relativeError);
        request.width = options.width;
        request.height = options.height;
        std::shared_ptr<const Image> best;
        for (const double error : kRounds) {
            if (stop_) break;
            reference::TruthResult result = round(error, best.get());
            if (stop_) break;
            best = std::make_shared<const Image>(std::move(result.image));
            give(best, result.relativeError);
        }
    } catch (const std::exception& error) {
        change([&](TruthState& state) { state.error = error.what(); });
    }
    change([](TruthState& state) { state.running = false; });
}

}  // namespace lobe::view
