/// What has happened, for people to read, the latest last.
#pragma once

#include <deque>
#include <string>

namespace lobe::view {

struct Message {
    std::string text;
    bool isError = false;
    double time = 0.0;  ///< seconds since the start
};

class Messages {
public:
    void add(const std::string& text, bool isError, double time) {
        // What is said again and again is said once.
        if (!list_.empty() && list_.back().text == text && list_.back().isError == isError) {
            list_.back().time = time;
            return;
        }
        list_.push_back({text, isError, time});
        if (list_.size() > kMost) list_.pop_front();
    }
    const std::deque<Message>& list() const { return list_; }
    void clear() { list_.clear(); }

private:
    static constexpr size_t kMost = 500;
    std::deque<Message> list_;
};

}  // namespace lobe::view
