#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <mutex>

namespace lobe::app {

/// Takes values from many threads in any order and hands them on one at a time, in the order of their numbers
/// from 0.
template<class T>
class InOrder {
public:
    explicit InOrder(std::function<void(const T&)> take) : take_(std::move(take)) {}

    void add(size_t number, T value) {
        const std::lock_guard lock(mutex_);
        waiting_.emplace(number, std::move(value));
        for (auto first = waiting_.begin(); first != waiting_.end() && first->first == next_;
             first = waiting_.begin()) {
            const auto taken = waiting_.extract(first);
            ++next_;
            take_(taken.mapped());
        }
    }

private:
    std::mutex mutex_;
    std::function<void(const T&)> take_;
    std::map<size_t, T> waiting_;
    size_t next_ = 0;
};

}  // namespace lobe::app
