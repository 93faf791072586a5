#pragma once

#include <exception>
#include <functional>
#include <thread>

namespace lobe::app {

/// Work on a thread of its own. What it throws is kept for the thread that waits for it.
class Stage {
public:
    /// `ended` runs when the work is over, whichever way, so that neighbours can stop waiting for it.
    Stage(std::function<void()> work, std::function<void()> ended)
        : thread_([this, work = std::move(work), ended = std::move(ended)] {
              try {
                  work();
              } catch (...) {
                  failure_ = std::current_exception();
              }
              ended();
          }) {}

    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// Waits, and throws what the work threw.
    void finish() {
        thread_.join();
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    std::exception_ptr failure_;
    std::jthread thread_;  // joins before the failure goes
};

}  // namespace lobe::app
