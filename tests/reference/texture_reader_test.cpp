// Texture filtering against closed forms.
#include "reference/texture_reader.hpp"

#include <gtest/gtest.h>

#include "image/tone.hpp"
#include "support/scenes.hpp"

namespace lobe::reference {
namespace {

using namespace lobe::test;

constexpr Sampler kNearest{Wrap::repeat, Wrap::repeat, Filter::nearest, Filter::nearest, MipFilter::none};
const glm::dvec2 kStill(0.0);

/// Grey of value 16 x + y of 255.
Bitmap ramp(int width, int height) {
    Scene scene;
    addImage(scene, width, height, 1, [](int x, int y, int) { return 16 * x + y; });
    return scene.images[0];
}

double at(const TextureReader& reader, const Sampler& sampler, const glm::dvec2& uv,
          const glm::dvec2& dx = kStill, const glm::dvec2& dy = kStill) {
    return reader.sample(sampler, uv, dx, dy).r * 255.0;
}

TEST(TextureReader, ChannelsAreWhatGlReads) {
    Scene scene;
    for (int channels = 1; channels <= 4; ++channels)
        addImage(scene, 1, 1, channels, [](int, int, int c) { return 51 * (c + 1); });
    const auto texel = [&](int image, bool srgb) {
        return TextureReader(scene.images[static_cast<size_t>(image)], srgb).texel(0, 0, 0);
    };
    EXPECT_EQ(texel(0, false), glm::dvec4(0.2, 0.2, 0.2, 1.0));
    EXPECT_EQ(texel(1, false), glm::dvec4(0.2, 0.2, 0.2, 0.4));
    EXPECT_EQ(texel(2, false), glm::dvec4(0.2, 0.4, 0.6, 1.0));
    EXPECT_EQ(texel(3, false), glm::dvec4(0.2, 0.4, 0.6, 0.8));
    const glm::dvec4 decoded = texel(3, true);
    EXPECT_NEAR(decoded.r, static_cast<double>(decodeSrgb(0.2f)), 1e-7);
    EXPECT_NEAR(decoded.b, static_cast<double>(decodeSrgb(0.6f)), 1e-7);
    EXPECT_EQ(decoded.a, 0.8) << "alpha is linear";
}

TEST(TextureReader, WrapModes) {
    const Bitmap bitmap = ramp(4, 2);
    const TextureReader reader(bitmap, false);
    const auto column = [&](Wrap wrap, double u) {
        Sampler sampler = kNearest;
        sampler.wrapS = wrap;
        return static_cast<int>(std::lround(at(reader, sampler, {u, 0.25}))) / 16;
    };
    const std::vector<std::pair<double, std::array<int, 3>>> expected = {
        // repeat, mirrored, clamped
        {0.125, {0, 0, 0}}, {0.9, {3, 3, 3}},          {1.125, {0, 3, 3}},
        {1.9, {3, 0, 3}},   {2.1, {0, 0, 3}},          {-0.1, {3, 0, 0}},
        {-1.1, {3, 3, 0}},  {1e15 + 0.125, {0, 0, 3}}, {-1e300, {0, 0, 0}}};
    for (const auto& [u, columns] : expected) {
        EXPECT_EQ(column(Wrap::repeat, u), columns[0]) << u;
        EXPECT_EQ(column(Wrap::mirroredRepeat, u), columns[1]) << u;
        EXPECT_EQ(column(Wrap::clampToEdge, u), columns[2]) << u;
    }
}

TEST(TextureReader, LinearFilterIsBilinear) {
    const Bitmap bitmap = ramp(8, 4);
    const TextureReader reader(bitmap, false);
    Sampler sampler;
    for (const double u : {0.1, 0.37, 0.5, 0.8})
        for (const double v : {0.2, 0.5, 0.77})
            // The ramp is linear, and so are its means: 16 x + y at texel centres.
            EXPECT_NEAR(at(reader, sampler, {u, v}), 16.0 * (8.0 * u - 0.5) + (4.0 * v - 0.5), 1e-12);
    sampler.wrapS = Wrap::clampToEdge;
    EXPECT_NEAR(at(reader, sampler, {0.0, 0.125}), 0.0, 1e-12);
    sampler.wrapS = Wrap::repeat;
    EXPECT_NEAR(at(reader, sampler, {0.0, 0.125}), 0.5 * 16.0 * 7.0, 1e-12) << "first and last meet";
}

TEST(TextureReader, LevelsAreMeansOverTheirArea) {
    const Bitmap bitmap = ramp(5, 3);
    const TextureReader reader(bitmap, false);
    ASSERT_EQ(reader.levels(), 3);
    EXPECT_EQ(reader.size(1), glm::ivec2(2, 1));
    EXPECT_EQ(reader.size(2), glm::ivec2(1, 1));
    // Each covers 2.5 columns of all 3 rows: (0 + 16 + 32 / 2) / 2.5 + 1.
    EXPECT_NEAR(reader.texel(1, 0, 0).r * 255.0, 32.0 / 2.5 + 1.0, 1e-12);
    EXPECT_NEAR(reader.texel(2, 0, 0).r * 255.0, 33.0, 1e-12) << "the mean of all";
}

TEST(TextureReader, LevelsAreChosenAsOpenGlSays) {
    // Four levels of constant value: 0 where x + y is even in level 0, else 255; means from level 1 on.
    Scene scene;
    addImage(scene, 8, 8, 1, [](int x, int y, int) { return (x + y) % 2 == 0 ? 0 : 254; });
    const TextureReader reader(scene.images[0], false);
    const glm::dvec2 white(1.5 / 8.0, 0.5 / 8.0);  // a texel's centre
    const auto along = [&](const Sampler& sampler, double texels) {
        return at(reader, sampler, white, {texels / 8.0, 0.0});
    };
    Sampler sampler;
    EXPECT_NEAR(along(sampler, 1.0), 254.0, 1e-12);
    EXPECT_NEAR(along(sampler, 2.0), 127.0, 1e-12);
    EXPECT_NEAR(along(sampler, std::exp2(0.25)), 0.75 * 254.0 + 0.25 * 127.0, 1e-12);
    EXPECT_NEAR(at(reader, sampler, white, {0.0, 0.0}, {0.0, 0.25}), 127.0, 1e-12)
        << "the longer side counts";
    EXPECT_NEAR(along(sampler, 1e9), 127.0, 1e-12) << "no level beyond the last";
    sampler.mip = MipFilter::nearest;
    EXPECT_NEAR(along(sampler, std::exp2(0.49)), 254.0, 1e-12);
    EXPECT_NEAR(along(sampler, std::exp2(0.51)), 127.0, 1e-12);
    sampler.mip = MipFilter::none;
    EXPECT_NEAR(along(sampler, 100.0), 254.0, 1e-12);
    // Between texel centres only a linear filter sees both.
    const glm::dvec2 between(2.0 / 8.0, 0.5 / 8.0);
    sampler = {Wrap::repeat, Wrap::repeat, Filter::linear, Filter::nearest, MipFilter::nearest};
    EXPECT_NEAR(at(reader, sampler, between, {std::exp2(0.45) / 8.0, 0.0}), 127.0, 1e-12)
        << "magnification reaches to half a level";
    sampler.mip = MipFilter::none;
    EXPECT_NE(at(reader, sampler, between, {std::exp2(0.45) / 8.0, 0.0}), 127.0);
}

}  // namespace
}  // namespace lobe::reference
