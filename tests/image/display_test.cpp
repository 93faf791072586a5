#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "base/error.hpp"
#include "image/tone.hpp"

namespace lobe {
namespace {

constexpr std::array<float, 3> kBlack = {0.0F, 0.0F, 0.0F};

int code(const Bitmap& bitmap, size_t component) {
    return std::to_integer<int>(bitmap.data[component]);
}

TEST(ToDisplay, MatchesTheFunctionsPixelByPixel) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> exponent(-9.0F, 4.0F);
    Image image(127, 41, {"Z", "B", "R", "G"});  // any order, other channels between, no multiple of a block
    for (float& value : image.values)
        value = std::exp2(exponent(random));
    const float exposure = -0.7F;
    for (size_t curve = 0; curve < toneMappingNames().size(); ++curve) {
        const Bitmap bitmap =
            toDisplay(image, exposure, static_cast<ToneMapping>(curve), false, kBlack.data());
        ASSERT_EQ(bitmap.channels, 3);
        ASSERT_EQ(bitmap.data.size(), image.pixelCount() * 3);
        for (size_t i = 0; i < image.pixelCount(); ++i) {
            const float* const pixel = &image.values[i * 4];
            const float gain = std::exp2(exposure);
            std::array<float, 3> rgb = {pixel[2] * gain, pixel[3] * gain, pixel[1] * gain};
            toneMap(static_cast<ToneMapping>(curve), rgb.data());
            for (size_t c = 0; c < 3; ++c)
                ASSERT_EQ(code(bitmap, i * 3 + c), encodeSrgb8(rgb[c]))
                    << toneMappingNames()[curve] << " pixel " << i;
        }
    }
}

TEST(ToDisplay, UnpremultipliesForAlpha) {
    Image image(3, 1, {"R", "G", "B", "A"});
    image.values = {0.25F, 0.1F, 0.0F, 0.5F, 0.5F, 0.2F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F};
    const Bitmap bitmap = toDisplay(image, 0.0F, ToneMapping::none, true, kBlack.data());
    ASSERT_EQ(bitmap.channels, 4);
    EXPECT_EQ(code(bitmap, 3), 128);
    EXPECT_EQ(code(bitmap, 7), 255);
    EXPECT_EQ(code(bitmap, 11), 0);
    for (size_t c = 0; c < 3; ++c)
        EXPECT_EQ(code(bitmap, c), code(bitmap, 4 + c)) << "same surface, half covered";
    EXPECT_EQ(code(bitmap, 0), encodeSrgb8(0.5F));
    EXPECT_EQ(code(bitmap, 8), 0);
}

TEST(ToDisplay, ShowsTheBackgroundAsAskedFor) {
    Image image(3, 1, {"R", "G", "B", "A"});
    image.values = {0.0F, 0.0F, 0.0F, 0.0F, 0.25F, 0.25F, 0.25F, 0.5F, 0.25F, 0.25F, 0.25F, 1.0F};
    constexpr std::array<float, 3> kBackground = {0.5F, 0.02F, 1.0F};
    for (const float exposure : {0.0F, 3.0F})
        for (size_t curve = 0; curve < toneMappingNames().size(); ++curve) {
            const Bitmap bitmap =
                toDisplay(image, exposure, static_cast<ToneMapping>(curve), false, kBackground.data());
            for (size_t c = 0; c < 3; ++c)
                EXPECT_EQ(code(bitmap, c), encodeSrgb8(kBackground[c])) << toneMappingNames()[curve];
        }
    const Bitmap plain = toDisplay(image, 0.0F, ToneMapping::none, false, kBackground.data());
    EXPECT_EQ(code(plain, 3), encodeSrgb8(0.5F));
    EXPECT_EQ(code(plain, 6), encodeSrgb8(0.25F)) << "covered: no background";
}

TEST(ToDisplay, TakesAnImageWithoutAlphaAsOpaque) {
    Image image(1, 1, {"R", "G", "B"});
    image.values = {0.5F, 0.5F, 0.5F};
    constexpr std::array<float, 3> kWhite = {1.0F, 1.0F, 1.0F};
    EXPECT_EQ(code(toDisplay(image, 0.0F, ToneMapping::none, false, kWhite.data()), 0), encodeSrgb8(0.5F));
    EXPECT_EQ(code(toDisplay(image, 0.0F, ToneMapping::none, true, kWhite.data()), 3), 255);
    EXPECT_EQ(code(toDisplay(image, 1.0F, ToneMapping::none, true, kWhite.data()), 0), 255);
    EXPECT_THROW(toDisplay(Image(1, 1, {"R", "G", "Z"}), 0.0F, ToneMapping::none, false, kWhite.data()),
                 InputError);
    EXPECT_TRUE(
        toDisplay(Image(0, 0, {"R", "G", "B"}), 0.0F, ToneMapping::none, false, kWhite.data()).data.empty());
}

}  // namespace
}  // namespace lobe
