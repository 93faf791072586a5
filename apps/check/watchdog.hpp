#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>

#include "base/error.hpp"

namespace lobe::app {

/// Ends the program when the driver has been at one batch of rows for too long: GLSL can loop forever, and
/// OpenGL has no way to stop it. Nothing has been written by then.
class Watchdog {
public:
    /// `what` is for the message, the limit in seconds.
    Watchdog(std::string what, double limit)
        : what_(std::move(what)), limit_(limit), thread_([this] { watch(); }) {}
    ~Watchdog() {
        {
            const std::lock_guard lock(mutex_);
            ended_ = true;
        }
        changed_.notify_one();
        thread_.join();
    }
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

    void start() { set(true); }
    void stop() { set(false); }

private:
    void set(bool running) {
        {
            const std::lock_guard lock(mutex_);
            running_ = running;
            ++turn_;
        }
        changed_.notify_one();
    }

    void watch() {
        std::unique_lock lock(mutex_);
        while (!ended_) {
            if (!running_) {
                changed_.wait(lock);
                continue;
            }
            const uint64_t turn = turn_;
            const auto moved = [&] { return ended_ || turn_ != turn; };
            if (changed_.wait_for(lock, std::chrono::duration<double>(limit_), moved)) continue;
            std::fprintf(stderr,
                         "lobe-check: error: %s: no result after %g s (--time-limit); an endless loop?\n",
                         what_.c_str(), limit_);
            std::_Exit(static_cast<int>(ExitCode::checkFailed));
        }
    }

    std::string what_;
    double limit_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool running_ = false, ended_ = false;
    uint64_t turn_ = 0;
    std::thread thread_;
};

}  // namespace lobe::app
