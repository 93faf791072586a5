#include "image/image_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <limits>

#include "base/error.hpp"

namespace lobe {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

class ImageFilesTest : public testing::Test {
protected:
    ImageFilesTest() {
        std::string name = (fs::temp_directory_path() / "lobe-files-XXXXXX").string();
        folder = mkdtemp(name.data());
        bitmap.data.resize(size_t{32} * 20 * 3);
        for (size_t i = 0; i < bitmap.data.size(); ++i)
            bitmap.data[i] = static_cast<std::byte>(i * 37);
        for (size_t i = 0; i < image.values.size(); ++i)
            image.values[i] = static_cast<float>(i) / 64.0F;  // exact in half
    }
    ~ImageFilesTest() override { fs::remove_all(folder); }

    std::vector<std::string> entries() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder))
            names.push_back(entry.path().filename().string());
        return names;
    }

    fs::path folder;
    Bitmap bitmap{32, 20, 3, ComponentType::u8, {}};
    Image image{20, 10, {"R", "G", "B", "A", "normal.X"}};
    ImageFiles files;
};

template<class Action>
std::string messageOf(const Action& action) {
    try {
        action();
    } catch (const InputError& error) {
        return std::string("input: ") + error.what();
    } catch (const OutputError& error) {
        return std::string("output: ") + error.what();
    }
    return "no error";
}

TEST_F(ImageFilesTest, RoundTripsEachExtension) {
    WriteOptions options;
    options.metadata["lobe:settings"] = "{\"name\": \"caf\u00e9\",\n\"x\": [1, 2]}";
    for (const std::string& extension : ImageFiles::displayExtensions())
        files.write(folder / "new" / ("display" + extension), bitmap, options);
    for (const std::string& extension : ImageFiles::linearExtensions())
        files.write(folder / "new" / ("linear" + extension), image, options);
    for (const auto& entry : fs::directory_iterator(folder / "new")) {
        const Image read = files.read(entry.path());
        EXPECT_GT(read.width, 0);
        EXPECT_EQ(files.readMetadata(entry.path()).at("lobe:settings"), options.metadata["lobe:settings"])
            << entry.path();
    }
    const Image png = files.read(folder / "new" / "display.png");
    ASSERT_EQ(png.values.size(), bitmap.data.size());
    for (size_t i = 0; i < png.values.size(); ++i)
        ASSERT_FLOAT_EQ(png.values[i], static_cast<float>(std::to_integer<int>(bitmap.data[i])) / 255.0F);
    const Image exr = files.read(folder / "new" / "linear.exr");
    EXPECT_THAT(exr.channels, testing::UnorderedElementsAreArray(image.channels));
    EXPECT_EQ(exr.pixel(7, 3)[0], image.pixel(7, 3)[0]);
}

TEST_F(ImageFilesTest, KeepsPlantedNonFiniteValues) {
    image.pixel(3, 4)[1] = std::numeric_limits<float>::quiet_NaN();
    image.pixel(5, 6)[4] = std::numeric_limits<float>::infinity();
    files.write(folder / "bad.exr", image, {});
    const NonFinite found = countNonFinite(files.read(folder / "bad.exr"));
    EXPECT_EQ(found.pixels, 2U);
    EXPECT_EQ(found.firstX, 3);
    EXPECT_EQ(found.firstY, 4);
    EXPECT_EQ(found.firstChannel, "G");
}

TEST_F(ImageFilesTest, NamesTheFileThatCannotBeRead) {
    std::ofstream(folder / "empty.png").close();
    std::ofstream(folder / "text.png") << "not a picture";
    mkfifo((folder / "pipe.png").c_str(), 0600);
    const std::vector<std::pair<fs::path, std::string>> cases = {
        {folder / "missing.png", "No such file or directory"},
        {folder, "Is a directory"},
        {folder / "empty.png", "file is empty"},
        {folder / "text.png", "format is unknown"},
        {folder / "pipe.png", "not a regular file"},
        {"/dev/zero", "not a regular file"},
    };
    for (const auto& [path, reason] : cases) {
        const fs::path& file = path;  // lambdas take no structured bindings
        EXPECT_THAT(messageOf([&] { files.read(file); }),
                    StartsWith("input: " + file.string() + ": " + reason));
        EXPECT_THAT(messageOf([&] { files.readMetadata(file); }),
                    StartsWith("input: " + file.string() + ": " + reason));
    }
    EXPECT_THAT(messageOf([&] { files.decode({}, "a.gltf: images[2]"); }),
                StartsWith("input: a.gltf: images[2]: file is empty"));
}

TEST_F(ImageFilesTest, NamesTheFileThatCannotBeWritten) {
    std::ofstream(folder / "file").close();
    EXPECT_EQ(messageOf([&] { files.write(folder / "file" / "x.png", bitmap, {}); }),
              "output: " + (folder / "file" / "x.png").string() + ": can't be written: Not a directory");
    EXPECT_THAT(
        messageOf([&] { files.write(folder / "x.bmp", bitmap, {}); }),
        StartsWith("output: " + (folder / "x.bmp").string() + ": can't be written: extension: '.bmp'"));
    EXPECT_THAT(messageOf([&] { files.write(folder / "x.png", image, {}); }),
                HasSubstr("expected .exr or .hdr"));
    EXPECT_THAT(messageOf([&] { files.write(folder / "x.exr", bitmap, {}); }),
                HasSubstr("expected .png, .jpg"));
    image.values[0] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(messageOf([&] { files.write(folder / "x.hdr", image, {}); }), HasSubstr("NaN or infinity"));
    EXPECT_THAT(entries(), testing::ElementsAre("file"));
}

/// A device that is always full; tests/base/atomic_file_test.cpp shows that a real file stays whole.
TEST_F(ImageFilesTest, NamesAFullDisk) {
    fs::create_symlink("/dev/full", folder / "full.png");
    fs::create_symlink("/dev/full", folder / "full.exr");
    const std::string reason = ": can't be written: No space left on device";
    EXPECT_EQ(messageOf([&] { files.write(folder / "full.png", bitmap, {}); }),
              "output: " + (folder / "full.png").string() + reason);
    EXPECT_EQ(messageOf([&] { files.write(folder / "full.exr", image, {}); }),
              "output: " + (folder / "full.exr").string() + reason);
}

TEST_F(ImageFilesTest, DoesNotLoadDecodersIntoThisProgram) {
    files.write(folder / "x.png", bitmap, {});
    std::ifstream maps("/proc/self/maps");
    const std::string text((std::istreambuf_iterator<char>(maps)), {});
    EXPECT_THAT(text, testing::Not(HasSubstr("OpenImageIO")));
}

}  // namespace
}  // namespace lobe
