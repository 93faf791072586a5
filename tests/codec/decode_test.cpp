#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/error.hpp"
#include "codec/codec.hpp"
#include "codec/sample_files.hpp"

namespace lobe {
namespace {

using samples::bytesOf;
using testing::HasSubstr;

template<class Action>
std::string refusal(const Action& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    } catch (const OutputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(Png, KeepsEveryComponent) {
    for (const ComponentType type : {ComponentType::u8, ComponentType::u16})
        for (int channels = 1; channels <= 4; ++channels)
            for (const auto& [width, height] : {std::pair{1, 1}, {13, 9}, {640, 3}}) {
                const Bitmap written = samples::bitmap(width, height, channels, type);
                const Bitmap decoded = codec::decode(bytesOf(codec::encode(".png", written, {})));
                EXPECT_EQ(decoded.width, width);
                EXPECT_EQ(decoded.height, height);
                EXPECT_EQ(decoded.channels, channels);
                EXPECT_EQ(decoded.type, type);
                EXPECT_EQ(decoded.data, written.data)
                    << channels << " channels: alpha is never multiplied in";
            }
}

TEST(Png, ExpandsPalettesAndSmallDepths) {
    const Bitmap palette = codec::decode(bytesOf(samples::everyFormat().at("palette")));
    ASSERT_EQ(palette.channels, 4) << "a palette with transparency";
    ASSERT_EQ(palette.data.size(), 4U * 2 * 4);
    const std::array<uint8_t, 8> firstTwo = {1, 2, 3, 0x80, 4, 5, 6, 0xff};
    EXPECT_EQ(std::memcmp(palette.data.data(), firstTwo.data(), firstTwo.size()), 0);

    const Bitmap bits = codec::decode(bytesOf(samples::png({8, 1, 1, 0, "", "", "\xa5"})));
    EXPECT_EQ(bits.type, ComponentType::u8);
    ASSERT_EQ(bits.data.size(), 8U);
    for (size_t i = 0; i < 8; ++i)
        EXPECT_EQ(std::to_integer<int>(bits.data[i]), (0xa5 >> (7 - i) & 1) * 255);

    const Bitmap grey = codec::decode(bytesOf(samples::png({4, 1, 2, 0, "", "", "\x1b"})));
    for (size_t i = 0; i < 4; ++i)
        EXPECT_EQ(std::to_integer<int>(grey.data[i]), static_cast<int>(i) * 85);
}

TEST(Png, RefusesAbsurdSizesBeforeReading) {
    EXPECT_EQ(refusal([] {
                  codec::decode(bytesOf(samples::png({100'000, 1, 8, 0, "", "", "x"})));
              }),
              "width: 100000; expected 1 to 16384");
    EXPECT_EQ(refusal([] {
                  codec::decode(bytesOf(samples::png({1, 16385, 8, 0, "", "", "x"})));
              }),
              "height: 16385; expected 1 to 16384");
    EXPECT_THAT(refusal([] {
                    codec::decode(bytesOf(samples::png({16384, 16384, 8, 6, "", "", "x"})));
                }),
                HasSubstr("expected 1 to 268435456"));
    for (const uint32_t side : {0U, 0x7fffffffU, 0xffffffffU})
        EXPECT_NE(refusal([=] {
                      codec::decode(bytesOf(samples::png({side, side, 8, 2, "", "", "x"})));
                  }),
                  "no error");
}

TEST(Jpeg, ComesBackNearlyAndWithoutAlpha) {
    Bitmap smooth{64, 48, 4, ComponentType::u8, {}};
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            for (const int value : {x * 4, y * 5, 128, 7})
                smooth.data.push_back(static_cast<std::byte>(value));
    const Bitmap decoded = codec::decode(bytesOf(codec::encode(".jpeg", smooth, {})));
    ASSERT_EQ(decoded.channels, 3);
    ASSERT_EQ(decoded.data.size(), 64U * 48 * 3);
    int worst = 0;
    for (size_t pixel = 0; pixel < 64 * 48; ++pixel)
        for (size_t c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(std::to_integer<int>(decoded.data[pixel * 3 + c]) -
                                             std::to_integer<int>(smooth.data[pixel * 4 + c])));
    EXPECT_LE(worst, 8) << "quality 92, no subsampling of colour";
    WriteOptions low;
    low.jpegQuality = 20;
    EXPECT_LT(codec::encode(".jpg", smooth, low).size(), codec::encode(".jpg", smooth, {}).size());
}

TEST(WebP, KeepsColourUnderTransparency) {
    const Bitmap written = samples::bitmap(16, 16, 4, ComponentType::u8);
    const Bitmap decoded = codec::decode(bytesOf(samples::webp(written)));
    ASSERT_EQ(decoded.channels, 4);
    EXPECT_EQ(decoded.data, written.data);
    const Image image = codec::read(bytesOf(samples::webp(written)));
    ASSERT_EQ(image.values.size(), written.data.size());
    for (size_t i = 0; i < image.values.size(); ++i)
        ASSERT_FLOAT_EQ(image.values[i], static_cast<float>(std::to_integer<int>(written.data[i])) / 255.0F);
}

TEST(WebP, IsThreeChannelsWithoutAlphaAndRefusedWhenAnimated) {
    const Bitmap written = samples::bitmap(5, 4, 3, ComponentType::u8);
    const Bitmap decoded = codec::decode(bytesOf(samples::webp(written)));
    ASSERT_EQ(decoded.channels, 3);
    EXPECT_EQ(decoded.data, written.data);
    // An extended header with the flag of an animation, 16x16.
    const std::string animated("RIFF\x16\0\0\0WEBPVP8X\x0a\0\0\0\x02\0\0\0\x0f\0\0\x0f\0\0", 30);
    EXPECT_EQ(refusal([&] { codec::decode(bytesOf(animated)); }),
              "WebP is animated; expected a still picture");
}

TEST(Hdr, ComesBackToItsSharedExponent) {
    Image written = samples::image(100, 37, {"A", "B", "G", "R"});
    written.values[5] = 72'704.0F;  // a sun that RGBA16F can't hold
    written.values[9] = -1.0F;
    const Image read = codec::read(bytesOf(codec::encode(".hdr", written, {})));
    ASSERT_EQ(read.channels, (std::vector<std::string>{"R", "G", "B"}));
    for (size_t pixel = 0; pixel < read.pixelCount(); ++pixel) {
        const float* const in = &written.values[pixel * 4];
        const float* const out = &read.values[pixel * 3];
        const float largest = std::max({in[1], in[2], in[3]});
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(out[c], std::max(in[3 - c], 0.0F), largest / 128)
                << "8 bits below the largest component";
    }
    EXPECT_EQ(codec::decode(bytesOf(codec::encode(".hdr", written, {}))).type, ComponentType::f32);
    written.values[1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(refusal([&] { codec::encode(".hdr", written, {}); }), HasSubstr("NaN or infinity"));
    EXPECT_THAT(refusal([] { codec::encode(".hdr", Image(2, 2, {"Z"}), {}); }), HasSubstr("no channel R"));
}

/// By name: readers may order channels in their own way.
void expectSameValues(const Image& a, const Image& b) {
    ASSERT_EQ(a.width, b.width);
    ASSERT_EQ(a.height, b.height);
    ASSERT_THAT(a.channels, testing::UnorderedElementsAreArray(b.channels));
    for (size_t ca = 0; ca < a.channels.size(); ++ca) {
        const size_t cb = static_cast<size_t>(
            std::find(b.channels.begin(), b.channels.end(), a.channels[ca]) - b.channels.begin());
        for (size_t pixel = 0; pixel < a.pixelCount(); ++pixel) {
            const float va = a.values[pixel * a.channelCount() + ca];
            const float vb = b.values[pixel * b.channelCount() + cb];
            ASSERT_TRUE(va == vb || (std::isnan(va) && std::isnan(vb)))
                << a.channels[ca] << " pixel " << pixel << ": " << va << " and " << vb;
        }
    }
}

const std::vector<std::string> kLayers = {
    "R",        "G",        "B",        "A",  "Z",       "normal.X", "normal.Y", "normal.Z",
    "albedo.R", "albedo.G", "albedo.B", "id", "depth.Z", "light.R",  "light.G",  "light.B"};

TEST(Exr, KeepsFloatsAndNonFiniteValues) {
    WriteOptions single;
    single.exrPrecision = ExrPrecision::single;
    Image written = samples::image(33, 21, kLayers);
    written.values[0] = std::numeric_limits<float>::quiet_NaN();
    written.values[17] = std::numeric_limits<float>::infinity();
    written.values[34] = -std::numeric_limits<float>::infinity();
    written.values[50] = 3e38F;
    written.values[66] = 1e-40F;
    const Image read = codec::read(bytesOf(codec::encode(".exr", written, single)));
    expectSameValues(written, read);
    EXPECT_EQ(countNonFinite(read).pixels, countNonFinite(written).pixels);
}

TEST(Exr, RoundsToHalfOnlyWhatHalfHolds) {
    Image written = samples::image(33, 21, kLayers);
    const size_t channels = written.channelCount();
    const auto channel = [&](const std::string& name) {
        return static_cast<size_t>(std::find(kLayers.begin(), kLayers.end(), name) - kLayers.begin());
    };
    written.values[channel("light.G")] = 72'704.0F;
    written.values[channel("R")] = std::numeric_limits<float>::quiet_NaN();
    written.values[channels + channel("G")] = std::numeric_limits<float>::infinity();
    const Image read = codec::read(bytesOf(codec::encode(".exr", written, {})));
    ASSERT_THAT(read.channels, testing::UnorderedElementsAreArray(kLayers));
    EXPECT_EQ(countNonFinite(read).pixels, 2U) << "nothing overflows";
    for (size_t c = 0; c < channels; ++c) {
        const bool exact = read.channels[c] == "Z" || read.channels[c] == "light.G";
        size_t differing = 0;
        for (size_t pixel = 2; pixel < written.pixelCount(); ++pixel) {
            const float in = written.values[pixel * channels + channel(read.channels[c])];
            const float out = read.values[pixel * channels + c];
            ASSERT_NEAR(out, in, in / 2048) << read.channels[c];
            differing += in != out ? 1 : 0;
        }
        EXPECT_EQ(differing == 0, exact) << read.channels[c];
    }
}

TEST(Exr, DecodesColourAsATexture) {
    const Image written = samples::image(20, 10, {"R", "G", "B"});
    const Bitmap tiled = codec::decode(bytesOf(samples::tiledExr(written, 16, 16)));
    EXPECT_EQ(tiled.type, ComponentType::f32);
    EXPECT_EQ(tiled.channels, 3);
    ASSERT_EQ(tiled.data.size(), written.values.size() * sizeof(float));
    EXPECT_EQ(std::memcmp(tiled.data.data(), written.values.data(), tiled.data.size()), 0);
    EXPECT_EQ(codec::decode(bytesOf(codec::encode(".exr", samples::image(4, 4, kLayers), {}))).channels, 4);
    EXPECT_THAT(refusal([] {
                    codec::decode(
                        bytesOf(codec::encode(".exr", samples::image(4, 4, {"a", "b", "c", "d", "e"}), {})));
                }),
                HasSubstr("channels: 5"));
}

/// Replaces the value of a header attribute.
std::string patched(std::string file, const std::string& attributeAndType, size_t offset, uint32_t value) {
    const size_t at = file.find(attributeAndType) + attributeAndType.size() + 4 + offset;
    for (size_t i = 0; i < 4; ++i)
        file[at + i] = static_cast<char>(value >> (8 * i) & 0xffU);
    return file;
}

TEST(Exr, RefusesAbsurdHeadersBeforeOpening) {
    const std::string tiles("tiles\0tiledesc\0", 15);
    const std::string window("dataWindow\0box2i\0", 17);
    const std::string file = samples::tiledExr(samples::image(20, 20, {"R", "G", "B"}), 16, 16);
    EXPECT_EQ(refusal([&] { codec::decode(bytesOf(patched(file, tiles, 0, 30'000))); }),
              "EXR tile size: 30000x16; expected at most 1024x1024");
    EXPECT_EQ(refusal([&] { codec::decode(bytesOf(patched(file, tiles, 4, 0xffffffff))); }),
              "EXR tile size: 16x4294967295; expected at most 1024x1024");
    EXPECT_THAT(refusal([&] { codec::decode(bytesOf(patched(file, tiles, 0, 0))); }),
                HasSubstr("tile size: 0x16"));
    EXPECT_EQ(refusal([&] { codec::decode(bytesOf(patched(file, window, 8, 0x7fffffff))); }),
              "width: 2147483648; expected 1 to 16384");
    EXPECT_EQ(refusal([&] { codec::decode(bytesOf(patched(file, window, 12, 0x80000000))); }),
              "height: -2147483647; expected 1 to 16384");
    EXPECT_THAT(refusal([&] { codec::decode(bytesOf(file.substr(0, 60))); }), HasSubstr("EXR header"));
}

TEST(Format, IsDecidedByContent) {
    using namespace std::string_literals;
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"", "file is empty; expected PNG, JPEG, WebP, HDR or EXR"},
        {"BM rest", "format is BMP; expected PNG, JPEG, WebP, HDR or EXR"},
        {"II*\0 rest"s, "format is TIFF; expected PNG, JPEG, WebP, HDR or EXR"},
        {"MM\0*"s, "format is TIFF; expected PNG, JPEG, WebP, HDR or EXR"},
        {"\xABKTX 20\xBB\r\n\x1A\n", "format is KTX2; expected PNG, JPEG, WebP, HDR or EXR"},
        {"GIF89a", "format is GIF; expected PNG, JPEG, WebP, HDR or EXR"},
        {"RIFF\0\0\0\0WAVE"s, "format is unknown; expected PNG, JPEG, WebP, HDR or EXR"},
        {"\x89PNG", "format is unknown; expected PNG, JPEG, WebP, HDR or EXR"},
        {"{}", "format is unknown; expected PNG, JPEG, WebP, HDR or EXR"},
    };
    for (const auto& [text, reason] : cases) {
        const std::string& content = text;  // lambdas take no structured bindings
        EXPECT_EQ(refusal([&] { codec::decode(bytesOf(content)); }), reason);
        EXPECT_EQ(refusal([&] { codec::read(bytesOf(content)); }), reason);
        EXPECT_EQ(refusal([&] { codec::readMetadata(bytesOf(content)); }), reason);
    }
    const Bitmap bitmap = samples::bitmap(2, 2, 3, ComponentType::u8);
    EXPECT_THAT(refusal([&] { codec::encode(".tif", bitmap, {}); }), HasSubstr("extension: '.tif'"));
    EXPECT_THAT(refusal([&] { codec::encode(".exr", bitmap, {}); }),
                HasSubstr("expected .png, .jpg or .jpeg"));
    EXPECT_THAT(refusal([] { codec::encode(".png", Image(1, 1, {"R"}), {}); }),
                HasSubstr("expected .exr or .hdr"));
    EXPECT_EQ(codec::encode(".PNG", bitmap, {}).substr(1, 3), "PNG");
}

}  // namespace
}  // namespace lobe
