#include "plan/knobs.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "plan/planner.hpp"

namespace lobe {
namespace {

constexpr std::pair<const char*, int> kSamples[] = {{"none", 1}, {"ssaa4", 4}, {"ssaa16", 16}};

constexpr std::array kShadows{"none", "hard", "soft"};
constexpr std::array kShadowMethods{"auto", "maps", "rays"};
constexpr std::array kAreaLights{"analytic", "sampled"};
constexpr std::array kEnvironmentLightings{"prefiltered", "sampled"};
constexpr std::array kEnvironmentDiffuses{"sh2", "sh4", "map"};
constexpr std::array kAmbientOcclusions{"off", "low", "high"};
constexpr std::array kTransparencies{"sorted", "peeled"};

/// The enumerator of an allowed value, named in their order.
template<typename Enum, size_t N>
Enum chosen(const std::array<const char*, N>& names, const std::string& value) {
    return static_cast<Enum>(std::find(names.begin(), names.end(), value) - names.begin());
}

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
    const bool punctual = scene.directionalLights + scene.pointLights + scene.spotLights > 0;
    const bool extended = !scene.bodyLights.empty() || scene.environment;
    if (!punctual && !extended) return "no light reads the normal";
    const bool shows = std::any_of(scene.brdfs.begin(), scene.brdfs.end(), [&](const BrdfFacts& facts) {
        return scattersLight(facts.name) || (extended && facts.name != kUnlit);
    });
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

int lightsOf(const SceneSummary& scene) {
    int count = scene.directionalLights + scene.pointLights + scene.spotLights;
    for (const auto& [type, lights] : scene.bodyLights)
        count += lights;
    return count;
}

/// Why each light reaches all of the scene.
std::string withoutReach(const SceneSummary& scene, const Quality& quality) {
    if (scene.pointLights + scene.spotLights == 0) return "no point or spot light in the scene";
    if (!scene.unbounded.empty()) return "what " + scene.unbounded + " reflects has no bound";
    return quality.clusterFrom == 0 ? "clusters are off" : "";
}

/// Why no light casts a shadow whatever the quality.
std::string withoutCasting(const SceneSummary& scene, const Quality&) {
    if (!scene.environment || !scene.environmentCastsShadow) {
        if (lightsOf(scene) == 0) return "no light in the scene";
        if (scene.shadowLights.empty()) return "no light of the scene casts shadows";
    }
    return scene.castingTriangles == 0 ? "no surface of the scene casts shadows" : "";
}

/// Why none does with this one.
std::string withoutShadows(const SceneSummary& scene, const Quality& quality) {
    if (std::string reason = withoutCasting(scene, quality); !reason.empty()) return reason;
    return quality.shadows == Shadows::none ? "shadows are off" : "";
}

std::string withoutShadowMaps(const SceneSummary& scene, const Quality& quality) {
    if (std::string reason = withoutShadows(scene, quality); !reason.empty()) return reason;
    return quality.shadowMethod == ShadowMethod::rays ? "shadows are found by rays" : "";
}

std::string withoutBodies(const SceneSummary& scene, const Quality&) {
    return scene.bodyLights.empty() ? "no light with a body in the scene" : "";
}

/// Why no point on a light is ever drawn.
std::string withoutLightSamples(const SceneSummary& scene, const Quality& quality) {
    if (std::string reason = withoutBodies(scene, quality); !reason.empty()) return reason;
    const auto scatters = [](const SurfaceFeatures& surface) { return scattersLight(surface.brdf); };
    if (std::none_of(scene.surfaces.begin(), scene.surfaces.end(), scatters))
        return "no surface scatters light of a body";
    const bool closed = std::all_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const auto& surface) {
        return !scattersLight(surface.brdf) || hasClosedForm(scene, surface.brdf);
    });
    return closed && quality.areaLights == AreaLights::analytic && quality.shadows != Shadows::soft
               ? "lights are in closed form and no shadow is soft"
               : "";
}

std::string withoutAirlight(const SceneSummary& scene, const Quality&) {
    if (!scene.fogScatters) return "no fog that scatters light in the scene";
    return scene.pointLights + scene.spotLights > 0 ? "" : "no point or spot light in the fog";
}

std::string withoutEnvironment(const SceneSummary& scene, const Quality&) {
    if (!scene.environment) return "no environment in the scene";
    const auto scatters = [](const SurfaceFeatures& surface) { return scattersLight(surface.brdf); };
    return std::any_of(scene.surfaces.begin(), scene.surfaces.end(), scatters)
               ? ""
               : "no surface scatters light of the environment";
}

/// Why nothing is read from a map of irradiance.
std::string withoutEnvironmentDiffuse(const SceneSummary& scene, const Quality& quality) {
    if (std::string reason = withoutEnvironment(scene, quality); !reason.empty()) return reason;
    if (quality.envLighting == EnvironmentLighting::sampled) return "the environment is sampled";
    const bool any = std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const auto& surface) {
        return scattersLight(surface.brdf) && hasClosedForm(scene, surface.brdf);
    });
    return any ? "" : "no model of the scene has a part that is split off";
}

/// Why no direction is ever drawn.
std::string withoutEnvironmentSamples(const SceneSummary& scene, const Quality& quality) {
    if (std::string reason = withoutEnvironment(scene, quality); !reason.empty()) return reason;
    const bool split = std::all_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const auto& surface) {
        return !scattersLight(surface.brdf) || hasClosedForm(scene, surface.brdf);
    });
    return split && quality.envLighting == EnvironmentLighting::prefiltered ? "the environment is prefiltered"
                                                                            : "";
}

/// Why nothing that the depth buffer shows dims the environment.
std::string withoutAmbientOcclusion(const SceneSummary& scene, const Quality& quality) {
    if (std::string reason = withoutEnvironmentDiffuse(scene, quality); !reason.empty()) return reason;
    if (std::string reason = withoutGbuffer(scene, quality); !reason.empty()) return reason;
    if (!scene.environmentCastsShadow) return "the environment casts no shadows";
    if (scene.castingTriangles == 0) return "no surface of the scene casts shadows";
    return quality.shadows == Shadows::none ? "shadows are off" : "";
}

std::string withoutBlended(const SceneSummary& scene, const Quality&) {
    return scene.blended ? "" : "no blended surface in the scene";
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
        {.name = "shadows",
         .title = "Shadows",
         .help = "none, hard as of points, or soft as each light's body casts them",
         .values = {"none", "hard", "soft"},
         .range = {},
         .get = [](const Quality& q) -> std::string { return kShadows[static_cast<size_t>(q.shadows)]; },
         .set = [](Quality& q, const std::string& value) { q.shadows = chosen<Shadows>(kShadows, value); },
         .withoutEffect = withoutCasting},
        {.name = "shadow_method",
         .title = "Shadow method",
         .help = "shadow maps, exact rays, or for each type of light what suits the scene",
         .values = {"auto", "maps", "rays"},
         .range = {},
         .get = [](const Quality& q) -> std::string {
             return kShadowMethods[static_cast<size_t>(q.shadowMethod)];
         },
         .set =
             [](Quality& q, const std::string& value) {
                 q.shadowMethod = chosen<ShadowMethod>(kShadowMethods, value);
             },
         .withoutEffect = withoutShadows},
        {.name = "shadow_size",
         .title = "Shadow map size",
         .help = "texels along each side of a shadow map",
         .values = {"512", "1024", "2048", "4096"},
         .range = {{64, 16384}},
         .get = [](const Quality& q) { return std::to_string(q.shadowSize); },
         .set = [](Quality& q, const std::string& value) { q.shadowSize = std::stoi(value); },
         .withoutEffect = withoutShadowMaps},
        {.name = "shadow_taps",
         .title = "Shadow map taps",
         .help = "comparisons for each look into a shadow map",
         .values = {"1", "4", "16", "64"},
         .range = {{1, 64}},
         .get = [](const Quality& q) { return std::to_string(q.shadowTaps); },
         .set = [](Quality& q, const std::string& value) { q.shadowTaps = std::stoi(value); },
         .withoutEffect = withoutShadowMaps},
        {.name = "area_lights",
         .title = "Area lights",
         .help = "in closed form or by fits where a model has them, or by points on each light",
         .values = {"analytic", "sampled"},
         .range = {},
         .get = [](const Quality& q) -> std::string {
             return kAreaLights[static_cast<size_t>(q.areaLights)];
         },
         .set = [](Quality& q,
                   const std::string& value) { q.areaLights = chosen<AreaLights>(kAreaLights, value); },
         .withoutEffect = withoutBodies},
        {.name = "light_samples",
         .title = "Light samples",
         .help = "points on each light with a body, for its shadow and where it is sampled",
         .values = {"1", "4", "16", "64"},
         .range = {{1, 1024}},
         .get = [](const Quality& q) { return std::to_string(q.lightSamples); },
         .set = [](Quality& q, const std::string& value) { q.lightSamples = std::stoi(value); },
         .withoutEffect = withoutLightSamples},
        {.name = "light_threshold",
         .title = "Light threshold",
         .help =
             "most that lights which are left out may take from a pixel, in thousandths of white; 0 leaves "
             "none out",
         .values = {"10", "2", "0"},
         .range = {{0, 1000}},
         .get = [](const Quality& q) { return std::to_string(q.lightThreshold); },
         .set = [](Quality& q, const std::string& value) { q.lightThreshold = std::stoi(value); },
         .withoutEffect = withoutReach},
        {.name = "airlight_nodes",
         .title = "Airlight nodes",
         .help = "of the quadrature along the view ray, for each light that fog scatters; 0 for none",
         .values = {"0", "4", "8", "16"},
         .range = {{0, 64}},
         .get = [](const Quality& q) { return std::to_string(q.airlightNodes); },
         .set = [](Quality& q, const std::string& value) { q.airlightNodes = std::stoi(value); },
         .withoutEffect = withoutAirlight},
        {.name = "env_lighting",
         .title = "Environment",
         .help =
             "its map integrated beforehand where a model's lobe can be split from it, or directions to it",
         .values = {"prefiltered", "sampled"},
         .range = {},
         .get = [](const Quality& q) -> std::string {
             return kEnvironmentLightings[static_cast<size_t>(q.envLighting)];
         },
         .set =
             [](Quality& q, const std::string& value) {
                 q.envLighting = chosen<EnvironmentLighting>(kEnvironmentLightings, value);
             },
         .withoutEffect = withoutEnvironment},
        {.name = "env_diffuse",
         .title = "Environment, diffuse",
         .help = "irradiance by spherical harmonics of 9 or 25 coefficients, or from a small map",
         .values = {"sh2", "sh4", "map"},
         .range = {},
         .get = [](const Quality& q) -> std::string {
             return kEnvironmentDiffuses[static_cast<size_t>(q.envDiffuse)];
         },
         .set =
             [](Quality& q, const std::string& value) {
                 q.envDiffuse = chosen<EnvironmentDiffuse>(kEnvironmentDiffuses, value);
             },
         .withoutEffect = withoutEnvironmentDiffuse},
        {.name = "env_samples",
         .title = "Environment samples",
         .help =
             "directions to the environment where it is sampled, half by its brightness, half by the lobe",
         .values = {"16", "32", "64", "256"},
         .range = {{2, 4096}},
         .get = [](const Quality& q) { return std::to_string(q.envSamples); },
         .set = [](Quality& q, const std::string& value) { q.envSamples = std::stoi(value); },
         .withoutEffect = withoutEnvironmentSamples},
        {.name = "ambient_occlusion",
         .title = "Ambient occlusion",
         .help = "looks into the depth buffer for what is in the way of the prefiltered environment",
         .values = {"off", "low", "high"},
         .range = {},
         .get = [](const Quality& q) -> std::string {
             return kAmbientOcclusions[static_cast<size_t>(q.ambientOcclusion)];
         },
         .set =
             [](Quality& q, const std::string& value) {
                 q.ambientOcclusion = chosen<AmbientOcclusion>(kAmbientOcclusions, value);
             },
         .withoutEffect = withoutAmbientOcclusion},
        {.name = "transparency",
         .title = "Transparency",
         .help = "whole objects from back to front, or peeled layer by layer",
         .values = {"sorted", "peeled"},
         .range = {},
         .get = [](const Quality& q) -> std::string {
             return kTransparencies[static_cast<size_t>(q.transparency)];
         },
         .set =
             [](Quality& q, const std::string& value) {
                 q.transparency = chosen<Transparency>(kTransparencies, value);
             },
         .withoutEffect = withoutBlended},
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
