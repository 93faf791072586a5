// Statistics against known answers, and against simulated noise: an interval has to hold the truth as often
// as it says.
#include "measure/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "math/random.hpp"

namespace lobe::measure {
namespace {

TEST(Statistics, KnownAnswers) {
    EXPECT_EQ(median({3, 1, 2}), 2.0);
    EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
    EXPECT_EQ(medianAbsoluteDeviation({1, 1, 2, 2, 4, 6, 9}), 1.0);
    EXPECT_NEAR(binomialCumulative(9, 0.5, 1), 10.0 / 512.0, 1e-12);
    EXPECT_EQ(binomialCumulative(9, 0.5, -1), 0.0);
    EXPECT_NEAR(binomialCumulative(9, 0.5, 9), 1.0, 1e-12);
}

TEST(Statistics, OrderStatisticsOfTheMedian) {
    // Tables of the sign test: n = 9 gives ranks 2 and 8 with 0.9609, n = 6 the extremes with 0.9688.
    const Interval nine = medianInterval({9, 8, 7, 6, 5, 4, 3, 2, 1});
    EXPECT_EQ(nine.low, 2.0);
    EXPECT_EQ(nine.high, 8.0);
    EXPECT_NEAR(nine.confidence, 1.0 - 20.0 / 512.0, 1e-12);
    const Interval six = medianInterval({1, 2, 3, 4, 5, 6});
    EXPECT_EQ(six.low, 1.0);
    EXPECT_EQ(six.high, 6.0);
    EXPECT_NEAR(six.confidence, 1.0 - 2.0 / 64.0, 1e-12);
    const Interval three = medianInterval({1, 2, 3});
    EXPECT_NEAR(three.confidence, 0.75, 1e-12) << "few values say so";
    EXPECT_EQ(medianInterval({5}).confidence, 0.0);
}

/// The fewest of `trials` that hold the truth with the confidence, but for one case in 10^4.
int fewest(int trials, double confidence) {
    int k = 0;
    while (binomialCumulative(trials, confidence, k) < 1e-4)
        ++k;
    return k;
}

TEST(Statistics, IntervalsOfTheMedianHoldItAsOftenAsTheySay) {
    constexpr int kTrials = 2000;
    // Times are lopsided: a floor and a long tail.
    const auto sample = [](Pcg32& random) { return 10.0 - std::log1p(-random.uniform()); };
    const double truth = 10.0 + std::numbers::ln2;
    for (const int n : {7, 9, 20}) {
        Pcg32 random(static_cast<uint64_t>(n));
        int held = 0;
        double confidence = 0.0;
        for (int t = 0; t < kTrials; ++t) {
            std::vector<double> values;
            for (int i = 0; i < n; ++i)
                values.push_back(sample(random));
            const Interval interval = medianInterval(values);
            confidence = interval.confidence;
            held += interval.holds(truth);
        }
        EXPECT_GE(confidence, 0.95) << n;
        EXPECT_GE(held, fewest(kTrials, confidence)) << n;
        // And not by being too wide: the confidence is exact.
        EXPECT_LE(kTrials - held, kTrials - fewest(kTrials, confidence)) << n;
        EXPECT_GE(kTrials - held, fewest(kTrials, 1.0 - confidence)) << n;
    }
}

TEST(Statistics, RatiosOfPairsIgnoreWhatSlowsBoth) {
    Pcg32 random(5);
    std::vector<double> a, b;
    for (int i = 0; i < 9; ++i) {
        const double load = random.uniform(1.0, 5.0);  // the same for both of a pair
        a.push_back(10.0 * load * random.uniform(0.99, 1.01));
        b.push_back(11.0 * load * random.uniform(0.99, 1.01));
    }
    EXPECT_EQ(compare(ratioInterval(a, b)), Order::less);
    EXPECT_EQ(compare(ratioInterval(b, a)), Order::greater);
    EXPECT_EQ(compare(ratioInterval(a, a)), Order::tie);
    EXPECT_TRUE(ratioInterval(a, b).holds(10.0 / 11.0));
}

TEST(Statistics, EqualsAreSeldomToldApart) {
    constexpr int kTrials = 500, kPairs = 9;
    int wrong = 0;
    for (int t = 0; t < kTrials; ++t) {
        Pcg32 random(static_cast<uint64_t>(t) + 100);
        std::vector<double> a, b;
        for (int i = 0; i < kPairs; ++i) {
            a.push_back(random.uniform(9.0, 12.0));
            b.push_back(random.uniform(9.0, 12.0));
        }
        wrong += compare(ratioInterval(a, b)) != Order::tie;
    }
    // The bootstrap of a median of 9 goes from the second least to the second largest value at the widest,
    // and at worst one value further in: P(Binomial(9, 1/2) <= 2) twice.
    const double worst = 2.0 * binomialCumulative(kPairs, 0.5, 2);
    EXPECT_LE(wrong, kTrials - fewest(kTrials, 1.0 - worst));
}

}  // namespace
}  // namespace lobe::measure
