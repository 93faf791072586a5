#include "measure/statistics.hpp"

#include <algorithm>
#include <cmath>

#include "math/random.hpp"

namespace lobe::measure {
namespace {

double medianOfSorted(const std::vector<double>& values) {
    const size_t n = values.size();
    return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

}  // namespace

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return medianOfSorted(values);
}

double medianAbsoluteDeviation(const std::vector<double>& values) {
    const double center = median(values);
    std::vector<double> distances;
    distances.reserve(values.size());
    for (const double value : values)
        distances.push_back(std::abs(value - center));
    return median(std::move(distances));
}

double binomialCumulative(int n, double p, int k) {
    if (k < 0) return 0.0;
    double sum = 0.0;
    for (int i = 0; i <= std::min(k, n); ++i)
        sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) +
                        i * std::log(p) + (n - i) * std::log1p(-p));
    return std::min(sum, 1.0);
}

Interval medianInterval(std::vector<double> values, double confidence) {
    std::sort(values.begin(), values.end());
    const int n = static_cast<int>(values.size());
    const auto covered = [n](int k) { return std::max(0.0, 1.0 - 2.0 * binomialCumulative(n, 0.5, k - 1)); };
    int k = 1;
    while (2 * (k + 1) <= n && covered(k + 1) >= confidence)
        ++k;
    return {values[static_cast<size_t>(k - 1)], values[static_cast<size_t>(n - k)], covered(k)};
}

Interval ratioInterval(const std::vector<double>& a, const std::vector<double>& b, double confidence,
                       int resamples, uint64_t seed) {
    const size_t n = a.size();
    std::vector<double> ratios;
    ratios.reserve(n);
    for (size_t i = 0; i < n; ++i)
        ratios.push_back(a[i] / b[i]);
    Pcg32 random(seed);
    std::vector<double> medians, drawn(n);
    medians.reserve(static_cast<size_t>(resamples));
    for (int r = 0; r < resamples; ++r) {
        for (double& value : drawn)
            value = ratios[random.below(static_cast<uint32_t>(n))];
        medians.push_back(median(drawn));
    }
    std::sort(medians.begin(), medians.end());
    const double tail = 0.5 * (1.0 - confidence) * (resamples - 1);
    return {medians[static_cast<size_t>(std::floor(tail))],
            medians[static_cast<size_t>(std::ceil(resamples - 1 - tail))], confidence};
}

Order compare(const Interval& ratio) {
    if (ratio.holds(1.0)) return Order::tie;
    return ratio.high < 1.0 ? Order::less : Order::greater;
}

}  // namespace lobe::measure
