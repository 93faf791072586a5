#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

namespace lobe::app {

/// Tells when the driver has been at one piece of work for too long: GLSL can loop forever, and OpenGL has no
/// way to stop it.
class Watchdog {
public:
    /// `overdue` runs on a thread of its own once `limit` seconds have passed after start() without stop().
    /// The thread that waits for the driver never comes back, so it has to end the program.
    Watchdog(double limit, std::function<void()> overdue)
        : limit_(limit), overdue_(std::move(overdue)), thread_([this] { watch(); }) {}
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
            lock.unlock();
            overdue_();
            lock.lock();
            running_ = false;
        }
    }

    double limit_;
    std::function<void()> overdue_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool running_ = false, ended_ = false;
    uint64_t turn_ = 0;
    std::thread thread_;
};

}  // namespace lobe::app
