// PassTimer: names in order, sums, and times within what the wall clock saw.
#include "gl/timer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "drawing.hpp"

namespace lobe::gl {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Both kinds of clock; software drivers' queries must survive too, though nobody relies on their values.
class PassTimerTest : public testing::TestWithParam<bool> {
protected:
    std::unique_ptr<Context> context_ = Context::create();
};

TEST_P(PassTimerTest, SumsByNameInOrderOfTheFirstMark) {
    PassTimer timer(GetParam());
    const auto start = Clock::now();
    timer.start();
    for (const char* pass : {"gbuffer", "light.point", "gbuffer", "output"}) {
        test::drawPicture();
        timer.mark(pass);
    }
    const auto times = timer.finish();
    const double wall = millisecondsSince(start);
    ASSERT_EQ(times.size(), 3u);
    EXPECT_EQ(times[0].first, "gbuffer");
    EXPECT_EQ(times[1].first, "light.point");
    EXPECT_EQ(times[2].first, "output");
    double sum = 0.0;
    for (const auto& [pass, milliseconds] : times) {
        EXPECT_GE(milliseconds, 0.0) << pass;
        sum += milliseconds;
    }
    EXPECT_LE(sum, wall);
    EXPECT_GT(sum, 0.0);
}

TEST_P(PassTimerTest, StartsAnew) {
    PassTimer timer(GetParam());
    timer.start();
    timer.mark("old");
    timer.finish();
    timer.start();
    timer.mark("new");
    const auto times = timer.finish();
    ASSERT_EQ(times.size(), 1u);
    EXPECT_EQ(times[0].first, "new");
}

TEST_P(PassTimerTest, WithoutMarksHasNoTimes) {
    PassTimer timer(GetParam());
    EXPECT_TRUE(timer.finish().empty());
    timer.start();
    EXPECT_TRUE(timer.finish().empty());
}

INSTANTIATE_TEST_SUITE_P(, PassTimerTest, testing::Bool(),
                         [](const auto& parameter) { return parameter.param ? "queries" : "clock"; });

TEST(PassTimerClock, CountsTheTimeBetweenMarks) {
    const auto context = Context::create();
    PassTimer timer(false);
    timer.start();
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    timer.mark("slow");
    timer.mark("quick");
    const auto times = timer.finish();
    ASSERT_EQ(times.size(), 2u);
    EXPECT_GE(times[0].second, 30.0);
    EXPECT_LT(times[1].second, times[0].second);
}

}  // namespace
}  // namespace lobe::gl
