/// Loads scenes on a thread of its own: what is shown stays in use meanwhile.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "scene/load.hpp"
#include "shots.hpp"

namespace lobe::view {

struct LoadRequest {
    std::filesystem::path file;
    LoadOptions options;
    std::vector<app::SettingLayer> layers;  ///< of a batch file, handed through
    bool again = false;                     ///< the same scene under other settings
};

struct LoadResult {
    LoadRequest request;
    std::shared_ptr<const Scene> scene;
    std::string error;  ///< why there is none; else empty
};

class SceneLoading {
public:
    explicit SceneLoading(std::function<void()> wake);
    ~SceneLoading();
    SceneLoading(const SceneLoading&) = delete;
    SceneLoading& operator=(const SceneLoading&) = delete;

    void load(LoadRequest request);  ///< takes the place of one that has not been begun
    std::optional<LoadResult> take();
    std::string loading() const;  ///< the file, or empty

private:
    void run();
    std::function<void()> wake_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<LoadRequest> request_;
    std::optional<LoadResult> result_;
    std::string loading_;
    bool ended_ = false;
    std::thread thread_;
};

}  // namespace lobe::view
