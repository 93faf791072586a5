#include "math/ulp.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lobe {
namespace {

TEST(UlpDistance, CountsRepresentableSteps) {
    EXPECT_EQ(ulpDistance(1.0f, 1.0f), 0u);
    EXPECT_EQ(ulpDistance(1.0f, std::nextafter(1.0f, 2.0f)), 1u);
    EXPECT_EQ(ulpDistance(std::nextafter(1.0f, 0.0f), 1.0f), 1u);
    EXPECT_EQ(ulpDistance(1.0, 1.0 + 5 * std::numeric_limits<double>::epsilon()), 5u);
    EXPECT_EQ(ulpDistance(1.0f, 2.0f), 1u << 23);
}

TEST(UlpDistance, CrossesZero) {
    const float tiny = std::numeric_limits<float>::denorm_min();
    EXPECT_EQ(ulpDistance(0.0f, -0.0f), 0u);
    EXPECT_EQ(ulpDistance(-tiny, tiny), 2u);
    EXPECT_EQ(ulpDistance(tiny, -tiny), 2u);
    const double tinyDouble = std::numeric_limits<double>::denorm_min();
    EXPECT_EQ(ulpDistance(-tinyDouble, 3 * tinyDouble), 4u);
}

TEST(UlpDistance, ReachesFromEndToEnd) {
    const double most = std::numeric_limits<double>::max();
    EXPECT_EQ(ulpDistance(-most, most), 2u * ulpDistance(0.0, most));
    EXPECT_EQ(ulpDistance(std::nanf(""), 1.0f), std::numeric_limits<uint64_t>::max());
    EXPECT_EQ(ulpDistance(1.0, std::nan("")), std::numeric_limits<uint64_t>::max());
}

}  // namespace
}  // namespace lobe
