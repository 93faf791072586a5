// The list of quality knobs: each value can be set and is read back, and presets are made of it.
#include "plan/knobs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "base/error.hpp"

namespace lobe {
namespace {

TEST(Knobs, EachValueIsReadBackAndChangesNoOtherKnob) {
    for (const Knob& knob : knobTable()) {
        std::set<std::string> seen;
        for (const std::string& value : knob.values) {
            EXPECT_TRUE(seen.insert(value).second) << knob.name << " has " << value << " twice";
            Quality quality;
            setKnob(quality, knob.name, value);
            for (const auto& [name, now] : knobValues(quality))
                EXPECT_EQ(now, name == knob.name ? value : requireKnob(name).get({})) << knob.name;
        }
        EXPECT_GE(knob.values.size(), 2u) << knob.name;
    }
}

TEST(Knobs, KnobsHoldAllOfAQuality) {
    for (const std::string& preset : qualityPresetNames()) {
        Quality again;
        for (const auto& [name, value] : knobValues(qualityPreset(preset)))
            setKnob(again, name, value);
        EXPECT_EQ(again, qualityPreset(preset)) << preset << ": a field of Quality without a knob?";
    }
}

TEST(Knobs, WrongNamesAndValuesAreRefused) {
    Quality quality;
    const auto message = [&](const char* name, const char* value) -> std::string {
        try {
            setKnob(quality, name, value);
        } catch (const UsageError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_THAT(message("anti_aliasin", "none"), testing::HasSubstr("did you mean 'anti_aliasing'?"));
    EXPECT_THAT(message("anti_aliasing", "ssaa3"), testing::HasSubstr("none, ssaa4, ssaa16"));
    EXPECT_THAT(message("cluster_from", "-1"), testing::HasSubstr("from 0 to 1000000"));
    EXPECT_THAT(message("cluster_from", "1x"), testing::HasSubstr("from 0 to 1000000"));
    EXPECT_EQ(quality, Quality{});
}

TEST(Knobs, SaysWhyAKnobHasNoEffect) {
    SceneSummary scene;
    EXPECT_EQ(requireKnob("texture_bits").withoutEffect(scene, {}), "no texture in the scene");
    EXPECT_EQ(requireKnob("cluster_from").withoutEffect(scene, {}), "no light with a range in the scene");
    EXPECT_EQ(requireKnob("gbuffer_bits").withoutEffect(scene, {}), "no opaque surface in the scene");
    scene.opaque = true;
    EXPECT_EQ(requireKnob("gbuffer_bits").withoutEffect(scene, {}), "");
    EXPECT_EQ(requireKnob("gbuffer_bits").withoutEffect(scene, {.shading = Shading::forward}),
              "forward shading has no G-buffer");
    EXPECT_EQ(requireKnob("normal_bits").withoutEffect(scene, {}), "no light reads the normal");
    scene.spotLights = 1;
    EXPECT_EQ(requireKnob("normal_bits").withoutEffect(scene, {}), "no opaque surface shows punctual light");
    scene.brdfs.emplace_back().name = "lambert";
    EXPECT_EQ(requireKnob("normal_bits").withoutEffect(scene, {}), "");
    EXPECT_EQ(requireKnob("fresnel").withoutEffect(scene, {}),
              "no material in use has exact Fresnel equations");
    scene.keptFresnel["the index is textured"] = 1;
    EXPECT_EQ(requireKnob("fresnel").withoutEffect(scene, {}),
              "no exact Fresnel equations can be replaced: the index is textured");
    scene.exactFresnel = 1;
    EXPECT_EQ(requireKnob("fresnel").withoutEffect(scene, {}), "");
    EXPECT_EQ(requireKnob("anti_aliasing").withoutEffect(scene, {}), "");
}

}  // namespace
}  // namespace lobe
