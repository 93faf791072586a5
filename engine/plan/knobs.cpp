#include "plan/knobs.hpp"

#include <algorithm>
#include <charconv>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "plan/planner.hpp"

namespace lobe {
namespace {

constexpr std::pair<const char*, int> kSamples[] = {{"none", 1}, {"ssaa4", 4}, {"ssaa16", 16}};

std::string samplesName(const Quality& quality) {
    for (const auto& [name, samples] : kSamples)
        if (samples == quality.samples) return name;
    return std::to_string(quality.samples);
}

void setSamples(Quality& quality, const std::string& value) {
    for (const auto& [name, samples] : kSamples)
        if (value == name) quality.samples = samples;
}

std::string always(const SceneSummary&, const Quality&) {
    return {};
}

/// Why there is no G-buffer, which only opaque surfaces and deferred shading have.
std::string withoutGbuffer(const SceneSummary& scene, const Quality& quality) {
    if (!scene.opaque && !scene.masked) return "no opaque surface in the scene";
    if (quality.shading == Shading::forward) return "forward shading has no G-buffer";
    return {};
}

/// Why no stored normal is read: those of punctual lights are the only ones that show.
std::string withoutNormal(const SceneSummary& scene, const Quality& quality) {
    if (std::string reason = withoutGbuffer(scene, quality); !reason.empty()) return reason;
    if (scene.directionalLights + scene.pointLights + scene.spotLights == 0)
        return "no light reads the normal";
    const bool shows = std::any_of(scene.brdfs.begin(), scene.brdfs.end(),
                                   [](const BrdfFacts& facts) { return scattersLight(facts.name); });
    return shows ? "" : "no opaque surface shows punctual light";
}

std::string withoutTextures(const SceneSummary& scene, const Quality&) {
    return scene.textures.empty() ? "no texture in the scene" : "";
}

std::string withoutDeferred(const SceneSummary& scene, const Quality&) {
    return scene.opaque || scene.masked ? "" : "no opaque surface in the scene";
}

std::string withoutRanges(const SceneSummary& scene, const Quality&) {
    return scene.rangedPointLights + scene.rangedSpotLights > 0 ? "" : "no light with a range in the scene";
}

std::string withoutExactFresnel(const SceneSummary& scene, const Quality&) {
    if (scene.exactFresnel > 0) return {};
    return scene.keptFresnel.empty()
               ? "no material in use has exact Fresnel equations"
               : "no exact Fresnel equations can be replaced: " + scene.keptFresnel.begin()->first;
}

bool isAllowed(const Knob& knob, const std::string& value) {
    if (!knob.range) return std::find(knob.values.begin(), knob.values.end(), value) != knob.values.end();
    int number = 0;
    const char* end = value.data() + value.size();
    const auto [stop, error] = std::from_chars(value.data(), end, number);
    return error == std::errc() && stop == end && number >= knob.range->first && number <= knob.range->second;
}

}  // namespace

const std::vector<Knob>& knobTable() {
    static const std::vector<Knob> table = {
        {.name = "anti_aliasing",
         .title = "Anti-aliasing",
         .help = "samples a pixel",
         .values = {"none", "ssaa4", "ssaa16"},
         .range = {},
         .get = samplesName,
         .set = setSamples,
         .withoutEffect = always},
        {.name = "gbuffer_bits",
         .title = "G-buffer bits",
         .help = "bits of each parameter that varies from pixel to pixel",
         .values = {"8", "16", "32"},
         .range = {},
         .get = [](const Quality& q) { return std::to_string(q.gbufferBits); },
         .set = [](Quality& q, const std::string& value) { q.gbufferBits = std::stoi(value); },
         .withoutEffect = withoutGbuffer},
        {.name = "normal_bits",
         .title = "Normal bits",
         .help =
             "bits of each of a normal's two coordinates in the G-buffer; auto: what the sharpest lobe needs",
         .values = {"8", "16", "auto", "32"},
         .range = {},
         .get = [](const Quality& q) -> std::string {
             return q.normalBits == 0 ? "auto" : std::to_string(q.normalBits);
         },
         .set = [](Quality& q,
                   const std::string& value) { q.normalBits = value == "auto" ? 0 : std::stoi(value); },
         .withoutEffect = withoutNormal},
        {.name = "texture_bits",
         .title = "Texture bits",
         .help = "bits of each texel component that is filtered",
         .values = {"8", "16", "32"},
         .range = {},
         .get = [](const Quality& q) { return std::to_string(q.textureBits); },
         .set = [](Quality& q, const std::string& value) { q.textureBits = std::stoi(value); },
         .withoutEffect = withoutTextures},
        {.name = "shading",
         .title = "Shading",
         .help = "deferred, or all surfaces in the forward pass",
         .values = {"deferred", "forward"},
         .range = {},
         .get = [](const Quality& q) -> std::string {
             return q.shading == Shading::forward ? "forward" : "deferred";
         },
         .set =
             [](Quality& q, const std::string& value) {
                 q.shading = value == "forward" ? Shading::forward : Shading::deferred;
             },
         .withoutEffect = withoutDeferred},
        {.name = "cluster_from",
         .title = "Clusters from",
         .help = "light lists by cluster from this many ranged lights of a type on; 0 never",
         .values = {"0", "9", "1"},
         .range = {{0, 1000000}},
         .get = [](const Quality& q) { return std::to_string(q.clusterFrom); },
         .set = [](Quality& q, const std::string& value) { q.clusterFrom = std::stoi(value); },
         .withoutEffect = withoutRanges},
        {.name = "radiance_bits",
         .title = "Radiance bits",
         .help = "bits of each component that lights are added up in; with 16, radiance from 65504 on is an "
                 "error",
         .values = {"16", "32"},
         .range = {},
         .get = [](const Quality& q) { return std::to_string(q.radianceBits); },
         .set = [](Quality& q, const std::string& value) { q.radianceBits = std::stoi(value); },
         .withoutEffect = always},
        {.name = "fresnel",
         .title = "Fresnel",
         .help = "exact equations where materials have them, or Schlick's approximation with the same F0",
         .values = {"schlick", "exact"},
         .range = {},
         .get = [](const Quality& q) -> std::string {
             return q.fresnel == FresnelEquations::schlick ? "schlick" : "exact";
         },
         .set =
             [](Quality& q, const std::string& value) {
                 q.fresnel = value == "schlick" ? FresnelEquations::schlick : FresnelEquations::exact;
             },
         .withoutEffect = withoutExactFresnel},
    };
    return table;
}

std::vector<std::string> knobNames() {
    std::vector<std::string> names;
    for (const Knob& knob : knobTable())
        names.push_back(knob.name);
    return names;
}

const Knob& requireKnob(const std::string& name) {
    for (const Knob& knob : knobTable())
        if (knob.name == name) return knob;
    throw UsageError("unknown knob '" + name + "'" + didYouMean(name, knobNames()));
}

void setKnob(Quality& quality, const std::string& name, const std::string& value) {
    const Knob& knob = requireKnob(name);
    if (!isAllowed(knob, value))
        throw UsageError(name + " '" + value + "'; expected " +
                         (knob.range ? "a whole number from " + std::to_string(knob.range->first) + " to " +
                                           std::to_string(knob.range->second)
                                     : "one of " + listed(knob.values) + didYouMean(value, knob.values)));
    knob.set(quality, value);
}

std::vector<std::pair<std::string, std::string>> knobValues(const Quality& quality) {
    std::vector<std::pair<std::string, std::string>> values;
    for (const Knob& knob : knobTable())
        values.emplace_back(knob.name, knob.get(quality));
    return values;
}

}  // namespace lobe
