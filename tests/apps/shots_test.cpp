// Which pictures a command line or batch asks for, and under which names.
#include "shots.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <set>

#include "base/error.hpp"
#include "batch.hpp"
#include "output_name.hpp"

namespace lobe::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A folder of the test's own.
class Batches : public testing::Test {
protected:
    Batches() { fs::create_directories(folder_); }
    ~Batches() override { fs::remove_all(folder_); }
    fs::path write(const std::string& text) const {
        std::ofstream(folder_ / "jobs.json") << text;
        return folder_ / "jobs.json";
    }
    std::string refusal(const std::string& text) const {
        try {
            auto shots = shotsOfBatch(write(text), {});
            nameOutputs(shots);
        } catch (const Error& error) {
            return error.what();
        }
        return "accepted";
    }
    fs::path folder_ = fs::path(testing::TempDir()) / ("lobe-batches-" + std::to_string(getpid()));
};

std::vector<Shot> numbered(int count) {
    std::vector<Shot> shots(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i)
        shots[static_cast<size_t>(i)].number = i + 1;
    return shots;
}

TEST(Shards, EveryShotIsInExactlyOneShard) {
    for (const int count : {0, 1, 7, 100})
        for (const int shards : {1, 2, 3, 8}) {
            std::multiset<int> seen;
            for (int i = 1; i <= shards; ++i)
                for (const Shot& shot :
                     shard(numbered(count), std::to_string(i) + "/" + std::to_string(shards)))
                    seen.insert(shot.number);
            EXPECT_EQ(seen.size(), static_cast<size_t>(count));
            EXPECT_EQ(std::set<int>(seen.begin(), seen.end()).size(), static_cast<size_t>(count));
        }
    for (const char* wrong :
         {"0/2", "3/2", "1", "a/b", "1/0", "-1/2", "/", "1x/2", "1/2x", "1/2/3", " 1/2", "+1/2", ""})
        EXPECT_THROW(shard(numbered(3), wrong), UsageError) << wrong;
}

TEST(Templates, FieldsPaddingEscapesAndHashes) {
    const std::map<std::string, std::string> values = {{"model", "helmet"}, {"n", "7"}, {"frame", "12"}};
    EXPECT_EQ(expandTemplate("out/{model}_{n:3}.png", values), "out/helmet_007.png");
    EXPECT_EQ(expandTemplate("a{{b}}c_####", values), "a{b}c_0007");
    EXPECT_EQ(expandTemplate("{frame:1}", values), "12");
    EXPECT_EQ(expandTemplate("{model}", {{"model", "a/b"}}), "a_b") << "a value makes no folder";
    for (const char* wrong : {"{modle}", "{model", "model}", "{n:x}", "{n:}", "{model:3}", "{n:100}", "{}"})
        EXPECT_THROW(expandTemplate(wrong, values), UsageError) << wrong;
    try {
        expandTemplate("{modle}", values);
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(), HasSubstr("did you mean 'model'"));
    }
}

TEST_F(Batches, PresetsInheritAndShotsWin) {
    const auto shots =
        shotsOfBatch(write(R"({"presets": {"a": {"exposure": 1, "resolution": [64, 32], "brdf": "phong"},
                                                          "b": {"inherits": "a", "exposure": 2}},
                                              "shots": [{"scene": "x.gltf", "preset": "b", "brdf": "lambert"},
                                                        {"scene": ["x.gltf", "y.gltf"], "frames": 2, "output": "{model}{frame}.png"}]})"),
                     {});
    ASSERT_EQ(shots.size(), 5u);
    EXPECT_EQ(shots[0].settings->get("exposure"), 2.0);
    EXPECT_EQ(shots[0].settings->get("resolution"), nlohmann::json({64, 32}));
    EXPECT_EQ(shots[0].settings->get("brdf"), "lambert");
    EXPECT_EQ(shots[0].scene, folder_ / "x.gltf") << "relative to the batch file";
    EXPECT_EQ(shots[4].frame, 1);
    EXPECT_EQ(shots[4].number, 5);
}

TEST_F(Batches, CommandLineWinsOverTheFileButForMarkedValues) {
    SettingSources sources;
    sources.assignments = {{Assignment::Kind::set, "exposure", "9"}, {Assignment::Kind::set, "time", "9"}};
    const auto shots =
        shotsOfBatch(write(R"({"shots": [{"scene": "x.gltf", "exposure": 1, "!time": 1}]})"), sources);
    EXPECT_EQ(shots[0].settings->get("exposure"), 9.0);
    EXPECT_EQ(shots[0].settings->get("time"), 1.0);
}

TEST_F(Batches, MistakesAreNamedWithTheirPlace) {
    EXPECT_THAT(refusal("{"), HasSubstr("jobs.json:1:1: not JSON"));
    EXPECT_THAT(refusal(R"({"shots": []})"), HasSubstr("at least one"));
    EXPECT_THAT(refusal(R"({"shot": []})"), HasSubstr("unknown key 'shot'"));
    EXPECT_THAT(refusal(R"({"shots": [{"preset": "a"}]})"),
                HasSubstr("shots[0]: expected an object with a \"scene\""));
    EXPECT_THAT(refusal(R"({"shots": [{"scene": "x.gltf", "preset": "a"}]})"),
                HasSubstr("preset 'a' is not defined"));
    EXPECT_THAT(refusal(R"({"shots": [{"scene": "x.gltf", "expsure": 1}]})"),
                HasSubstr("shots[0]: unknown setting 'expsure'; did you mean 'exposure'"));
    EXPECT_THAT(
        refusal(
            R"({"presets": {"a": {"inherits": "b"}, "b": {"inherits": "a"}}, "shots": [{"scene": "x", "preset": "a"}]})"),
        HasSubstr("inherits from itself"));
    EXPECT_THAT(
        refusal(
            R"({"shots": [{"scene": "x.gltf", "output": "a.png"}, {"scene": "y.gltf", "output": "a.png"}]})"),
        HasSubstr("is the name of two pictures"));
    EXPECT_THAT(
        refusal(
            R"({"shots": [{"scene": "x.gltf", "output": "a.png"}, {"scene": "y.gltf", "output": "./b/../a.png"}]})"),
        HasSubstr("is the name of two pictures"));
    EXPECT_THAT(refusal(R"({"presets": {"unused": {"expsure": 1}}, "shots": [{"scene": "x.gltf"}]})"),
                HasSubstr("preset unused: unknown setting 'expsure'"));
    EXPECT_THAT(refusal(R"({"presets": {"a": {"inherits": 3}}, "shots": [{"scene": "x.gltf"}]})"),
                HasSubstr("preset 'a': inherits 3; expected a name"));
    EXPECT_THAT(refusal(R"({"presets": {"a": {"inherits": "b"}}, "shots": [{"scene": "x.gltf"}]})"),
                HasSubstr("inherits 'b'; expected one of a"));
    EXPECT_THAT(refusal(R"({"schema": 2, "shots": [{"scene": "x.gltf"}]})"),
                HasSubstr("schema: 2; expected 1"));
    EXPECT_THAT(refusal(R"({"shots": [{"scene": [1]}]})"), HasSubstr("shots[0].scene: 1; expected a path"));
    EXPECT_THAT(refusal(R"({"shots": [{"scene": []}]})"), HasSubstr("at least one"));
    EXPECT_THAT(refusal(R"({"shots": [{"scene": "x.gltf", "preset": {}}]})"), HasSubstr("shots[0].preset"));
    EXPECT_THAT(
        refusal(R"({"shots": [{"scene": "x.gltf", "background": "transparent", "output": "a.jpg"}]})"),
        HasSubstr("expected a .png file"));
    EXPECT_THAT(refusal(R"({"shots": [{"scene": "x.gltf", "output": "a.bmp"}]})"),
                HasSubstr("expected .png, .jpg, .exr or .hdr"));
    EXPECT_THAT(
        refusal(R"({"shots": [{"scene": "x.gltf", "output": "a.png", "aov": ["radiance", "depth"]}]})"),
        HasSubstr(".exr"));
}

TEST(Configs, BlocksApplyToMatchingScenes) {
    const Config config(nlohmann::json::parse(R"([{"settings": {"exposure": 1}},
                                                  {"match": "*.glb", "settings": {"exposure": 2}},
                                                  {"match": {"exact": "a.gltf"}, "settings": {"exposure": 3}},
                                                  {"match": {"regex": "^b"}, "settings": {"exposure": 4}}])"),
                        "test.json");
    const auto exposure = [&](const char* scene) {
        Settings settings;
        config.apply(scene, settings);
        return settings.get("exposure").get<double>();
    };
    EXPECT_EQ(exposure("x.gltf"), 1.0);
    EXPECT_EQ(exposure("x.glb"), 2.0);
    EXPECT_EQ(exposure("a.gltf"), 3.0);
    EXPECT_EQ(exposure("b.gltf"), 4.0);
}

}  // namespace
}  // namespace lobe::app
