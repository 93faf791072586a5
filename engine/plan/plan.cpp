#include "plan/plan.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace lobe {
namespace {

using Defines = std::map<std::string, std::string>;

std::string plural(int count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// A parameter whose range lies within 0..1 fits a normalised format; others need float.
bool fitsUnorm(const Parameter& parameter) {
    return parameter.minimum >= 0.0 && parameter.maximum <= 1.0;
}

std::string unormFormat(int components, int bits) {
    static const char* const letters[] = {"", "R", "RG", "RGBA", "RGBA"};
    return std::string(letters[components]) + (bits == 32 ? "32F" : std::to_string(bits));
}

int bytesOf(const std::string& format) {
    static const std::map<std::string, int> sizes = {{"R8", 1},
                                                     {"RG8", 2},
                                                     {"RGBA8", 4},
                                                     {"R16", 2},
                                                     {"RG16", 4},
                                                     {"RGBA16", 8},
                                                     {"R32F", 4},
                                                     {"RG32F", 8},
                                                     {"RGBA32F", 16},
                                                     {"R8UI", 1},
                                                     {"R16UI", 2},
                                                     {"R32UI", 4},
                                                     {"DEPTH_COMPONENT24", 4},
                                                     {"DEPTH_COMPONENT32F", 4},
                                                     {"DEPTH24_STENCIL8", 4},
                                                     {"DEPTH32F_STENCIL8", 8}};
    return sizes.at(format);
}

/// Lobe sharpness (|d ln f / d theta_h|, 1/rad) up to which a normal of 2x16 bits (off by at most 6.4e-5 rad)
/// changes the lobe by less than 1 %.
constexpr double kSharpnessOf16Bits = 0.01 / 6.4e-5;

class Planner {
public:
    Planner(const SceneSummary& summary, const Quality& quality, const Capabilities& capabilities,
            const AovSet& aovs)
        : scene_(summary), capabilities_(capabilities), aovs_(aovs) {
        plan_.quality = quality;
    }

    FramePlan plan() {
        plan_.samples = plan_.quality.samples;
        plan_.surfaces = scene_.surfaces;
        plan_.ambient = scene_.ambient;
        plan_.textures = scene_.textures;
        plan_.reversedDepth = capabilities_.clipControl;
        deferred_ = plan_.quality.shading == Shading::deferred;
        anyLight_ = scene_.directionalLights + scene_.pointLights + scene_.spotLights > 0;
        unlit_ = std::any_of(scene_.brdfs.begin(), scene_.brdfs.end(),
                             [](const BrdfFacts& f) { return f.name == kUnlit; });
        hasDeferredSurface_ = deferred_ && !scene_.brdfs.empty();
        for (Aov aov : aovs_)
            dataAovs_ |= aov != Aov::radiance && aov != Aov::contributions;
        needsDeferredTargets_ = !scene_.brdfs.empty() && (deferred_ || dataAovs_);
        contributions_ = aovs_.contains(Aov::contributions);

        planModels();
        planGeometryChannels();
        planRadiance();
        planLights();
        planPasses();
        planVertexData();
        for (const std::string& texture : scene_.unusedTextures)
            leaveOut("texture", texture, "no material in use reads it");
        return std::move(plan_);
    }

private:
    bool wants(Aov aov) const { return aovs_.contains(aov); }
    void leaveOut(const std::string& kind, const std::string& name, const std::string& reason) {
        plan_.leftOut.push_back({kind, name, reason});
    }
    void addChannel(const std::string& name, const std::string& format, const std::string& holds,
                    const std::string& reason) {
        plan_.channels.push_back({name, format, bytesOf(format), holds, reason});
    }
    void addTarget(const std::string& name, const std::string& format, const std::string& holds,
                   const std::string& reason) {
        addChannel(name, format, holds, reason);
        plan_.gbufferTargets.push_back(name);
    }

    void planModels() {
        plan_.masked = scene_.brdfs.size() > 1 && needsDeferredTargets_;
        int stencil = 0;
        for (const BrdfFacts& facts : scene_.brdfs) {
            PlannedBrdf brdf;
            brdf.name = facts.name;
            brdf.stencil = plan_.masked ? ++stencil : 0;
            brdf.perMaterial.assign(facts.perMaterial.begin(), facts.perMaterial.end());
            plan_.brdfs.push_back(brdf);
        }
        if (stencil > 255)
            throw InputError("scene uses more than 255 reflectance models; expected at most 255");
    }

    void planGeometryChannels() {
        if (!plan_.reversedDepth) {
            plan_.notes.push_back(
                "depth: standard with linear z in a channel, since the context lacks ARB_clip_control");
        }
        const bool stencil = plan_.masked;
        const std::string format = plan_.reversedDepth
                                       ? (stencil ? "DEPTH32F_STENCIL8" : "DEPTH_COMPONENT32F")
                                       : (stencil ? "DEPTH24_STENCIL8" : "DEPTH_COMPONENT24");
        addChannel("depth", format, stencil ? "depth, and the model's mask value in stencil" : "depth",
                   plan_.reversedDepth
                       ? "reversed, so that position has relative error 6e-8 at every distance"
                       : "for visibility only");
        if (!stencil)
            leaveOut("channel", "stencil",
                     scene_.brdfs.size() <= 1 ? "one shading model covers all pixels: nothing to mask"
                                              : "forward shading needs no mask");
        if (!needsDeferredTargets_) {
            leaveOut("channel", "normal",
                     deferred_ ? "no opaque surface" : "forward shading has no G-buffer");
            return;
        }
        const bool needsPosition = anyLight_ || wants(Aov::depth) || wants(Aov::position);
        if (!plan_.reversedDepth && needsPosition)
            addTarget("linear_z", "R32F", "distance along the view axis, m",
                      "position, without clip control");
        planNormal();
        planMaterialId();
        planParameters();
    }

    void planNormal() {
        double sharpness = 0.0;
        bool lit = false;
        for (const BrdfFacts& facts : scene_.brdfs) {
            sharpness = std::max(sharpness, facts.sharpness);
            lit |= facts.name != kUnlit;
        }
        if (!(lit && anyLight_) && !wants(Aov::normal)) {
            leaveOut("channel", "normal", !anyLight_ ? "no light reads it" : "every opaque surface is unlit");
            return;
        }
        const bool wide = plan_.quality.gbufferBits == 32 || sharpness > kSharpnessOf16Bits;
        wideNormal_ = wide;
        addTarget("normal", wide ? "RG32F" : "RG16", "octahedral shading normal",
                  plan_.quality.gbufferBits == 32 ? "quality asks for full precision"
                  : wide                          ? "the sharpest lobe needs a normal better than 6.4e-5 rad"
                                                  : "16 bits change no lobe here by more than 1 %");
    }

    void planMaterialId() {
        const bool table = std::any_of(plan_.brdfs.begin(), plan_.brdfs.end(),
                                       [](const PlannedBrdf& b) { return !b.perMaterial.empty(); });
        table_ = table && (anyLight_ || wants(Aov::albedo) || wants(Aov::roughness));
        if (!table_)
            leaveOut("buffer", "material table",
                     "no parameter differs between materials of one model and reads it");
        if (!table_ && !wants(Aov::materialId)) {
            leaveOut("channel", "material",
                     scene_.materialsInUse.size() <= 1 ? "one material" : "nothing is looked up by material");
            return;
        }
        const int last = scene_.materialsInUse.empty() ? 0 : scene_.materialsInUse.back();
        addTarget("material",
                  last < 255     ? "R8UI"
                  : last < 65535 ? "R16UI"
                                 : "R32UI",
                  "index of the material + 1",
                  table_ ? "constants that differ by material are looked up in a table" : "asked for as AOV");
    }

    void planParameters() {
        const bool read = anyLight_ || wants(Aov::albedo) || wants(Aov::roughness);
        // Targets are shared by all models: each fills them from the first component, normalised values apart
        // from those that need float.
        std::vector<std::string> holds[2];
        int components[2] = {0, 0};
        for (int group : {0, 1}) {
            for (size_t b = 0; b < plan_.brdfs.size(); ++b) {
                const BrdfFacts& facts = scene_.brdfs[b];
                if (facts.name == kUnlit || facts.perPixel.empty()) continue;
                const Brdf& brdf = requireBrdf(facts.name);
                int used = 0;
                std::string names;
                for (int p : facts.perPixel) {
                    const Parameter& parameter = brdf.parameters[static_cast<size_t>(p)];
                    if (fitsUnorm(parameter) != (group == 0)) continue;
                    if (!read) {
                        leaveOut("channel", facts.name + "." + parameter.name, "no light reads it");
                        continue;
                    }
                    // An RGB triple is kept within one target.
                    if (used % 4 + parameter.components() > 4) used += 4 - used % 4;
                    plan_.brdfs[b].perPixel.push_back({p, used / 4 + (group == 0 ? 0 : 100), used % 4});
                    used += parameter.components();
                    names += (names.empty() ? "" : " ") + parameter.name;
                }
                components[group] = std::max(components[group], used);
                if (!names.empty()) holds[group].push_back(facts.name + ": " + names);
            }
        }
        const int unormTargets = (components[0] + 3) / 4;
        for (PlannedBrdf& brdf : plan_.brdfs)
            for (ParameterPlace& place : brdf.perPixel)
                if (place.target >= 100) place.target += unormTargets - 100;
        for (int group : {0, 1})
            for (int first = 0; first < components[group]; first += 4) {
                const int count = std::min(4, components[group] - first);
                std::string what;
                for (const std::string& h : holds[group])
                    what += (what.empty() ? "" : "; ") + h;
                const int index = (group == 0 ? 0 : unormTargets) + first / 4;
                addTarget("parameters" + std::to_string(index),
                          unormFormat(count, group == 0 ? plan_.quality.gbufferBits : 32), what,
                          "textures or vertex colours vary it" +
                              std::string(group == 1 ? "; its range needs float" : ""));
            }
        for (size_t b = 0; b < plan_.brdfs.size(); ++b) {
            if (scene_.brdfs[b].name == kUnlit) continue;
            const Brdf& brdf = requireBrdf(scene_.brdfs[b].name);
            for (int p = 0; p < static_cast<int>(brdf.parameters.size()); ++p)
                if (!scene_.brdfs[b].perPixel.contains(p))
                    leaveOut("channel", brdf.name + "." + brdf.parameters[static_cast<size_t>(p)].name,
                             scene_.brdfs[b].perMaterial.contains(p)
                                 ? "constant per material: kept in the material table"
                                 : "the same everywhere: a uniform");
        }
    }

    void planRadiance() {
        addChannel("radiance", "RGBA32F", "radiance and coverage", "32-bit float until output");
        const bool emitted = scene_.emission || scene_.ambient || unlit_;
        gbufferRadiance_ = hasDeferredSurface_ && emitted;
        if (gbufferRadiance_) plan_.gbufferTargets.push_back("radiance");
        if (!scene_.emission) leaveOut("pass", "emission", "no material emits");
        if (!scene_.ambient) leaveOut("pass", "ambient", "the scene has no ambient light");
        if (!scene_.occlusion)
            leaveOut("texture", "occlusion",
                     scene_.ambient ? "no material has one" : "there is no ambient light for it to act on");
        if (contributions_) {
            plan_.contributionTargets = {"emission", "ambient", "directional",
                                         "point",    "spot",    "transparent"};
            for (const std::string& name : plan_.contributionTargets)
                addChannel("contribution." + name, "RGBA32F", "radiance from " + name, "asked for as AOV");
            if (gbufferRadiance_) {
                plan_.gbufferTargets.pop_back();
                plan_.gbufferTargets.push_back("contribution.emission");
                plan_.gbufferTargets.push_back("contribution.ambient");
            }
        }
        if (static_cast<int>(plan_.gbufferTargets.size()) > capabilities_.maxColorAttachments)
            throw ContextError("the scene needs " + std::to_string(plan_.gbufferTargets.size()) +
                               " G-buffer targets; the driver has " +
                               std::to_string(capabilities_.maxColorAttachments));
    }

    void requireFit(const char* type, int count, int texelsEach) const {
        const int most = capabilities_.maxTextureBufferTexels / texelsEach;
        if (count > most)
            throw ContextError("the scene has " + plural(count, std::string(type) + " light") +
                               "; expected at most " + std::to_string(most) +
                               ", what the driver's buffers hold");
    }

    /// One loop of a fragment shader runs over all lights that reach everything; software drivers end loops
    /// at 65535.
    void requireForwardLoop(const char* type, int global) const {
        constexpr int kMost = 65000;
        if (global > kMost && (scene_.blended || !deferred_))
            throw InputError("the scene has " + plural(global, std::string(type) + " light") +
                             " without range over blended surfaces; expected at most " +
                             std::to_string(kMost));
    }

    /// Lights without range reach every pixel and stay outside the clusters.
    void planLights() {
        const int from = plan_.quality.clusterFrom;
        const auto clustered = [&](const char* type, int count, int ranged, int& global) {
            if (count == 0) return false;
            const bool use = from > 0 && ranged >= from && count >= from;
            global = use ? count - ranged : count;
            std::string line = std::string(type) + ": " + plural(count, "light") +
                               (use ? ", " + std::to_string(ranged) +
                                          " of them in clusters of 64 x 64 px and 24 slices of depth"
                                    : ", one loop over all");
            if (!use)
                line += from == 0       ? " (clusters are off)"
                        : ranged < from ? " (fewer than " + std::to_string(from) + " with a range)"
                                        : "";
            plan_.lightGroups.push_back(line);
            return use;
        };
        if (scene_.directionalLights > 0)
            plan_.lightGroups.push_back("directional: " + plural(scene_.directionalLights, "light") +
                                        ", one loop over all");
        plan_.clusteredPoint =
            clustered("point", scene_.pointLights, scene_.rangedPointLights, plan_.globalPointLights);
        plan_.clusteredSpot =
            clustered("spot", scene_.spotLights, scene_.rangedSpotLights, plan_.globalSpotLights);
        requireFit("directional", scene_.directionalLights, 2);
        requireFit("point", scene_.pointLights, 2);
        requireFit("spot", scene_.spotLights, 3);
        requireForwardLoop("directional", scene_.directionalLights);
        requireForwardLoop("point", plan_.globalPointLights);
        requireForwardLoop("spot", plan_.globalSpotLights);
        if (!plan_.clusteredPoint && !plan_.clusteredSpot)
            leaveOut("buffer", "light clusters", "no light type has enough ranged lights for lists to pay");
    }

    Defines commonDefines() const {
        Defines defines;
        if (!plan_.reversedDepth) defines["LINEAR_Z"] = "1";
        if (wideNormal_) defines["NORMAL_32F"] = "1";
        if (plan_.channel("normal") != nullptr) defines["HAS_NORMAL"] = "1";
        if (plan_.channel("material") != nullptr) defines["HAS_MATERIAL"] = "1";
        for (int i = 0; plan_.channel("parameters" + std::to_string(i)) != nullptr; ++i)
            defines["HAS_PARAMETERS" + std::to_string(i)] = "1";
        return defines;
    }

    void lightDefines(Defines& defines, LightType type) const {
        switch (type) {
            case LightType::directional:
                defines["DIRECTIONAL_LIGHTS"] = "1";
                break;
            case LightType::point:
                if (plan_.globalPointLights > 0) defines["POINT_LIGHTS"] = "1";
                if (plan_.clusteredPoint) defines["POINT_CLUSTERS"] = "1";
                break;
            case LightType::spot:
                if (plan_.globalSpotLights > 0) defines["SPOT_LIGHTS"] = "1";
                if (plan_.clusteredSpot) defines["SPOT_CLUSTERS"] = "1";
                break;
        }
    }

    Defines surfaceDefines(const SurfaceFeatures& features) const {
        Defines defines;
        const auto flag = [&](const char* key, bool on) {
            if (on) defines[key] = "1";
        };
        flag("UV0", features.usesUv(0));
        flag("UV1", features.usesUv(1));
        flag("VERTEX_COLORS", features.vertexColors);
        flag("NORMAL_MAP", features.texture("normal") != nullptr);
        flag("ALPHA_MASK", features.alphaMode == AlphaMode::mask);
        flag("ALPHA_BLEND", features.alphaMode == AlphaMode::blend);
        flag("EMISSION", features.emission);
        flag("TANGENTS", features.texture("normal") != nullptr ||
                             (features.brdf != kUnlit && requireBrdf(features.brdf).traits.usesTangent));
        flag("UNLIT", features.brdf == kUnlit);
        flag("AMBIENT", scene_.ambient && features.brdf != kUnlit);
        flag("OCCLUSION", features.texture("occlusion") != nullptr);
        flag("USES_TANGENT", features.brdf != kUnlit && requireBrdf(features.brdf).traits.usesTangent);
        return defines;
    }

    void planPasses() {
        planGbufferPass();
        planCoverage();
        planLightPass("light.directional", "pass/light.frag", LightType::directional,
                      scene_.directionalLights);
        planLightPass("light.point", "pass/light.frag", LightType::point, scene_.pointLights);
        planLightPass("light.spot", "pass/light.frag", LightType::spot, scene_.spotLights);
        planForward();
        planAccumulation();
        planDataAovs();
    }

    void planGbufferPass() {
        if (!needsDeferredTargets_) {
            leaveOut("pass", "gbuffer", deferred_ ? "no opaque surface" : "forward shading");
            return;
        }
        PlannedPass pass{"gbuffer", "pass/gbuffer.frag", {}, {}, plan_.gbufferTargets, ""};
        pass.writes.insert(pass.writes.begin(), "depth");
        for (size_t i = 0; i < plan_.surfaces.size(); ++i) {
            const SurfaceFeatures& features = plan_.surfaces[i];
            if (features.alphaMode == AlphaMode::blend) continue;
            Defines defines = surfaceDefines(features);
            defines.merge(commonDefines());
            defines["GBUFFER"] = "1";
            for (size_t t = 0; t < plan_.gbufferTargets.size(); ++t) {
                std::string key = plan_.gbufferTargets[t];
                std::replace(key.begin(), key.end(), '.', '_');
                std::transform(key.begin(), key.end(), key.begin(),
                               [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
                defines["OUT_" + key] = std::to_string(t);
            }
            pass.variants.push_back({features.brdf, static_cast<int>(i), defines});
        }
        pass.reason = deferred_ ? plural(static_cast<int>(scene_.instances - scene_.blendedInstances),
                                         "opaque or masked instance")
                                : "data AOVs are asked for";
        if (gbufferRadiance_)
            pass.reason += "; emission and ambient light are written here, in place of passes of their own";
        plan_.passes.push_back(pass);
    }

    void planCoverage() {
        if (!hasDeferredSurface_) return;
        if (gbufferRadiance_ && !contributions_) {
            leaveOut("pass", "coverage", "the G-buffer pass writes radiance and with it coverage");
            return;
        }
        plan_.passes.push_back({"coverage",
                                "pass/coverage.frag",
                                {{}},
                                {"depth"},
                                {"radiance"},
                                "lighting passes add radiance only; coverage is set once"});
    }

    void planLightPass(const std::string& name, const std::string& program, LightType type, int count) {
        static const char* const kinds[] = {"directional", "point", "spot"};
        const std::string kind = kinds[static_cast<size_t>(type)];
        if (count == 0) return leaveOut("pass", name, "the scene has no " + kind + " light");
        if (!deferred_) return leaveOut("pass", name, "forward shading");
        PlannedPass pass{name,
                         program,
                         {},
                         {"depth"},
                         {contributions_ ? "contribution." + kind : "radiance"},
                         plural(count, kind + " light")};
        for (const char* channel : {"linear_z", "normal", "material"})
            if (plan_.channel(channel) != nullptr) pass.reads.emplace_back(channel);
        for (int i = 0; plan_.channel("parameters" + std::to_string(i)) != nullptr; ++i)
            pass.reads.push_back("parameters" + std::to_string(i));
        for (const PlannedBrdf& brdf : plan_.brdfs) {
            if (brdf.name == kUnlit) continue;
            // Lists of clusters are drawn tile by tile, lights that reach everything over the whole picture:
            // two programs.
            Defines lights;
            lightDefines(lights, type);
            for (const auto& [key, value] : lights) {
                Defines defines = commonDefines();
                defines[key] = value;
                if (key.ends_with("_CLUSTERS")) defines["TILES"] = "1";
                pass.variants.push_back({brdf.name, -1, defines});
            }
        }
        if (pass.variants.empty()) return leaveOut("pass", name, "no opaque surface takes light");
        plan_.passes.push_back(pass);
    }

    void planForward() {
        if (!scene_.blended && deferred_) return leaveOut("pass", "forward", "no blended surface");
        PlannedPass pass{"forward", "pass/forward.frag", {}, {"depth"}, {"radiance"}, ""};
        if (contributions_) {
            pass.writes.clear();
            for (const std::string& name : plan_.contributionTargets)
                pass.writes.push_back("contribution." + name);
            pass.writes.emplace_back("radiance");  // coverage only
        }
        for (size_t i = 0; i < plan_.surfaces.size(); ++i) {
            const SurfaceFeatures& features = plan_.surfaces[i];
            if (deferred_ && features.alphaMode != AlphaMode::blend) continue;
            Defines defines = surfaceDefines(features);
            if (features.brdf != kUnlit) {
                if (scene_.directionalLights > 0) lightDefines(defines, LightType::directional);
                if (scene_.pointLights > 0) lightDefines(defines, LightType::point);
                if (scene_.spotLights > 0) lightDefines(defines, LightType::spot);
            }
            if (contributions_) defines["CONTRIBUTIONS"] = "1";
            pass.variants.push_back({features.brdf, static_cast<int>(i), defines});
        }
        pass.reason = deferred_ ? plural(static_cast<int>(scene_.blendedInstances), "blended instance") +
                                      ", drawn back to front"
                                : "forward shading is asked for";
        plan_.passes.push_back(pass);
    }

    void planAccumulation() {
        if (plan_.samples == 1) return leaveOut("pass", "accumulate", "one sample a pixel");
        addChannel("accumulated", "RGBA32F", "sum of jittered frames",
                   "anti-aliasing by " + std::to_string(plan_.samples) + " samples");
        plan_.passes.push_back({"accumulate",
                                "pass/accumulate.frag",
                                {{}},
                                {"radiance"},
                                {"accumulated"},
                                plural(plan_.samples, "jittered frame") + " averaged"});
    }

    void planDataAovs() {
        if (!dataAovs_) return leaveOut("pass", "aov", "no data AOV is asked for");
        static const std::pair<Aov, const char*> kFormats[] = {
            {Aov::depth, "R32F"},     {Aov::position, "RGBA32F"}, {Aov::normal, "RGBA32F"},
            {Aov::albedo, "RGBA32F"}, {Aov::materialId, "R32F"},  {Aov::roughness, "R32F"}};
        PlannedPass pass{
            "aov", "pass/aov.frag", {}, {"depth"}, {}, "data AOVs are asked for; taken at pixel centres"};
        Defines outputs;
        for (const auto& [aov, format] : kFormats) {
            if (!wants(aov)) continue;
            const std::string name = aovNames()[static_cast<size_t>(aov)];
            addChannel("aov." + name, format, name, "asked for as AOV");
            std::string key = name;
            std::transform(key.begin(), key.end(), key.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
            outputs["OUT_" + key] = std::to_string(plan_.dataTargets.size());
            plan_.dataTargets.push_back("aov." + name);
            pass.writes.push_back("aov." + name);
        }
        for (const PlannedBrdf& brdf : plan_.brdfs) {
            Defines defines = commonDefines();
            if (brdf.name == kUnlit) defines["UNLIT"] = "1";
            defines.insert(outputs.begin(), outputs.end());
            pass.variants.push_back({brdf.name, -1, defines});
        }
        plan_.passes.push_back(pass);
    }

    void planVertexData() {
        if (!scene_.tangents) leaveOut("vertex data", "tangents", "no normal map and no anisotropic model");
        if (!scene_.vertexColors) leaveOut("vertex data", "colours", "no primitive has them");
        for (int set : {0, 1})
            if (!scene_.uv[set])
                leaveOut("vertex data", "UV set " + std::to_string(set), "no texture in use is placed by it");
    }

    const SceneSummary& scene_;
    const Capabilities& capabilities_;
    const AovSet& aovs_;
    FramePlan plan_;
    bool deferred_ = true, anyLight_ = false, unlit_ = false, hasDeferredSurface_ = false,
         needsDeferredTargets_ = false;
    bool dataAovs_ = false, contributions_ = false, gbufferRadiance_ = false, wideNormal_ = false,
         table_ = false;
};

}  // namespace

const PlannedPass* FramePlan::pass(std::string_view name) const {
    for (const PlannedPass& candidate : passes)
        if (candidate.name == name) return &candidate;
    return nullptr;
}

const Channel* FramePlan::channel(std::string_view name) const {
    for (const Channel& candidate : channels)
        if (candidate.name == name) return &candidate;
    return nullptr;
}

const PlannedBrdf* FramePlan::brdf(std::string_view name) const {
    for (const PlannedBrdf& candidate : brdfs)
        if (candidate.name == name) return &candidate;
    return nullptr;
}

int FramePlan::gbufferBytesPerPixel() const {
    int bytes = channel("depth") != nullptr ? channel("depth")->bytesPerPixel : 0;
    for (const std::string& target : gbufferTargets)
        bytes += channel(target)->bytesPerPixel;
    return bytes;
}

FramePlan planFrame(const SceneSummary& summary, const Quality& quality, const Capabilities& capabilities,
                    const AovSet& aovs) {
    return Planner(summary, quality, capabilities, aovs).plan();
}

}  // namespace lobe
