/// What can be said of repeated measurements without assuming a distribution.
#pragma once

#include <cstdint>
#include <vector>

namespace lobe::measure {

/// Mean of the two middle values of an even number. The values must not be empty.
double median(std::vector<double> values);

/// Median of the distances from the median.
double medianAbsoluteDeviation(const std::vector<double>& values);

struct Interval {
    double low = 0.0, high = 0.0;
    double confidence = 0.0;  ///< that it holds the true value, at least
    bool holds(double value) const { return low <= value && value <= high; }
};

/// Of the median of the distribution that independent values come from, whatever it is: from the k-th
/// smallest to the k-th largest value with the largest k for which 1 - 2 P(Binomial(n, 1/2) < k) is
/// `confidence` or more. Few values reach no such confidence (fewer than 6 not 0.95): then from the least to
/// the largest, with the confidence that this has. David and Nagaraja, Order Statistics, 7.1.
Interval medianInterval(std::vector<double> values, double confidence = 0.95);

/// Of the median of a[i] / b[i], pairs taken one right after the other so that what slows both falls out:
/// percentile bootstrap (Efron and Tibshirani 1993, chapter 13) of `resamples` with a fixed seed. Lengths
/// are equal and not 0, values positive.
Interval ratioInterval(const std::vector<double>& a, const std::vector<double>& b, double confidence = 0.95,
                       int resamples = 1000, uint64_t seed = 1);

enum class Order : int { less = -1, tie = 0, greater = 1 };
/// How a compares with b: a tie if 1 is in the interval of their ratio.
Order compare(const Interval& ratio);

/// P(Binomial(n, p) <= k).
double binomialCumulative(int n, double p, int k);

}  // namespace lobe::measure
