#include "math/low_discrepancy.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <set>
#include <vector>

namespace lobe {
namespace {

/// Whether counts of one expectation pass at significance 1e-6.
void expectEven(const std::vector<int>& counts, double expected) {
    double chi2 = 0.0;
    for (int count : counts)
        chi2 += (count - expected) * (count - expected) / expected;
    const boost::math::chi_squared distribution(static_cast<double>(counts.size() - 1));
    EXPECT_LT(chi2, quantile(complement(distribution, 1e-6)));
}

TEST(OwenSobol, OnePointInEachElementaryInterval) {
    for (const uint32_t group : {0U, 4U, 40U})
        for (uint32_t pixel = 0; pixel < 20; ++pixel) {
            const OwenSobol points({pixel, 7 * pixel}, pixel % 3);
            for (uint32_t k = 0; k <= 10; ++k)
                for (uint32_t along = 0; along <= k; ++along) {
                    std::set<uint32_t> cells;
                    for (uint32_t i = 0; i < (1U << k); ++i) {
                        const auto x = static_cast<uint32_t>(points.at(i, group) * (1U << along));
                        const auto y = static_cast<uint32_t>(points.at(i, group + 1) * (1U << (k - along)));
                        cells.insert((y << along) | x);
                    }
                    ASSERT_EQ(cells.size(), 1U << k) << group << " " << pixel << " " << k << " " << along;
                }
        }
}

TEST(OwenSobol, EveryDimensionIsStratified) {
    const OwenSobol points({3, 5}, 11);
    for (uint32_t dimension = 0; dimension < 16; ++dimension) {
        std::set<uint32_t> cells;
        for (uint32_t i = 0; i < 1024; ++i)
            cells.insert(static_cast<uint32_t>(points.at(i, dimension) * 1024.0));
        EXPECT_EQ(cells.size(), 1024U);
    }
}

/// Of one index, over pixels and over seeds.
TEST(OwenSobol, ScramblesAreUniform) {
    for (const uint32_t index : {0U, 1U, 1000U})
        for (uint32_t dimension = 0; dimension < 8; ++dimension) {
            std::vector<int> overPixels(64), overSeeds(64);
            for (uint32_t i = 0; i < 64 * 200; ++i) {
                const double pixel = OwenSobol({i % 160, i / 160}, 1).at(index, dimension);
                const double seed = OwenSobol({10, 20}, i).at(index, dimension);
                ASSERT_GE(pixel, 0.0);
                ASSERT_LT(pixel, 1.0);
                ++overPixels[static_cast<size_t>(pixel * 64.0)];
                ++overSeeds[static_cast<size_t>(seed * 64.0)];
            }
            expectEven(overPixels, 200.0);
            expectEven(overSeeds, 200.0);
        }
}

/// Pairs of neighbouring seeds, pixels, dimensions, and groups of dimensions, in 16 x 16 cells.
TEST(OwenSobol, NeighboursAreIndependent) {
    std::vector<int> seeds(256), pixels(256), dimensions(256), groups(256);
    const auto count = [](std::vector<int>& cells, double x, double y) {
        ++cells[static_cast<size_t>(x * 16.0) * 16 + static_cast<size_t>(y * 16.0)];
    };
    for (uint32_t i = 0; i < 256 * 100; ++i) {
        const OwenSobol points({i % 160, i / 160}, 0);
        const double value = points.at(5, 0);
        count(seeds, value, OwenSobol({i % 160, i / 160}, 1).at(5, 0));
        count(pixels, value, OwenSobol({i % 160 + 1, i / 160}, 0).at(5, 0));
        count(dimensions, value, points.at(5, 1));
        count(groups, value, points.at(5, 4));
    }
    for (const auto* cells : {&seeds, &pixels, &dimensions, &groups})
        expectEven(*cells, 100.0);
}

/// The mean of a smooth function from two halves of other seeds: their difference says how far both are off.
TEST(OwenSobol, HalvesEstimateTheError) {
    double difference2 = 0.0, error2 = 0.0;
    constexpr int kPixels = 2000;
    for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
        double mean[2] = {};
        for (uint32_t half = 0; half < 2; ++half) {
            const OwenSobol points({pixel, 0}, half);
            for (uint32_t i = 0; i < 32; ++i)
                mean[half] += points.at(i, 0) * points.at(i, 1) / 32.0;
        }
        difference2 += (mean[0] - mean[1]) * (mean[0] - mean[1]) / 4.0;
        error2 += (0.5 * (mean[0] + mean[1]) - 0.25) * (0.5 * (mean[0] + mean[1]) - 0.25);
    }
    // Each is a sum of kPixels squares about normal: relative deviation sqrt(2 / kPixels), their ratio's
    // twice that over sqrt(2); five of them.
    EXPECT_NEAR(difference2 / error2, 1.0, 5.0 * 2.0 / std::sqrt(double(kPixels)));
}

}  // namespace
}  // namespace lobe
