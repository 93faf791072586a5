#include "gl/timer.hpp"

#include <chrono>

#include "gl/objects.hpp"

namespace lobe::gl {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsBetween(Clock::time_point a, Clock::time_point b) {
    return std::chrono::duration<double, std::milli>(b - a).count();
}

constexpr double kHour = 3.6e6;  // ms

}  // namespace

struct PassTimer::State {
    struct Mark {
        std::string pass;
        Clock::time_point clock;
        Query query;
    };
    bool queries = false;
    std::vector<Mark> marks;  ///< the first is the start

    void add(const std::string& pass) {
        Mark mark{pass, {}, {}};
        if (queries) {
            mark.query = Query::make();
            glQueryCounter(mark.query.id(), GL_TIMESTAMP);
        } else {
            // llvmpipe's timestamps are taken when work is queued: only what has finished has a time.
            glFinish();
        }
        mark.clock = Clock::now();
        marks.push_back(std::move(mark));
    }
};

PassTimer::PassTimer(bool reliableTimers) : state_(std::make_unique<State>()) {
    state_->queries = reliableTimers;
}
PassTimer::~PassTimer() = default;

void PassTimer::start() {
    state_->marks.clear();
    state_->add({});
}

void PassTimer::mark(const std::string& pass) {
    state_->add(pass);
}

std::vector<std::pair<std::string, double>> PassTimer::finish() {
    std::vector<std::pair<std::string, double>> times;
    std::vector<GLuint64> stamps;
    if (state_->queries)
        for (const State::Mark& mark : state_->marks) {
            GLuint64 stamp = 0;
            glGetQueryObjectui64v(mark.query.id(), GL_QUERY_RESULT, &stamp);
            stamps.push_back(stamp);
        }
    for (size_t i = 1; i < state_->marks.size(); ++i) {
        const State::Mark& mark = state_->marks[i];
        double milliseconds = millisecondsBetween(state_->marks[i - 1].clock, mark.clock);
        if (state_->queries) {
            const double measured =
                (static_cast<double>(stamps[i]) - static_cast<double>(stamps[i - 1])) * 1e-6;
            if (measured >= 0.0 && measured < kHour) milliseconds = measured;
        }
        size_t slot = 0;
        while (slot < times.size() && times[slot].first != mark.pass)
            ++slot;
        if (slot == times.size()) times.emplace_back(mark.pass, 0.0);
        times[slot].second += milliseconds;
    }
    return times;
}

}  // namespace lobe::gl
