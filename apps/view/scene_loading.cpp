#include "scene_loading.hpp"

namespace lobe::view {

SceneLoading::SceneLoading(std::function<void()> wake) : wake_(std::move(wake)), thread_([this] { run(); }) {}

SceneLoading::~SceneLoading() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void SceneLoading::load(LoadRequest request) {
    {
        const std::lock_guard lock(mutex_);
        request_ = std::move(request);
    }
    changed_.notify_all();
}

std::optional<LoadResult> SceneLoading::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, {});
}

std::string SceneLoading::loading() const {
    const std::lock_guard lock(mutex_);
    return loading_;
}

void SceneLoading::run() {
    SceneLoader loader;
    for (;;) {
        LoadResult result;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return ended_ || request_; });
            if (ended_) return;
            result.request = std::move(*request_);
            request_.reset();
            loading_ = result.request.file.string();
        }
        try {
            result.scene =
                std::make_shared<const Scene>(loader.load(result.request.file, result.request.options));
        } catch (const std::bad_alloc&) {
            result.error = result.request.file.string() + ": does not fit into memory";
        } catch (const std::exception& error) {
            result.error = error.what();
        }
        {
            const std::lock_guard lock(mutex_);
            result_ = std::move(result);
            loading_.clear();
        }
        wake_();
    }
}

}  // namespace lobe::view
