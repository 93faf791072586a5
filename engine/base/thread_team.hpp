/// Threads that share out the jobs of one loop at a time.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace lobe {

/// Keeps its threads between loops: a loop of jobs of some 20 us is worth sharing out. For one caller at a
/// time.
class ThreadTeam {
public:
    /// Of `threads`, the caller's own among them; 0 for one a core.
    explicit ThreadTeam(unsigned threads = 0);
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    /// job(0) .. job(count - 1), each once, in any order and from several threads; returns when all are done.
    /// The first exception of a job is thrown on, once the jobs that had begun are done; the rest are then
    /// left out.
    void each(size_t count, const std::function<void(size_t)>& job);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lobe
