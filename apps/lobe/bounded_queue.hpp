#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

namespace lobe::app {

/// Hands values from one thread to another; push waits while `capacity` are on their way.
template<class T>
class BoundedQueue {
public:
    explicit BoundedQueue(size_t capacity) : capacity_(capacity) {}

    /// Returns false, and drops the value, if the queue was closed.
    bool push(T value) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return values_.size() < capacity_ || closed_; });
        if (closed_) return false;
        values_.push_back(std::move(value));
        changed_.notify_all();
        return true;
    }
    /// Nothing when the queue is closed and empty.
    std::optional<T> pop() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return !values_.empty() || closed_; });
        if (values_.empty()) return {};
        T value = std::move(values_.front());
        values_.pop_front();
        changed_.notify_all();
        return value;
    }
    /// No more values will be pushed.
    void close() {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        changed_.notify_all();
    }

private:
    size_t capacity_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<T> values_;
    bool closed_ = false;
};

}  // namespace lobe::app
