#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "image/image.hpp"

namespace lobe {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(CountNonFinite, FindsNothingInFinitePictures) {
    Image image(100, 77, {"R", "G", "B"});
    const NonFinite zero = countNonFinite(image);
    EXPECT_EQ(zero.pixels, 0U);
    EXPECT_EQ(zero.firstX, -1);
    EXPECT_EQ(zero.firstY, -1);
    image.values[5] = std::numeric_limits<float>::max();
    image.values[6] = -std::numeric_limits<float>::max();
    image.values[7] = std::numeric_limits<float>::denorm_min();
    image.values[8] = -0.0F;
    EXPECT_EQ(countNonFinite(image).pixels, 0U);
    EXPECT_EQ(countNonFinite(Image()).pixels, 0U);
}

TEST(CountNonFinite, FindsEachKindAnywhere) {
    const float signalling = std::bit_cast<float>(0x7f800001U);
    const float negativeNan = std::bit_cast<float>(0xffc00000U);
    for (const float bad : {kNan, kInfinity, -kInfinity, signalling, negativeNan})
        for (const auto& [x, y] : {std::pair{0, 0}, {99, 0}, {0, 76}, {99, 76}, {31, 40}})
            for (size_t c = 0; c < 3; ++c) {
                Image image(100, 77, {"R", "G", "normal.X"});
                image.pixel(x, y)[c] = bad;
                const NonFinite found = countNonFinite(image);
                EXPECT_EQ(found.pixels, 1U);
                EXPECT_EQ(found.firstX, x);
                EXPECT_EQ(found.firstY, y);
                EXPECT_EQ(found.firstChannel, image.channels[c]);
            }
}

TEST(CountNonFinite, CountsPixelsOnceAndReportsTheFirst) {
    Image image(50, 50, {"R", "G", "B", "A"});
    image.pixel(10, 3)[1] = kNan;
    image.pixel(10, 3)[2] = kInfinity;
    image.pixel(9, 4)[0] = kNan;
    image.pixel(49, 49)[3] = -kInfinity;
    const NonFinite found = countNonFinite(image);
    EXPECT_EQ(found.pixels, 3U);
    EXPECT_EQ(found.firstX, 10);
    EXPECT_EQ(found.firstY, 3);
    EXPECT_EQ(found.firstChannel, "G");
    std::fill(image.values.begin(), image.values.end(), kNan);
    EXPECT_EQ(countNonFinite(image).pixels, image.pixelCount());
}

}  // namespace
}  // namespace lobe
