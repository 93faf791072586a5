// Interleaved measuring with simulated machines.
#include "measure/timing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "math/random.hpp"

namespace lobe::measure {
namespace {

const std::atomic<bool> kGoOn = false;
const Repeats kOneFrame{.rounds = 9, .framesMost = 1};

std::vector<Samples> simulate(const std::vector<double>& times, double noise, double driftPerFrame,
                              const Repeats& repeats = kOneFrame) {
    Pcg32 random(3);
    double drift = 1.0;
    return interleave(
        times.size(), repeats, [](size_t) {},
        [&](size_t i) {
            drift += driftPerFrame;
            const double time = times[i] * drift * (1.0 + noise * random.uniform());
            return FrameCost{time, time, time};
        },
        kGoOn);
}

TEST(Timing, EverySecondRoundRunsBackwards) {
    std::vector<size_t> order;
    interleave(
        3, {.rounds = 2, .framesMost = 1}, [&](size_t i) { order.push_back(i); },
        [](size_t) {
            return FrameCost{1, 1, 1};
        },
        kGoOn);
    EXPECT_THAT(order, testing::ElementsAre(0, 1, 2, 2, 1, 0));
}

TEST(Timing, DriftMeetsAllAlike) {
    // A machine that gets slower by 2 % each frame: the second of two equal things is always later in a round
    // that runs forwards.
    const std::vector<Samples> samples = simulate({10.0, 10.0}, 0.01, 0.02);
    EXPECT_EQ(judgeNoise(samples).order[0][1], Order::tie);
}

TEST(Timing, DifferencesBeyondNoiseAreFound) {
    const Noise noise = judgeNoise(simulate({10.0, 12.0}, 0.02, 0.0));
    EXPECT_EQ(noise.order[0][1], Order::less);
    EXPECT_EQ(noise.order[1][0], Order::greater);
    EXPECT_FALSE(noise.noisy);
}

TEST(Timing, ANoisyMachineSaysSo) {
    const Noise noise = judgeNoise(simulate({10.0, 10.5}, 3.0, 0.0));
    EXPECT_TRUE(noise.noisy);
    EXPECT_THAT(noise.detail, testing::HasSubstr("too noisy"));
    EXPECT_EQ(noise.order[0][1], Order::tie);
}

TEST(Timing, ShortFramesAreRepeatedWithinARoundAndLongOnesNot) {
    int shortFrames = 0, longFrames = 0;
    const Repeats repeats{.rounds = 1, .framesMost = 5, .framesBudget = 50.0};
    interleave(
        2, repeats, [](size_t) {},
        [&](size_t i) {
            ++(i == 0 ? shortFrames : longFrames);
            const double time = i == 0 ? 1.0 : 60.0;
            return FrameCost{time, time, time};
        },
        kGoOn);
    EXPECT_EQ(shortFrames, 5);
    EXPECT_EQ(longFrames, 1);
}

TEST(Timing, StoppingDropsTheRoundInWork) {
    std::atomic<bool> stop = false;
    int frames = 0;
    const std::vector<Samples> samples = interleave(
        2, kOneFrame, [](size_t) {},
        [&](size_t) {
            stop = ++frames == 5;
            return FrameCost{1, 1, 1};
        },
        stop);
    EXPECT_EQ(samples[0].clock.size(), 2u);
    EXPECT_EQ(samples[1].clock.size(), 2u);
}

TEST(Timing, NoRoundIsBegunThatWouldNotEndInTime) {
    Repeats repeats = kOneFrame;
    repeats.seconds = 0.0;
    EXPECT_EQ(simulate({1.0}, 0.0, 0.0, repeats)[0].clock.size(), 1u) << "one round always";
}

TEST(Timing, SummariesAreOfTheClock) {
    const TimeSummary summary = summariseTime({{3, 1, 2}, {30, 10, 20}, {6, 2, 4}});
    EXPECT_EQ(summary.median, 2.0);
    EXPECT_EQ(summary.minimum, 1.0);
    EXPECT_EQ(summary.mad, 1.0);
    EXPECT_EQ(summary.wall, 20.0);
    EXPECT_EQ(summary.cpu, 4.0);
    EXPECT_EQ(summary.repeats, 3u);
}

TEST(Noise, IsNotKnownFromOneRound) {
    std::vector<Samples> once(2);
    for (Samples& samples : once)
        samples.clock = samples.wall = samples.cpu = {10.0};
    EXPECT_FALSE(judgeNoise(once).known);
    EXPECT_TRUE(judgeNoise(simulate({10.0, 12.0}, 0.02, 0.0)).known);
}

}  // namespace
}  // namespace lobe::measure
