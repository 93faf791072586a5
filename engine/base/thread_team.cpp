#include "base/thread_team.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace lobe {

struct ThreadTeam::State {
    std::mutex mutex;
    std::condition_variable begun, done;
    const std::function<void(size_t)>* job = nullptr;
    size_t count = 0;
    std::atomic<size_t> next = 0;
    size_t loop = 0;     // counts loops
    size_t working = 0;  // threads that have not finished the loop
    bool ending = false;
    std::exception_ptr failure;
    std::vector<std::jthread> threads;

    /// Also when a thread could not be started: those before it wait.
    ~State() {
        {
            const std::lock_guard lock(mutex);
            ending = true;
        }
        begun.notify_all();
        threads.clear();
    }

    void share() {
        for (size_t i = next++; i < count; i = next++) {
            try {
                (*job)(i);
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (!failure) failure = std::current_exception();
                next = count;
            }
        }
    }

    void work() {
        for (size_t last = 0;;) {
            {
                std::unique_lock lock(mutex);
                begun.wait(lock, [&] { return ending || loop != last; });
                if (ending) return;
                last = loop;
            }
            share();
            const std::lock_guard lock(mutex);
            if (--working == 0) done.notify_one();
        }
    }
};

ThreadTeam::ThreadTeam(unsigned threads) : state_(std::make_unique<State>()) {
    if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
    for (unsigned i = 1; i < threads; ++i)
        state_->threads.emplace_back([state = state_.get()] { state->work(); });
}

ThreadTeam::~ThreadTeam() = default;

void ThreadTeam::each(size_t count, const std::function<void(size_t)>& job) {
    State& state = *state_;
    {
        const std::lock_guard lock(state.mutex);
        state.job = &job;
        state.count = count;
        state.next = 0;
        state.failure = nullptr;
        state.working = state.threads.size();
        ++state.loop;
    }
    state.begun.notify_all();
    state.share();
    std::unique_lock lock(state.mutex);
    state.done.wait(lock, [&] { return state.working == 0; });
    if (state.failure) std::rethrow_exception(state.failure);
}

}  // namespace lobe
