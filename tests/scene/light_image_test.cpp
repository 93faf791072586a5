#include "scene/light_image.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace lobe {
namespace {

Bitmap floats(int width, int height, int channels, const std::vector<float>& values) {
    Bitmap bitmap{width, height, channels, ComponentType::f32, {}};
    bitmap.data.resize(values.size() * sizeof(float));
    std::memcpy(bitmap.data.data(), values.data(), bitmap.data.size());
    return bitmap;
}

Bitmap bytes(int width, int height, int channels, const std::vector<int>& values) {
    Bitmap bitmap{width, height, channels, ComponentType::u8, {}};
    for (const int value : values)
        bitmap.data.push_back(static_cast<std::byte>(value));
    return bitmap;
}

double meanOf(const LightImage& image) {
    double sum = 0.0;
    for (const float value : image.values())
        sum += static_cast<double>(value);
    return sum / static_cast<double>(image.values().size());
}

TEST(LightImage, BytesAreSrgbAndFloatsLinear) {
    const LightImage encoded(bytes(2, 1, 3, {0, 188, 255, 255, 255, 255}));
    EXPECT_EQ(encoded.texel(0, 0).x, 0.0);
    EXPECT_NEAR(encoded.texel(0, 0).y, 0.5028865, 1e-6);
    EXPECT_EQ(encoded.texel(0, 0).z, 1.0);
    const LightImage linear(floats(1, 1, 3, {0.5F, 2.0F, 1e6F}));
    EXPECT_EQ(linear.texel(0, 0), glm::dvec3(0.5, 2.0, 1e6));
}

TEST(LightImage, GreyStandsForAllColorsAndAlphaDoesNotCount) {
    EXPECT_EQ(LightImage(floats(1, 1, 1, {0.25F})).texel(0, 0), glm::dvec3(0.25));
    EXPECT_EQ(LightImage(floats(1, 1, 2, {0.25F, 0.0F})).texel(0, 0), glm::dvec3(0.25));
    EXPECT_EQ(LightImage(floats(1, 1, 4, {1.0F, 2.0F, 3.0F, 0.0F})).texel(0, 0), glm::dvec3(1, 2, 3));
}

TEST(LightImage, BilinearBetweenCentresAndFlatBeyondThem) {
    const LightImage image(floats(2, 2, 1, {1, 2, 3, 5}));
    EXPECT_EQ(image.at({0.25, 0.25}).x, 1.0);
    EXPECT_EQ(image.at({0.75, 0.25}).x, 2.0);
    EXPECT_EQ(image.at({0.25, 0.75}).x, 3.0);
    EXPECT_EQ(image.at({0.75, 0.75}).x, 5.0);
    EXPECT_DOUBLE_EQ(image.at({0.5, 0.5}).x, 2.75);
    EXPECT_EQ(image.at({0.0, 0.0}).x, 1.0);
    EXPECT_EQ(image.at({1.0, 1.0}).x, 5.0);
    EXPECT_EQ(image.at({-3.0, 9.0}).x, 3.0);
    EXPECT_EQ(LightImage(floats(1, 1, 1, {7})).at({0.9, 0.1}).x, 7.0);
}

TEST(LightImage, ReducedItKeepsItsMean) {
    for (const auto& [width, height] :
         {std::pair(8, 8), std::pair(7, 5), std::pair(1, 9), std::pair(13, 1), std::pair(2, 3)}) {
        std::vector<float> values;
        for (int i = 0; i < width * height; ++i)
            values.push_back(static_cast<float>((i * 37) % 11));
        const LightImage image(floats(width, height, 1, values));
        const double mean = meanOf(image);
        for (const int parts : {1, 2, 4, 8}) {
            const LightImage less = image.reduced(parts, parts);
            EXPECT_EQ(less.width(), std::min(width, parts));
            EXPECT_EQ(less.height(), std::min(height, parts));
            EXPECT_NEAR(meanOf(less), mean, 1e-5 * mean) << width << " x " << height;
        }
    }
    const LightImage quarters = LightImage(floats(3, 1, 1, {3, 6, 9})).reduced(2, 2);
    EXPECT_FLOAT_EQ(quarters.values()[0], 4.0F);  // (3 + 6 / 2) / 1.5
    EXPECT_FLOAT_EQ(quarters.values()[3], 8.0F);
}

TEST(LightImage, PlacesAreFromTheTopLeftAsSeenFromTheSideThatEmits) {
    Light light;
    light.type = LightType::rect;
    light.direction = {0, 0, -1};
    light.axis = {1, 0, 0};
    light.width = 4.0;
    light.height = 2.0;
    EXPECT_EQ(placeOnImage(light, {2, 1, 0}), glm::dvec2(0, 0));
    EXPECT_EQ(placeOnImage(light, {-2, 1, 0}), glm::dvec2(1, 0));
    EXPECT_EQ(placeOnImage(light, {2, -1, 0}), glm::dvec2(0, 1));
    EXPECT_EQ(placeOnImage(light, {0, 0, 0}), glm::dvec2(0.5, 0.5));
}

TEST(LightImage, BadTexelsCountAsNoneAndAreSaid) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    Bitmap bitmap = floats(2, 2, 3, {nan, 1, 2, 3, -4, 5, -1, inf, 1, 1, 1, 1});
    const LightImage before(bitmap);
    EXPECT_EQ(before.texel(0, 0), glm::dvec3(0, 1, 2));
    EXPECT_EQ(before.texel(0, 1), glm::dvec3(0, 0, 1));
    EXPECT_EQ(clearBadTexels(bitmap), "has 2 texels that are not finite and 1 that are negative; taken as 0");
    EXPECT_EQ(LightImage(bitmap).values(), before.values());
    EXPECT_EQ(clearBadTexels(bitmap), std::nullopt);
    Bitmap encoded = bytes(1, 1, 3, {1, 2, 3});
    EXPECT_EQ(clearBadTexels(encoded), std::nullopt);
}

}  // namespace
}  // namespace lobe
