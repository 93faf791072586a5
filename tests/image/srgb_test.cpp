#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "image/tone.hpp"

namespace lobe {
namespace {

/// IEC 61966-2-1, written again.
long double encodeExactly(long double x) {
    return x <= 0.0031308L ? 12.92L * x : 1.055L * std::pow(x, 1.0L / 2.4L) - 0.055L;
}

int nearestCode(float x) {
    return static_cast<int>(std::floor(encodeExactly(static_cast<long double>(x)) * 255.0L + 0.5L));
}

TEST(Srgb, EncodesEveryThresholdExactly) {
    for (int code = 1; code <= 255; ++code) {
        // The least float that encodes to `code`, by bisection on its bits.
        uint32_t below = 0;
        uint32_t at = std::bit_cast<uint32_t>(1.0F);
        while (at - below > 1) {
            const uint32_t middle = (below + at) / 2;
            (nearestCode(std::bit_cast<float>(middle)) >= code ? at : below) = middle;
        }
        EXPECT_EQ(encodeSrgb8(std::bit_cast<float>(at)), code);
        EXPECT_EQ(encodeSrgb8(std::bit_cast<float>(below)), code - 1);
    }
}

TEST(Srgb, EncodesADenseSweepExactly) {
    const uint32_t end = std::bit_cast<uint32_t>(1.0F);
    int wrong = 0;
    for (uint32_t bits = 0; bits <= end; bits += 997)  // a prime: about a million floats of every octave
        wrong += encodeSrgb8(std::bit_cast<float>(bits)) != nearestCode(std::bit_cast<float>(bits)) ? 1 : 0;
    EXPECT_EQ(wrong, 0);
}

TEST(Srgb, ClampsWhatIsOutside) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(encodeSrgb8(-1.0F), 0);
    EXPECT_EQ(encodeSrgb8(-0.0F), 0);
    EXPECT_EQ(encodeSrgb8(-kInfinity), 0);
    EXPECT_EQ(encodeSrgb8(std::numeric_limits<float>::denorm_min()), 0);
    EXPECT_EQ(encodeSrgb8(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(encodeSrgb8(1.0F), 255);
    EXPECT_EQ(encodeSrgb8(std::nextafter(1.0F, 2.0F)), 255);
    EXPECT_EQ(encodeSrgb8(1e30F), 255);
    EXPECT_EQ(encodeSrgb8(kInfinity), 255);
}

TEST(Srgb, CodesSurviveDecoding) {
    for (int code = 0; code <= 255; ++code) {
        const float linear = decodeSrgb(static_cast<float>(code) / 255.0F);
        EXPECT_EQ(encodeSrgb8(linear), code);
        EXPECT_NEAR(encodeSrgb(linear) * 255.0F, static_cast<float>(code), 1e-4F);
    }
    EXPECT_FLOAT_EQ(decodeSrgb(0.5F), 0.21404114F);
    EXPECT_FLOAT_EQ(encodeSrgb(0.18F), 0.46135613F);
    EXPECT_FLOAT_EQ(encodeSrgb(0.001F), 0.01292F);
}

}  // namespace
}  // namespace lobe
