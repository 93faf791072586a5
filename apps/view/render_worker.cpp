#include "render_worker.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>

#include "base/error.hpp"
#include "picture_writer.hpp"
#include "record.hpp"
#include "scene/load.hpp"
#include "thumbnail_store.hpp"

namespace lobe::view {
namespace {

constexpr double kMovingMs = 50.0;  ///< of 1000 / 15, the rest being the window's own
constexpr double kLeastScale = 0.125, kScaleStep = 0.0625;

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Runs `action`; what it throws becomes a line.
template<class Action>
std::string errorOf(Action action) {
    try {
        action();
    } catch (const std::bad_alloc&) {
        return "out of memory";
    } catch (const std::exception& error) {
        return error.what();
    }
    return {};
}

}  // namespace

struct RenderWorker::Tools {
    std::unique_ptr<gl::Context> context;
    std::unique_ptr<PictureMaker> main, other, small;
    SceneLoader loader;  ///< of scenes for thumbnails
    ImageFiles files;
    ThumbnailStore store;
};

RenderWorker::RenderWorker(const gl::ContextRequest& context, std::function<void()> wake)
    : wake_(std::move(wake)) {
    std::promise<void> promise;
    std::future<void> started = promise.get_future();
    thread_ = std::thread([this, context, &promise] {
        run(context, [&promise](const std::exception_ptr& failure) {
            if (failure)
                promise.set_exception(failure);
            else
                promise.set_value();
        });
    });
    try {
        started.get();
    } catch (...) {
        thread_.join();
        throw;
    }
}

RenderWorker::~RenderWorker() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
        stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void RenderWorker::run(const gl::ContextRequest& request, std::function<void(std::exception_ptr)> started) {
    Tools tools;
    try {
        tools.context = gl::Context::create(request);
        info_ = tools.context->info();
        if (info_.software) movingScale_ = 0.375;
    } catch (...) {
        started(std::current_exception());
        return;
    }
    started(nullptr);
    while (next(tools)) {
    }
    tools.main.reset();
    tools.other.reset();
    tools.small.reset();
}

bool RenderWorker::next(Tools& tools) {
    std::function<void()> job;
    {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] {
            return ended_ || reload_ || main_ || other_ || !saves_.empty() || !thumbnails_.empty();
        });
        if (ended_) return false;
        stop_ = false;
        atMoving_ = false;
        const auto taken = [](auto& slot) {
            auto value = std::move(*slot);
            slot.reset();
            return value;
        };
        const auto first = [](auto& queue) {
            auto value = std::move(queue.front());
            queue.pop_front();
            return value;
        };
        if (std::exchange(reload_, false)) {
            job = [&] { reloadAll(tools); };
        } else if (main_) {
            atMoving_ = main_->moving;
            job = [&, request = taken(main_)] { drawMain(tools, request); };
        } else if (!saves_.empty()) {
            job = [&, request = first(saves_)] { write(tools, request); };
        } else if (other_) {
            job = [&, request = taken(other_)] { drawSecond(tools, request); };
        } else {
            job = [&, request = first(thumbnails_)] { drawSmall(tools, request); };
        }
    }
    const std::lock_guard working(working_);
    job();
    setStatus("");
    return true;
}

void RenderWorker::setStatus(const std::string& text) {
    {
        const std::lock_guard lock(mutex_);
        if (text == status_) return;
        status_ = text;
        statusSince_ = now();
        if (text.empty()) compiled_ = 0;
    }
    wake_();
}

std::pair<std::string, double> RenderWorker::status() const {
    const std::lock_guard lock(mutex_);
    return {status_, status_.empty() ? 0.0 : now() - statusSince_};
}

void RenderWorker::give(WorkerEvent event) {
    {
        const std::lock_guard lock(mutex_);
        events_.push_back(std::move(event));
    }
    wake_();
}

std::vector<WorkerEvent> RenderWorker::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(events_, {});
}

void RenderWorker::draw(FrameRequest request) {
    {
        const std::lock_guard lock(mutex_);
        main_ = std::move(request);
        if (!atMoving_) stop_ = true;  // a picture while moving is soon done
    }
    changed_.notify_all();
}

void RenderWorker::drawOther(std::optional<FrameRequest> request) {
    {
        const std::lock_guard lock(mutex_);
        other_ = std::move(request);
    }
    changed_.notify_all();
}

void RenderWorker::save(SaveRequest request) {
    {
        const std::lock_guard lock(mutex_);
        saves_.push_back(std::move(request));
    }
    changed_.notify_all();
}

void RenderWorker::make(ThumbnailRequest request) {
    {
        const std::lock_guard lock(mutex_);
        thumbnails_.push_back(std::move(request));
    }
    changed_.notify_all();
}

void RenderWorker::forgetThumbnails() {
    const std::lock_guard lock(mutex_);
    thumbnails_.clear();
}

void RenderWorker::reload() {
    {
        const std::lock_guard lock(mutex_);
        reload_ = true;
        stop_ = true;
    }
    changed_.notify_all();
}

void RenderWorker::whileIdle(const std::function<void()>& action) {
    stop_ = true;
    const std::lock_guard working(working_);
    action();
}

void RenderWorker::reloadAll(Tools& tools) {
    setStatus("compiling");
    const std::string error = errorOf([&] {
        if (tools.main) tools.main->reload();
    });
    // Made afresh when they are needed.
    tools.other.reset();
    tools.small.reset();
    give(
        Notice{error.empty() ? "shaders reloaded" : "shaders not reloaded, the last good ones stay: " + error,
               !error.empty()});
}

namespace {

PictureMaker& madeIn(std::unique_ptr<PictureMaker>& maker, gl::Context& context,
                     const std::function<void(const std::string&)>& compiling) {
    if (!maker) maker = std::make_unique<PictureMaker>(context, compiling);
    return *maker;
}

}  // namespace

/// The largest size at which pictures come often enough, from what the last ones took.
void RenderWorker::adapt(const Frame& frame) {
    const double pixels = static_cast<double>(frame.image.pixelCount());
    const double whole = static_cast<double>(frame.width) * frame.height;
    const double share = msPerPixel_ > 0.0 ? 0.2 : 1.0;  // of the latest
    setMs_ += share * (frame.setMs - setMs_);
    msPerPixel_ += share * (frame.drawMs / pixels - msPerPixel_);
    const double room = std::max(kMovingMs - setMs_, 0.2 * kMovingMs);
    const double wanted = std::clamp(std::sqrt(room / (msPerPixel_ * whole)), kLeastScale, 1.0);
    // In steps, so that the size does not change with each picture.
    if (std::abs(wanted - movingScale_) > kScaleStep)
        movingScale_ = std::round(wanted / kScaleStep) * kScaleStep;
}

void RenderWorker::drawMain(Tools& tools, const FrameRequest& request) {
    setStatus("drawing");
    const auto compiling = [this](const std::string& name) {
        int number;
        {
            const std::lock_guard lock(mutex_);
            number = ++compiled_;
        }
        setStatus("compiling program " + std::to_string(number) + ": " + name.substr(0, name.find(' ')));
    };
    const double scale = request.moving ? movingScale_ : 1.0;
    std::optional<Frame> frame;
    const std::string error = errorOf([&] {
        const std::atomic<bool> never = false;  // pictures while moving are always shown
        frame = madeIn(tools.main, *tools.context, compiling)
                    .make(request, scale, request.moving ? never : stop_);
    });
    if (!error.empty()) {
        Frame failed;
        failed.number = request.number;
        failed.moving = request.moving;
        failed.error = error;
        return give(MainFrame{std::move(failed)});
    }
    if (!frame) return;  // a newer one is asked for
    if (request.moving) adapt(*frame);
    give(MainFrame{std::move(*frame)});
}

void RenderWorker::drawSecond(Tools& tools, const FrameRequest& request) {
    setStatus("drawing the other picture");
    std::optional<Frame> frame;
    const std::string error = errorOf([&] {
        frame = madeIn(tools.other, *tools.context, [this](const std::string& name) {
                    setStatus("compiling for the other picture: " + name.substr(0, name.find(' ')));
                }).make(request, 1.0, stop_);
    });
    if (!error.empty()) {
        Frame failed;
        failed.number = request.number;
        failed.error = error;
        return give(OtherFrame{std::move(failed)});
    }
    if (frame) return give(OtherFrame{std::move(*frame)});
    const std::lock_guard lock(mutex_);
    if (!other_) other_ = request;  // after what was more urgent
}

void RenderWorker::write(Tools& tools, const SaveRequest& request) {
    setStatus("writing " + request.output.filename().string());
    const std::string name = request.output.string();
    const std::string error = errorOf([&] {
        FrameRequest whole = request.frame;
        whole.toFile = true;
        whole.moving = false;
        const std::atomic<bool> never = false;
        PictureMaker& maker = madeIn(tools.main, *tools.context, {});
        const std::optional<Frame> frame = maker.make(whole, 1.0, never);
        const app::Shot shot{whole.file, whole.settings, 1, 0, name};
        // What was edited is in no setting: such a picture has no record from which it could be made again.
        std::map<std::string, std::string> metadata =
            app::metadataOf(app::recordOf(shot, maker.scene(), frame->camera, info_));
        if (!whole.edits.empty()) metadata.erase(app::kRecordKey);
        if (request.output.has_parent_path())
            std::filesystem::create_directories(request.output.parent_path());
        app::writePicture(shot, frame->image, metadata, tools.files);
    });
    give(error.empty() ? Notice{"wrote " + name, false} : Notice{name + ": " + error, true});
}

void RenderWorker::drawSmall(Tools& tools, const ThumbnailRequest& request) {
    Thumbnail made{request.key, {}, {}};
    bool interrupted = false;
    made.error = errorOf([&] {
        FrameRequest frame = request.frame;
        const bool fromFile = frame.base == nullptr;
        if (fromFile) {
            made.bitmap = tools.store.find(frame.file, tools.files);
            if (!made.bitmap.data.empty()) return;
            setStatus("drawing " + frame.file.filename().string() + " for the gallery");
            frame.base = std::make_shared<const Scene>(
                tools.loader.load(frame.file, app::loadOptionsOf(*frame.settings)));
        } else {
            setStatus("drawing " + request.key);
        }
        std::optional<Frame> drawn = madeIn(tools.small, *tools.context, {}).make(frame, 1.0, stop_);
        interrupted = !drawn;
        if (!drawn) return;
        made.bitmap = std::move(drawn->display.bitmap);
        if (fromFile) tools.store.keep(frame.file, made.bitmap, tools.files);
    });
    if (!interrupted) return give(std::move(made));
    const std::lock_guard lock(mutex_);
    thumbnails_.push_front(request);
}

}  // namespace lobe::view
