// Settings: one canonical value whatever the spelling, and a fixed order of who wins.
#include "settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "base/error.hpp"

namespace lobe::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::string refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const UsageError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Settings, EverySpellingOfAResolutionIsOneValue) {
    for (const json& given : {json("1280,720"), json("1280x720"), json("1280X720"), json({1280, 720})})
        EXPECT_EQ(parseSetting(requireSetting("resolution", ""), given, "test"), json({1280, 720})) << given;
    for (const char* wrong :
         {"1280", "0,720", "-1,5", "1280.5,720", "a,b", "1,2,3", "20000,1", "", "1280,720,"})
        EXPECT_THAT(refusal([&] { parseSetting(requireSetting("resolution", ""), wrong, "test"); }),
                    HasSubstr("1 to 16384"))
            << wrong;
}

TEST(Settings, ColoursAreNumbersOrHexOrTransparent) {
    const Setting& setting = requireSetting("background", "");
    EXPECT_EQ(parseSetting(setting, "#ff0080", ""), json({1.0, 0.0, 128 / 255.0}));
    EXPECT_EQ(parseSetting(setting, "0,0.5,1", ""), json({0.0, 0.5, 1.0}));
    EXPECT_EQ(parseSetting(setting, "transparent", ""), "transparent");
    for (const char* wrong : {"#ff00", "#gg0000", "2,0,0", "red", "-0.1,0,0", "nan,0,0"})
        EXPECT_THAT(refusal([&] { parseSetting(setting, wrong, "test"); }), HasSubstr("transparent, #rrggbb"))
            << wrong;
}

TEST(Settings, NumbersOutOfRangeAreRefusedAndNotClamped) {
    EXPECT_THAT(refusal([] { Settings().set("jpeg_quality", "101", "here"); }),
                HasSubstr("here: jpeg_quality '101'; expected a whole number from 1 to 100"));
    EXPECT_THAT(refusal([] { Settings().set("exposure", "inf", "here"); }), HasSubstr("exposure"));
    EXPECT_THAT(refusal([] { Settings().set("frames", "1.5", "here"); }), HasSubstr("whole number"));
    EXPECT_THAT(refusal([] { Settings().set("exposure", true, "here"); }), HasSubstr("a number"));
}

TEST(Settings, UnknownKeysAndChoicesNameTheNearest) {
    EXPECT_THAT(refusal([] { Settings().set("tone_maping", "aces", "my.json"); }),
                HasSubstr("my.json: unknown setting 'tone_maping'; did you mean 'tone_mapping'?"));
    EXPECT_THAT(refusal([] { Settings().set("brdf", "lambret", "here"); }),
                HasSubstr("did you mean 'lambert'"));
    EXPECT_THAT(refusal([] { Settings().set("aov", "dept,normal", "here"); }),
                HasSubstr("did you mean 'depth'"));
}

TEST(Settings, LaterLayersWinButForMarkedValues) {
    Settings settings;
    settings.set("exposure", 1.0, "config");
    settings.set("exposure", 2.0, "command line");
    EXPECT_EQ(settings.get("exposure"), 2.0);
    settings.set("!exposure", 3.0, "config");
    settings.set("exposure", 4.0, "command line");
    EXPECT_EQ(settings.get("exposure"), 3.0) << "a marked value wins over later ones";
    settings.set("exposure", "!5", "command line");
    EXPECT_EQ(settings.get("exposure"), 5.0) << "but for another marked one";
    settings.reset("exposure", "command line");
    EXPECT_EQ(settings.get("exposure"), 0.0);
    settings.set("exposure", 6.0, "later");
    EXPECT_EQ(settings.get("exposure"), 6.0) << "a reset takes the mark away";
}

TEST(Settings, ChainNamesEachOrigin) {
    Settings settings;
    settings.set("brdf", "phong", "some.json");
    EXPECT_THAT(settings.chain(), HasSubstr("brdf = \"phong\" (some.json)"));
    EXPECT_THAT(settings.chain(), HasSubstr("quality = \"balanced\" (built-in)"));
}

TEST(Settings, ChainSaysWhatWasWonOver) {
    Settings settings;
    settings.set("exposure", 1.0, "a.json");
    settings.set("!exposure", 2.0, "b.json");
    settings.set("exposure", 3.0, "command line");
    EXPECT_THAT(
        settings.chain(),
        HasSubstr(
            "exposure = 2.0 (b.json) must win over 3.0 (command line), 1.0 (a.json), 0.0 (built-in)\n"));
    EXPECT_THAT(settings.chain(), HasSubstr("anti_aliasing = \"ssaa4\" (quality)\n"));
}

TEST(Settings, ListsAreSets) {
    const Setting& aov = requireSetting("aov", "");
    EXPECT_EQ(parseSetting(aov, "depth,radiance,depth", ""), json({"radiance", "depth"}));
    EXPECT_EQ(parseSetting(aov, json({"depth", "radiance"}), ""), json({"radiance", "depth"}));
    for (const json& wrong : {json(""), json("depth,"), json::array(), json(3), json({1})})
        EXPECT_THAT(refusal([&] { parseSetting(aov, wrong, "here"); }), HasSubstr("here: aov")) << wrong;
}

TEST(Settings, KnobsOfAQualityGiveThatQualityAgain) {
    for (const std::string& name : qualityPresetNames()) {
        Settings settings;
        settings.setAll(knobsOf(qualityPreset(name)), name);
        EXPECT_EQ(qualityOf(settings), qualityPreset(name)) << name;
    }
}

TEST(Settings, KnobsWinOverPresetsWhateverTheOrder) {
    Settings before, after;
    before.set("anti_aliasing", "none", "");
    before.set("quality", "converged", "");
    after.set("quality", "converged", "");
    after.set("anti_aliasing", "none", "");
    EXPECT_EQ(qualityOf(before), qualityOf(after));
    EXPECT_EQ(qualityOf(before).samples, 1);
    EXPECT_EQ(qualityOf(before).gbufferBits, 32);
}

TEST(Settings, EveryDefaultIsAValueOfItsSetting) {
    for (const Setting& setting : settingTable()) {
        if (!setting.defaultValue.is_null()) {
            EXPECT_NO_THROW(parseSetting(setting, setting.defaultValue, "")) << setting.key;
        }
    }
    EXPECT_NO_THROW(Settings().setAll(Settings().toJson(), "what was written can be read"));
}

}  // namespace
}  // namespace lobe::app
