/// Run time measured so that two settings can be told apart: warm, repeated, interleaved.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "gl/context.hpp"
#include "measure/statistics.hpp"
#include "passes/renderer.hpp"

namespace lobe::measure {

/// What times are compared in. Timer queries where the driver's are real; else the CPU time of all threads of
/// the process, which other programs disturb far less than the time on the wall.
enum class Clock : uint8_t { timerQueries, processCpu };
Clock clockOf(const gl::ContextInfo& info);
std::string nameOf(Clock clock);  ///< "timer queries", "process cpu"

/// One frame, ms.
struct FrameCost {
    double clock = 0.0;  ///< by the Clock
    double wall = 0.0, cpu = 0.0;
};

/// Renders one frame. With timer queries the renderer's options must ask for times of passes.
FrameCost timeFrame(Renderer& renderer, const Camera& camera, Clock clock);

/// How often things are measured.
struct Repeats {
    int rounds = 9;              ///< one value a round
    int framesMost = 5;          ///< a round; the value is their median
    double framesBudget = 50.0;  ///< ms a round: fewer frames if they are long
    double seconds = 1e9;        ///< no new round is begun that would not end within these
};

/// Values of one thing, a value a round.
struct Samples {
    std::vector<double> clock, wall, cpu;
};

/// Measures all things in turn, round after round, every second round backwards, so that what drifts
/// (temperature, other programs) meets all alike and values of one round are pairs. `prepare` makes a thing
/// ready and warm, `frame` measures it once. Ends after a whole round; returns what it has when `stop` is
/// set, without the round in work.
std::vector<Samples> interleave(size_t things, const Repeats& repeats,
                                const std::function<void(size_t)>& prepare,
                                const std::function<FrameCost(size_t)>& frame, const std::atomic<bool>& stop);

struct TimeSummary {
    double median = 0.0, minimum = 0.0, mad = 0.0;  ///< ms by the clock
    Interval interval;                              ///< of the median
    double wall = 0.0, cpu = 0.0;                   ///< medians, ms
    size_t repeats = 0;
};
TimeSummary summariseTime(const Samples& samples);

/// Whether times could be told apart.
struct Noise {
    bool known = true;  ///< not where each thing was timed once
    bool noisy = false;
    std::string detail;                     ///< for people
    double typicalWidth = 0.0;              ///< median over things of the interval's half width / median
    std::vector<std::vector<Order>> order;  ///< order[i][j]: how i's time compares with j's
};

/// Above this typical half width a machine is called noisy: a change of a fifth is then lost.
inline constexpr double kNoisyWidth = 0.10;

Noise judgeNoise(const std::vector<Samples>& all);

}  // namespace lobe::measure
