#include "measure/timing.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>

namespace lobe::measure {
namespace {

using SteadyClock = std::chrono::steady_clock;

double processCpuMs() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double millisecondsSince(SteadyClock::time_point start) {
    return std::chrono::duration<double, std::milli>(SteadyClock::now() - start).count();
}

FrameCost oneValue(size_t thing, const Repeats& repeats, const std::function<FrameCost(size_t)>& frame) {
    std::vector<double> clock, wall, cpu;
    double spent = 0.0;
    do {
        const FrameCost cost = frame(thing);
        clock.push_back(cost.clock);
        wall.push_back(cost.wall);
        cpu.push_back(cost.cpu);
        spent += cost.wall;
    } while (static_cast<int>(clock.size()) < repeats.framesMost && spent < repeats.framesBudget);
    return {median(clock), median(wall), median(cpu)};
}

/// With fewer no interval of a median has a confidence of 0.95.
constexpr size_t kFewRounds = 6;

std::string percent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f %%", 100.0 * share);
    return text;
}

}  // namespace

Clock clockOf(const gl::ContextInfo& info) {
    return info.reliableTimers ? Clock::timerQueries : Clock::processCpu;
}

std::string nameOf(Clock clock) {
    return clock == Clock::timerQueries ? "timer queries" : "process cpu";
}

FrameCost timeFrame(Renderer& renderer, const Camera& camera, Clock clock) {
    FrameCost cost;
    const double cpu = processCpuMs();
    const Picture picture = renderer.render(camera);
    cost.cpu = processCpuMs() - cpu;
    cost.wall = picture.milliseconds;
    if (clock == Clock::processCpu) {
        cost.clock = cost.cpu;
        return cost;
    }
    for (const PassTime& time : picture.passTimes)
        if (time.pass != "readback") cost.clock += time.milliseconds;
    return cost;
}

std::vector<Samples> interleave(size_t things, const Repeats& repeats,
                                const std::function<void(size_t)>& prepare,
                                const std::function<FrameCost(size_t)>& frame,
                                const std::atomic<bool>& stop) {
    std::vector<Samples> all(things);
    const auto start = SteadyClock::now();
    for (int round = 0; round < repeats.rounds; ++round) {
        const double spent = millisecondsSince(start) * 1e-3;
        if (round > 0 && spent + spent / round > repeats.seconds) break;
        std::vector<FrameCost> values(things);
        for (size_t i = 0; i < things; ++i) {
            if (stop) return all;
            const size_t thing = round % 2 == 0 ? i : things - 1 - i;
            prepare(thing);
            values[thing] = oneValue(thing, repeats, frame);
        }
        for (size_t i = 0; i < things; ++i) {
            all[i].clock.push_back(values[i].clock);
            all[i].wall.push_back(values[i].wall);
            all[i].cpu.push_back(values[i].cpu);
        }
    }
    return all;
}

TimeSummary summariseTime(const Samples& samples) {
    TimeSummary summary;
    summary.repeats = samples.clock.size();
    summary.median = median(samples.clock);
    summary.minimum = *std::min_element(samples.clock.begin(), samples.clock.end());
    summary.mad = medianAbsoluteDeviation(samples.clock);
    summary.interval = medianInterval(samples.clock);
    summary.wall = median(samples.wall);
    summary.cpu = median(samples.cpu);
    return summary;
}

Noise judgeNoise(const std::vector<Samples>& all) {
    Noise noise;
    const size_t n = all.size();
    noise.order.assign(n, std::vector<Order>(n, Order::tie));
    size_t pairs = 0, ties = 0;
    std::vector<double> widths;
    for (size_t i = 0; i < n; ++i) {
        const TimeSummary summary = summariseTime(all[i]);
        widths.push_back(0.5 * (summary.interval.high - summary.interval.low) / summary.median);
        for (size_t j = 0; j < i; ++j) {
            const Order order = compare(ratioInterval(all[i].clock, all[j].clock));
            noise.order[i][j] = order;
            noise.order[j][i] = static_cast<Order>(-static_cast<int>(order));
            ++pairs;
            ties += order == Order::tie;
        }
    }
    if (n == 0) return noise;
    noise.typicalWidth = median(widths);
    if (all[0].clock.size() < 2) {
        noise.known = false;
        noise.detail = "each setting was timed once, as more rounds did not fit into the time";
        return noise;
    }
    noise.noisy = noise.typicalWidth > kNoisyWidth;
    noise.detail = "times are known to about " + percent(noise.typicalWidth) +
                   " (half the interval of a median); " + std::to_string(ties) + " of " +
                   std::to_string(pairs) + " pairs of settings can't be told apart";
    if (const size_t rounds = all[0].clock.size(); rounds < kFewRounds)
        noise.detail +=
            "; only " + std::to_string(rounds) + " of the rounds fit into the time, so intervals say less";
    if (noise.noisy) noise.detail += "; the machine was too noisy to compare settings of like cost";
    return noise;
}

}  // namespace lobe::measure
