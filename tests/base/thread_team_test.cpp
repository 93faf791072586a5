/// Threads that share out loops.
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

#include "base/thread_team.hpp"

namespace lobe {
namespace {

TEST(ThreadTeam, DoesEachJobOnce) {
    for (unsigned threads : {1U, 2U, 5U}) {
        ThreadTeam team(threads);
        for (size_t count : {size_t{0}, size_t{1}, size_t{3}, size_t{1000}}) {
            std::vector<std::atomic<int>> done(count);
            team.each(count, [&](size_t i) { ++done[i]; });
            for (const auto& times : done)
                EXPECT_EQ(times, 1);
        }
    }
}

TEST(ThreadTeam, ThrowsOnAndGoesOn) {
    ThreadTeam team(3);
    for (int loop = 0; loop < 50; ++loop)
        EXPECT_THROW(team.each(100,
                               [](size_t i) {
                                   if (i == 7) throw std::runtime_error("7");
                               }),
                     std::runtime_error);
    std::atomic<int> done = 0;
    team.each(100, [&](size_t) { ++done; });
    EXPECT_EQ(done, 100);
}

}  // namespace
}  // namespace lobe
