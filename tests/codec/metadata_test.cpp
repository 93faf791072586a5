#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <string>
#include <thread>

#include "base/error.hpp"
#include "codec/codec.hpp"
#include "codec/sample_files.hpp"

namespace lobe {
namespace {

using Metadata = std::map<std::string, std::string>;
using samples::bytesOf;

Metadata sample(size_t bytes) {
    std::string settings = "{\n  \"scene\": \"caf\u00e9 \u6f22\u5b57 \\\"quoted\\\".gltf\",\n\t\"note\": \"";
    while (settings.size() < bytes)
        settings += "back\\slash, 'single', #hash, =equals; ";
    settings += "\"\n}";
    return {{"lobe:settings", settings}, {"Software", "lobe 0.1.0"}, {"empty", ""}};
}

std::string encodedAs(const std::string& extension, const Metadata& metadata) {
    WriteOptions options;
    options.metadata = metadata;
    if (extension == ".exr" || extension == ".hdr")
        return codec::encode(extension, samples::image(16, 16, {"R", "G", "B"}), options);
    return codec::encode(extension, samples::bitmap(16, 16, 3, ComponentType::u8), options);
}

class RoundTrip : public testing::TestWithParam<std::string> {};

TEST_P(RoundTrip, KeepsEveryText) {
    for (const size_t bytes : {size_t{0}, size_t{100}, size_t{8'000}, size_t{200'000}}) {
        const Metadata written = sample(bytes);
        const std::string file = encodedAs(GetParam(), written);
        const Metadata read = codec::readMetadata(bytesOf(file));
        for (const auto& [key, value] : written) {
            if (value.empty()) continue;  // EXR writers may leave out empty attributes
            ASSERT_TRUE(read.contains(key)) << key;
            EXPECT_EQ(read.at(key), value);
        }
    }
}

TEST_P(RoundTrip, LeavesThePixelsAlone) {
    const std::string plain = encodedAs(GetParam(), {});
    const std::string annotated = encodedAs(GetParam(), sample(70'000));
    EXPECT_EQ(codec::read(bytesOf(plain)).values, codec::read(bytesOf(annotated)).values);
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // a second of the clock
    EXPECT_EQ(annotated, encodedAs(GetParam(), sample(70'000))) << "same pixels and texts, same bytes";
}

/// Whatever is cut off or overwritten, reading ends in texts or InputError; this parses untrusted bytes
/// itself.
TEST_P(RoundTrip, SurvivesDamage) {
    const std::string file = encodedAs(GetParam(), sample(300));
    const auto tryToRead = [](const std::string& damaged) {
        try {
            codec::readMetadata(bytesOf(damaged));
        } catch (const InputError&) {
        }
    };
    for (size_t size = 0; size < file.size(); ++size)
        tryToRead(file.substr(0, size));
    for (size_t at = 0; at < file.size(); ++at)
        for (const char value : {'\x00', '\x7f', '\xff'}) {
            std::string damaged = file;
            damaged[at] = value;
            tryToRead(damaged);
        }
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip, testing::Values(".png", ".jpg", ".exr", ".hdr"),
                         [](const auto& tested) { return tested.param.substr(1); });

/// Other programs find the texts where each format keeps them; OpenImageIO stands for them.
TEST(Metadata, IsReadByOthers) {
    for (const std::string extension : {".png", ".exr"}) {
        const Metadata written = sample(500);
        const std::string file = encodedAs(extension, written);
        OIIO::Filesystem::IOMemReader memory(file.data(), file.size());
        const auto input = OIIO::ImageInput::create(extension == ".png" ? "png" : "openexr");
        OIIO::ImageSpec hints;
        OIIO::Filesystem::IOProxy* proxy = &memory;
        hints.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
        OIIO::ImageSpec spec;
        ASSERT_TRUE(input->open("x" + extension, spec, hints));
        EXPECT_EQ(std::string(spec.get_string_attribute("lobe:settings")), written.at("lobe:settings"));
        EXPECT_EQ(std::string(spec.get_string_attribute("Software")), "lobe 0.1.0");
    }
}

TEST(Metadata, OfOthersIsRead) {
    const std::string png = codec::encode(".png", samples::bitmap(2, 2, 3, ComponentType::u8), {});
    // tEXt "Title\0caf\xe9", its checksum is not looked at.
    const std::string text("\0\0\0\x0atEXtTitle\0caf\xe9____", 22);
    const std::string annotated = png.substr(0, 33) + text + png.substr(33);
    EXPECT_EQ(codec::readMetadata(bytesOf(annotated)).at("Title"), "caf\u00e9");

    const std::string jpeg = codec::encode(".jpg", samples::bitmap(8, 8, 3, ComponentType::u8), {});
    const std::string commented = jpeg.substr(0, 2) + std::string("\xff\xfe\0\x07hello", 9) + jpeg.substr(2);
    EXPECT_EQ(codec::readMetadata(bytesOf(commented)).at("Comment"), "hello");
    EXPECT_TRUE(codec::readMetadata(bytesOf(samples::everyFormat().at("webp"))).empty());
}

}  // namespace
}  // namespace lobe
