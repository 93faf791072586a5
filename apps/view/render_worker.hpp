/// The thread that draws, on a context of its own: the same as the batch tool's, so that pictures are the
/// same, and nothing that takes long there keeps the window from answering.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "frame.hpp"
#include "picture_maker.hpp"

namespace lobe::view {

/// A small picture of a scene, or of the present one under other settings.
struct ThumbnailRequest {
    std::string key;     ///< under which it is asked for and given
    FrameRequest frame;  ///< without `base`: loaded from its file, and kept on disk
};

struct Thumbnail {
    std::string key;
    Bitmap bitmap;
    std::string error;  ///< why there is none; else empty
};

/// A picture to write, in the format of its name.
struct SaveRequest {
    FrameRequest frame;
    std::filesystem::path output;
};

struct Notice {
    std::string text;
    bool isError = false;
};

/// What has been done. The second frame is that to compare with.
struct MainFrame {
    Frame frame;
};
struct OtherFrame {
    Frame frame;
};
using WorkerEvent = std::variant<MainFrame, OtherFrame, Thumbnail, Notice>;

class RenderWorker {
public:
    /// `wake` is called from the thread whenever there is something to take. Throws ContextError.
    RenderWorker(const gl::ContextRequest& context, std::function<void()> wake);
    ~RenderWorker();
    RenderWorker(const RenderWorker&) = delete;
    RenderWorker& operator=(const RenderWorker&) = delete;

    void draw(FrameRequest request);  ///< takes the place of one that has not been begun
    void drawOther(std::optional<FrameRequest> request);
    void save(SaveRequest request);
    void make(ThumbnailRequest request);
    void forgetThumbnails();  ///< those that have not been begun
    void reload();            ///< all shaders, from their files

    /// Runs `action` while nothing is drawn: it may change the registry of models.
    void whileIdle(const std::function<void()>& action);

    std::vector<WorkerEvent> take();
    /// "compiling pass/light.frag (3)", "drawing", or empty; and for how long, in seconds.
    std::pair<std::string, double> status() const;
    const gl::ContextInfo& info() const { return info_; }

private:
    struct Tools;
    void run(const gl::ContextRequest& context, std::function<void(std::exception_ptr)> started);
    bool next(Tools& tools);  ///< false at the end
    void adapt(const Frame& frame);
    void drawMain(Tools& tools, const FrameRequest& request);
    void drawSecond(Tools& tools, const FrameRequest& request);
    void write(Tools& tools, const SaveRequest& request);
    void drawSmall(Tools& tools, const ThumbnailRequest& request);
    void reloadAll(Tools& tools);
    void give(WorkerEvent event);
    void setStatus(const std::string& text);

    std::function<void()> wake_;
    gl::ContextInfo info_;
    std::atomic<bool> stop_ = false;
    double movingScale_ = 1.0;  ///< the drawing thread's, as are the costs of pictures while moving
    double setMs_ = 0.0, msPerPixel_ = 0.0;

    mutable std::mutex mutex_;  ///< of all that follows
    std::condition_variable changed_;
    std::optional<FrameRequest> main_, other_;
    std::deque<SaveRequest> saves_;
    std::deque<ThumbnailRequest> thumbnails_;
    std::vector<WorkerEvent> events_;
    bool reload_ = false, ended_ = false, atMoving_ = false;
    int compiled_ = 0;
    std::string status_;
    double statusSince_ = 0.0;

    std::mutex working_;  ///< held while a job is done
    std::thread thread_;
};

}  // namespace lobe::view
