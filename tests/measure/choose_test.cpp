// Choosing from a report, and holding two against each other.
#include "measure/choose.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "measure/against.hpp"
#include "plan/knobs.hpp"

namespace lobe::measure {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json setting(const char* antiAliasing, double milliseconds, double error) {
    json knobs = json::object();
    for (const auto& [name, value] : knobValues({}))
        knobs[name] = value;
    knobs["anti_aliasing"] = antiAliasing;
    return {{"label", antiAliasing},
            {"knobs", knobs},
            {"time",
             {{"median_ms", 2 * milliseconds},
              {"low_ms", 1.9 * milliseconds},
              {"high_ms", 2.1 * milliseconds},
              {"wall_ms", milliseconds}}},
            {"error", {{"relmse", error}, {"psnr", 10.0 / error}, {"non_finite", 0}}}};
}

json scene(const char* name, double worse = 1.0) {
    return {{"scene", name},
            {"camera", "main"},
            {"content_hash", std::string("hash of ") + name},
            {"width", 100},
            {"height", 100},
            {"truth", {{"standard_error", 0.01}}},
            {"settings",
             {setting("none", 10.0 * worse, 0.1 * worse), setting("ssaa4", 40.0 * worse, 0.03 * worse),
              setting("ssaa16", 160.0 * worse, 0.001 * worse)}}};
}

json report(const std::vector<json>& scenes) {
    return {{"schema", 1}, {"context", {{"clock", "process cpu"}}}, {"scenes", scenes}};
}

std::string refusal(const json& from, const Goal& goal) {
    try {
        choose(from, "hash of a", 1e4, goal);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "chosen";
}

TEST(Choose, TheFastestThatKeepsTheError) {
    const Chosen chosen = choose(report({scene("a")}), "hash of a", 1e4, {.maxError = 0.05});
    EXPECT_EQ(chosen.quality.samples, 4);
    EXPECT_EQ(chosen.error, 0.03);
    EXPECT_EQ(chosen.milliseconds, 40.0) << "on the wall, where the clock is the processor's";
    EXPECT_EQ(chosen.basis, "measured on this scene");
    EXPECT_EQ(choose(report({scene("a")}), "hash of a", 1e4, {.maxError = 0.2}).quality.samples, 1);
}

TEST(Choose, TheLeastWrongWithinTheBudget) {
    EXPECT_EQ(choose(report({scene("a")}), "hash of a", 1e4, {.budget = 50.0}).quality.samples, 4);
    EXPECT_EQ(choose(report({scene("a")}), "hash of a", 4e4, {.budget = 50.0}).quality.samples, 1)
        << "four times the pixels take four times the time";
}

TEST(Choose, OtherMetricsMayBeBetterWhenLarger) {
    const Chosen chosen =
        choose(report({scene("a")}), "hash of a", 1e4, {.maxError = 200.0, .metric = "psnr"});
    EXPECT_EQ(chosen.quality.samples, 4);
}

TEST(Choose, AnUnknownSceneIsJudgedByTheWorst) {
    const Chosen chosen = choose(report({scene("b"), scene("c", 2.0)}), "hash of a", 1e4, {.maxError = 0.06});
    EXPECT_EQ(chosen.quality.samples, 4);
    EXPECT_EQ(chosen.error, 0.06);
    EXPECT_EQ(chosen.milliseconds, 80.0);
    EXPECT_THAT(chosen.basis, HasSubstr("no promise"));
    // Its own entry is taken alone where there is one.
    EXPECT_EQ(choose(report({scene("a"), scene("c", 2.0)}), "hash of a", 1e4, {.maxError = 0.03}).error,
              0.03);
}

TEST(Choose, WhatIsOutOfReachSaysTheBest) {
    EXPECT_THAT(
        refusal(report({scene("a")}), {.maxError = 1e-4}),
        HasSubstr("--max-error 0.0001 can't be kept; the best that can be had is relmse 0.001 in 160 ms"));
    EXPECT_THAT(refusal(report({scene("a")}), {.budget = 1.0}), HasSubstr("relmse 0.1 in 10 ms"));
    EXPECT_THAT(refusal(report({scene("a")}), {.maxError = 0.05, .budget = 20.0}),
                HasSubstr("--max-error 0.05 with --budget 20ms"));
    EXPECT_THAT(refusal(report({}), {.maxError = 0.05}), HasSubstr("no setting"));
    EXPECT_THAT(refusal(report({scene("a")}), {.maxError = 0.05, .metric = "flip"}),
                HasSubstr("no setting with an error 'flip'"));
}

TEST(Choose, Durations) {
    EXPECT_EQ(parseDuration("--budget", "16ms"), 16.0);
    EXPECT_EQ(parseDuration("--budget", "16.5 ms"), 16.5);
    EXPECT_EQ(parseDuration("--budget", "0.5s"), 500.0);
    EXPECT_EQ(parseDuration("--budget", "16"), 16.0);
    for (const char* wrong : {"", "ms", "-1ms", "0", "16m", "nan", "inf", "1e999ms"})
        EXPECT_THROW(parseDuration("--budget", wrong), UsageError) << wrong;
}

TEST(Against, EqualReportsHaveNoChange) {
    const ReportChanges changes = compareReports(report({scene("a")}), report({scene("a")}));
    EXPECT_EQ(changes.compared, 3u);
    EXPECT_TRUE(changes.regressions.empty());
    EXPECT_TRUE(changes.improvements.empty());
    EXPECT_TRUE(changes.notes.empty());
}

TEST(Against, TimesBeyondTheirIntervalsAreFlagged) {
    json now = report({scene("a")});
    json& time = now["scenes"][0]["settings"][1]["time"];
    for (const char* key : {"median_ms", "low_ms", "high_ms"})
        time[key] = time[key].get<double>() * 1.2;
    const ReportChanges slower = compareReports(now, report({scene("a")}));
    ASSERT_EQ(slower.regressions.size(), 1u);
    EXPECT_THAT(slower.regressions[0], HasSubstr("a, ssaa4: time 80 -> 96 ms (1.2 x)"));
    EXPECT_EQ(compareReports(report({scene("a")}), now).improvements.size(), 1u);
    time["low_ms"] = 80.0;  // touches the other interval
    EXPECT_TRUE(compareReports(now, report({scene("a")})).regressions.empty());
}

TEST(Against, ErrorsBeyondTheTruthsOwnAreFlagged) {
    json now = report({scene("a")});
    json& error = now["scenes"][0]["settings"][2]["error"]["relmse"];
    error = 0.0026;  // root 0.0510, was 0.0316; both truths together 0.02
    EXPECT_TRUE(compareReports(now, report({scene("a")})).regressions.empty());
    error = 0.0027;  // root 0.0520
    EXPECT_THAT(compareReports(now, report({scene("a")})).regressions,
                testing::ElementsAre(HasSubstr("error (root of relmse)")));
    now["scenes"][0]["settings"][2]["error"] = {{"relmse", nullptr}, {"non_finite", 3}};
    EXPECT_THAT(compareReports(now, report({scene("a")})).regressions,
                testing::ElementsAre(HasSubstr("3 non-finite pixels")));
}

TEST(Against, WhatCanNotBeComparedIsSaid) {
    json now = report({scene("a"), scene("b")});
    now["scenes"][0]["content_hash"] = "other";
    now["scenes"][0]["settings"].push_back(setting("ssaa8", 1.0, 1.0));
    EXPECT_THAT(
        compareReports(now, report({scene("a")})).notes,
        testing::UnorderedElementsAre(HasSubstr("content has changed"), HasSubstr("1 settings are not"),
                                      HasSubstr("b: is not in the other report")));
    EXPECT_THROW(compareReports(report({scene("b")}), report({scene("a")})), InputError);
}

}  // namespace
}  // namespace lobe::measure
