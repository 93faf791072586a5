// Small parts of lobe-view: what is kept between runs, files that change, colours of quantities.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "base/error.hpp"
#include "commands.hpp"
#include "file_watch.hpp"
#include "image/tone.hpp"
#include "preferences.hpp"
#include "shown.hpp"

namespace lobe::view {
namespace {

namespace fs = std::filesystem;

struct Folder {
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    fs::path path = fs::temp_directory_path() / ("lobe_parts_" + std::to_string(getpid()));
};

TEST(Preferences, AreKeptAndDamagedOnesAreAsAtFirst) {
    const Folder folder;
    setenv("XDG_CONFIG_HOME", folder.path.c_str(), 1);
    Preferences kept;
    for (int i = 0; i < 20; ++i)
        kept.addRecent("/scene" + std::to_string(i));
    kept.addRecent("/scene15");
    kept.width = 1500;
    kept.views["/scene15"]["above"] = {{1.5, 2.0, 3.0}, {0.0, 0.25, 0.0}, 30.0};
    kept.save();
    const Preferences back = Preferences::load();
    EXPECT_EQ(back.recent, kept.recent);
    EXPECT_EQ(back.recent.size(), 12U);
    EXPECT_EQ(back.recent[0], "/scene15");
    EXPECT_EQ(back.width, 1500);
    EXPECT_EQ(back.views, kept.views);
    for (const char* damaged : {"{", "[]", "{\"recent\": 3}", "{\"views\": {\"a\": {\"b\": {}}}}"}) {
        std::ofstream(folder.path / "lobe" / "view.json") << damaged;
        EXPECT_EQ(Preferences::load().width, Preferences().width) << damaged;
        EXPECT_TRUE(Preferences::load().recent.empty()) << damaged;
    }
    unsetenv("XDG_CONFIG_HOME");
}

TEST(FileWatch, SeesFilesWrittenAddedAndRemovedOnce) {
    const Folder folder;
    std::ofstream(folder.path / "a.glsl") << "one";
    FileWatch watch(folder.path);
    EXPECT_FALSE(watch.changed());
    fs::last_write_time(folder.path / "a.glsl",
                        fs::last_write_time(folder.path / "a.glsl") + std::chrono::seconds(3));
    EXPECT_TRUE(watch.changed());
    EXPECT_FALSE(watch.changed());
    std::ofstream(folder.path / "b.frag") << "two";
    EXPECT_TRUE(watch.changed());
    fs::remove(folder.path / "a.glsl");
    EXPECT_TRUE(watch.changed());
    EXPECT_FALSE(watch.changed());
}

Image pixels(const std::vector<std::string>& channels, const std::vector<float>& values) {
    Image image(static_cast<int>(values.size() / channels.size()), 1, channels);
    image.values = values;
    return image;
}

std::array<int, 3> colorAt(const Bitmap& bitmap, size_t pixel) {
    std::array<int, 3> color{};
    for (size_t c = 0; c < 3; ++c)
        color[c] = std::to_integer<int>(bitmap.data[pixel * static_cast<size_t>(bitmap.channels) + c]);
    return color;
}

TEST(Shown, RadianceIsWhatPicturesHaveAndPartsAreToneMappedAlike) {
    app::Settings settings;
    settings.set("exposure", 1.0, "test");
    const Image image = pixels({"R", "G", "B", "A", "point.R", "point.G", "point.B"},
                               {0.1F, 0.2F, 0.3F, 1.0F, 0.05F, 0.1F, 0.1F});
    const Display whole = displayOf(image, {}, settings);
    EXPECT_THAT(colorAt(whole.bitmap, 0),
                testing::ElementsAre(encodeSrgb8(0.2F), encodeSrgb8(0.4F), encodeSrgb8(0.6F)));
    const Display part = displayOf(image, {Aov::contributions, "point"}, settings);
    EXPECT_THAT(colorAt(part.bitmap, 0),
                testing::ElementsAre(encodeSrgb8(0.1F), encodeSrgb8(0.2F), encodeSrgb8(0.2F)));
    EXPECT_THROW(displayOf(image, {Aov::contributions, "spot"}, settings), InputError);
}

TEST(Shown, FalseColoursSpanTheLegendAndNothingIsBlack) {
    const Image image = pixels({"depth.Z"}, {0.0F, 2.0F, 6.0F});
    const Display display = displayOf(image, {Aov::depth, {}}, app::Settings());
    EXPECT_TRUE(display.legend.used);
    EXPECT_EQ(display.legend.low, 2.0);
    EXPECT_EQ(display.legend.high, 6.0);
    const auto low = falseColor(0.0), high = falseColor(1.0);
    EXPECT_THAT(colorAt(display.bitmap, 0), testing::ElementsAre(0, 0, 0));
    EXPECT_THAT(colorAt(display.bitmap, 1), testing::ElementsAre(low[0], low[1], low[2]));
    EXPECT_THAT(colorAt(display.bitmap, 2), testing::ElementsAre(high[0], high[1], high[2]));
}

TEST(Commands, NoKeyDoesTwoThingsAndEveryCommandHasAMenu) {
    std::set<std::string> keys, names;
    for (const Command& command : commandTable()) {
        EXPECT_FALSE(command.menu.empty()) << command.name;
        EXPECT_TRUE(names.insert(command.menu + command.name).second) << command.name;
        if (command.key != 0) {
            EXPECT_TRUE(keys.insert(command.keyText()).second) << command.keyText();
        }
    }
}

}  // namespace
}  // namespace lobe::view
