/// Damaged and hostile files through the worker: each ends in a picture or in InputError, and the worker goes
/// on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "base/error.hpp"
#include "codec/codec.hpp"
#include "codec/sample_files.hpp"
#include "image/image_files.hpp"

namespace lobe {
namespace {

using samples::bytesOf;
using std::chrono::steady_clock;

const WorkerLimits kLimits{size_t{1} << 30, std::chrono::milliseconds(20'000)};

/// Counts what became of many files; fails the test on any end but the two allowed ones.
struct Outcomes {
    int pictures = 0;
    int refusals = 0;
    int deaths = 0;  ///< of the refusals

    void decode(ImageFiles& files, const std::string& content) {
        try {
            const Bitmap bitmap = files.decode(bytesOf(content), "sample");
            EXPECT_EQ(bitmap.data.size(),
                      static_cast<size_t>(bitmap.width) * static_cast<size_t>(bitmap.height) *
                          static_cast<size_t>(bitmap.channels) * bitmap.bytesPerComponent());
            ++pictures;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::StartsWith("sample: "));
            EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n"))) << "one line";
            ++refusals;
            // The worker's own ends: "the decoder crashed (signal 11)", "the decoder needs more than ...".
            if (std::string_view(error.what()).starts_with("sample: the decoder ")) ++deaths;
        }
    }
};

class Hostile : public testing::TestWithParam<std::string> {
protected:
    ~Hostile() override { EXPECT_LT(steady_clock::now() - begin_, std::chrono::seconds(60)); }
    ImageFiles files_{kLimits};
    std::string sample_ = samples::everyFormat().at(GetParam());

private:
    steady_clock::time_point begin_ = steady_clock::now();
};

TEST_P(Hostile, Truncated) {
    Outcomes outcomes;
    const size_t step = std::max<size_t>(1, sample_.size() / 200);
    for (size_t size = 0; size < sample_.size(); size += step)
        outcomes.decode(files_, sample_.substr(0, size));
    EXPECT_GT(outcomes.refusals, 0);
    outcomes.decode(files_, sample_);
    EXPECT_GT(outcomes.pictures, 0) << "the worker still reads the whole file";
}

TEST_P(Hostile, BitFlips) {
    Outcomes outcomes;
    std::mt19937 random(20);
    for (int i = 0; i < 300; ++i) {
        std::string damaged = sample_;
        for (int flips = 0; flips < 1 + i % 4; ++flips) {
            const size_t bit = random() % (damaged.size() * 8);
            damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << bit % 8));
        }
        outcomes.decode(files_, damaged);
    }
    EXPECT_EQ(outcomes.pictures + outcomes.refusals, 300);
    outcomes.decode(files_, sample_);
}

/// The first bytes hold sizes and counts: every one of them at its extremes.
TEST_P(Hostile, HeaderExtremes) {
    Outcomes outcomes;
    const size_t end = std::min<size_t>(sample_.size(), 120);
    for (size_t at = 0; at + 4 <= end; ++at)
        for (const char value : {'\x00', '\x7f', '\xff'})
            outcomes.decode(files_, std::string(sample_).replace(at, 4, std::string(4, value)));
    EXPECT_GT(outcomes.refusals, 0);
    outcomes.decode(files_, sample_);
}

INSTANTIATE_TEST_SUITE_P(Files, Hostile,
                         testing::Values("png", "png16", "palette", "jpeg", "webp", "hdr", "exr", "tiled"),
                         [](const auto& tested) { return tested.param; });

/// OpenImageIO itself takes 72 MiB of address space for the smallest picture.
const WorkerLimits kSmall{size_t{160} << 20, std::chrono::milliseconds(20'000)};

TEST(HostileFiles, ImpossibleSizesCostNothing) {
    ImageFiles files(kSmall);
    const auto begin = steady_clock::now();
    Outcomes outcomes;
    outcomes.decode(files, samples::png({0x7fffffff, 0x7fffffff, 16, 6, "", "", "x"}));
    outcomes.decode(files, samples::png({16384, 16384, 8, 6, "", "", "x"}));
    outcomes.decode(files, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2000000000 +X 2000000000\n" +
                               std::string(100, '\2'));
    outcomes.decode(files, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y -5 +X 99999999999999\n");
    outcomes.decode(
        files,
        std::string("\xff\xd8\xff\xc0\x00\x11\x08\xff\xff\xff\xff\x03\x01\x22\x00\x02\x11\x01\x03\x11\x01",
                    21));
    outcomes.decode(files, "RIFF\xff\xff\xff\xffWEBPVP8X" + std::string(18, '\xff'));
    EXPECT_EQ(outcomes.refusals, 6);
    EXPECT_EQ(outcomes.deaths, 0) << "refused by their size, before memory is asked for";
    EXPECT_LT(steady_clock::now() - begin, std::chrono::seconds(10));
}

/// Half of the rows could be read. (In a worker also because OpenImageIO leaks the message.)
TEST(HostileFiles, PixelsOfADamagedFileAreDiscarded) {
    ImageFiles files(kLimits);
    std::string file = codec::encode(".png", samples::bitmap(64, 64, 3, ComponentType::u8), {});
    file.resize(file.size() / 2);
    try {
        files.decode(bytesOf(file), "half.png");
        FAIL() << "half a picture was taken for a whole one";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::StartsWith("half.png: file is damaged: "));
    }
}

/// A picture that is within all limits of size, but not within this worker's memory.
TEST(HostileFiles, MemoryLimitIsNamed) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the address sanitizer's own memory can't be told from the decoder's";
#endif
    ImageFiles files(kSmall);
    const std::string large = codec::encode(
        ".png", Bitmap{8192, 8192, 3, ComponentType::u8, std::vector<std::byte>(size_t{8192} * 8192 * 3)},
        {});
    try {
        files.decode(bytesOf(large), "large.png");
        FAIL() << "200 MB in 160 MiB";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "large.png: the decoder needs more than 160 MiB");
    }
    EXPECT_EQ(files.decode(bytesOf(samples::everyFormat().at("png")), "small.png").width, 13);
}

/// Embedded XMP and profiles are where OpenImageIO's readers crash; they never reach them.
TEST(HostileFiles, DamagedMetadataDoesNotCostThePicture) {
    ImageFiles files(kLimits);
    const std::string png = samples::everyFormat().at("png");
    std::string nested;
    for (int i = 0; i < 100'000; ++i)
        nested += "<rdf:x>";
    WriteOptions options;
    options.metadata = {{"XML:com.adobe.xmp", "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\"><rdf:RDF>" + nested}};
    const Bitmap plain = codec::decode(bytesOf(png));
    const std::string withXmp = codec::encode(".png", plain, options);
    EXPECT_EQ(files.decode(bytesOf(withXmp), "xmp.png").data, plain.data);

    const std::string jpeg = samples::everyFormat().at("jpeg");
    const Bitmap expected = codec::decode(bytesOf(jpeg));
    const std::string profile = "ICC_PROFILE" + std::string(1, '\0') + "\x01\x01" + std::string(200, '\xff');
    std::string segment = "\xff\xe2";
    segment += static_cast<char>((profile.size() + 2) >> 8);
    segment += static_cast<char>((profile.size() + 2) & 0xffU);
    const std::string withProfile = jpeg.substr(0, 2) + segment + profile + jpeg.substr(2);
    EXPECT_EQ(files.decode(bytesOf(withProfile), "icc.jpg").data, expected.data);
}

}  // namespace
}  // namespace lobe
