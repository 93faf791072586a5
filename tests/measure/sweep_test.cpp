// The search on made-up machines whose fronts are known by trying everything.
#include "measure/sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lobe::measure {
namespace {

Choice same(const Choice& choice) {
    return choice;
}

/// Four knobs of four values; each multiplies time and adds to error, but for a little interplay that the
/// search's model does not know.
Point measured(const Choice& choice) {
    constexpr double kTime[4][4] = {{1, 2, 4, 8}, {1, 1.1, 1.3, 2}, {1, 1.01, 1.02, 1.5}, {1, 1.5, 2, 3}};
    constexpr double kError[4][4] = {{1, 0.25, 0.0625, 0.0156},
                                     {0.1, 0.01, 1e-3, 1e-4},
                                     {0.01, 1e-4, 1e-5, 1e-6},
                                     {0.5, 0.1, 0.02, 0.004}};
    Point point{choice, 1.0, 0.0};
    for (size_t k = 0; k < 4; ++k) {
        point.time *= kTime[k][choice[k]];
        point.error += kError[k][choice[k]];
    }
    point.error *= 1.0 + 0.05 * std::sin(choice[0] + 2.0 * choice[1] + 3.0 * choice[3]);
    return point;
}

std::vector<size_t> frontOf(const std::vector<Point>& points) {
    std::vector<double> errors;
    for (const Point& point : points)
        errors.push_back(point.error);
    return paretoFront(errors, [&](size_t i, size_t j) {
        return points[i].time < points[j].time   ? Order::less
               : points[i].time > points[j].time ? Order::greater
                                                 : Order::tie;
    });
}

/// Area over log time under the front's staircase of log error, from the fastest point's time to `slowest`.
double areaUnder(const std::vector<Point>& points, double slowest) {
    std::vector<Point> front;
    for (const size_t i : frontOf(points))
        front.push_back(points[i]);
    std::sort(front.begin(), front.end(), [](const Point& a, const Point& b) { return a.time < b.time; });
    double area = 0.0;
    for (size_t i = 0; i < front.size(); ++i) {
        const double next = i + 1 < front.size() ? front[i + 1].time : slowest;
        area += std::log(next / front[i].time) * std::log(front[i].error / 1e-6);
    }
    return area;
}

TEST(Search, FindsNearlyTheWholeFrontWithAFewOfManySettings) {
    std::vector<Point> all;
    for (int i = 0; i < 256; ++i)
        all.push_back(measured({i & 3, i >> 2 & 3, i >> 4 & 3, i >> 6 & 3}));
    Search search({4, 4, 4, 4}, {3, 3, 3, 3}, {{0, 0, 0, 0}}, same);
    EXPECT_EQ(search.possible(), 256.0);
    std::vector<Point> tried;
    while (tried.size() < 40)
        if (const auto choice = search.next(tried))
            tried.push_back(measured(*choice));
        else
            break;
    const double slowest = measured({3, 3, 3, 3}).time;
    // The staircase of 40 settings of 256 lies at most 3 % of its area above the true one.
    EXPECT_LT(areaUnder(tried, slowest) / areaUnder(all, slowest), 1.03);
}

TEST(Search, ComesToAnEndAndSuggestsNothingTwice) {
    Search search({2, 3}, {1, 2}, {}, same);
    std::vector<Point> tried;
    while (const auto choice = search.next(tried)) {
        for (const Point& point : tried)
            EXPECT_NE(point.choice, *choice);
        ASSERT_LT(tried.size(), 6u);
        tried.push_back(
            {*choice, 1.0 + (*choice)[0] + (*choice)[1], 1.0 / (1.0 + (*choice)[0] + (*choice)[1])});
    }
    EXPECT_EQ(tried.size(), 6u) << "all are on the front here";
}

TEST(Search, ChoicesThatMakeTheSamePictureAreTriedOnce) {
    // With the first knob at 1 the second does nothing.
    Search search({2, 5}, {0, 4}, {}, [](const Choice& c) { return c[0] == 1 ? Choice{1, 0} : c; });
    std::vector<Point> tried;
    int ones = 0;
    while (const auto choice = search.next(tried)) {
        ones += (*choice)[0] == 1;
        tried.push_back({*choice, 2.0 + (*choice)[1], 1.0 / (1.0 + (*choice)[1])});
    }
    EXPECT_EQ(ones, 1);
}

TEST(Search, OneMultiplierBalancesAllKnobs) {
    std::vector<Point> singles = {measured({3, 3, 3, 3})};
    for (size_t k = 0; k < 4; ++k)
        for (int v = 0; v < 3; ++v) {
            Choice choice = {3, 3, 3, 3};
            choice[k] = v;
            singles.push_back(measured(choice));
        }
    const Prediction prediction({4, 4, 4, 4}, {3, 3, 3, 3}, singles);
    EXPECT_EQ(prediction.best(0.0, {0, 0, 0, 0}), (Choice{3, 3, 3, 3})) << "only error counts";
    EXPECT_EQ(prediction.best(1e9, {3, 3, 3, 3}), (Choice{0, 0, 0, 0})) << "only time counts";
    const Point predicted = prediction.at({3, 3, 0, 3});
    EXPECT_NEAR(predicted.time, measured({3, 3, 0, 3}).time, 1e-9);
}

TEST(Front, KeepsWhatNoOtherBeats) {
    const std::vector<Point> points = {
        {{}, 1.0, 8.0}, {{}, 2.0, 4.0}, {{}, 3.0, 5.0}, {{}, 4.0, 1.0}, {{}, 4.0, 2.0}};
    EXPECT_THAT(frontOf(points), testing::ElementsAre(0, 1, 3));
}

TEST(Front, TiesInTimeAreDecidedByErrorAndTiesInBothStay) {
    const auto allTie = [](size_t, size_t) { return Order::tie; };
    EXPECT_THAT(paretoFront({3.0, 1.0, 2.0}, allTie), testing::ElementsAre(1));
    EXPECT_THAT(paretoFront({1.0, 1.0}, allTie), testing::ElementsAre(0, 1));
    // Errors below what the truth knows of itself are one and the same.
    EXPECT_THAT(paretoFront({3.0, 1e-3, 2e-3}, allTie, 0.01), testing::ElementsAre(1, 2));
}

}  // namespace
}  // namespace lobe::measure
