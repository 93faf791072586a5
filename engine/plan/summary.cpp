#include "plan/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plan/shadow_layout.hpp"
#include "scene/brdf_tables.hpp"
#include "shading/bands.hpp"

namespace lobe {
namespace {

/// Gathers the texture fetches of one surface: slots that read the same texels in the same way share one.
class SampleCollector {
public:
    SampleCollector(const Material& material, SurfaceFeatures& features)
        : material_(material), features_(features) {}

    void use(const std::string& name, const TextureSlot& slot, int channel = 0) {
        if (!slot) return;
        const bool srgb = slotIsSrgb(material_, name);
        const bool alphaOnly = name == "alpha";
        size_t sample = 0;
        while (sample < slots_.size() &&
               !(slots_[sample].slot == slot && (alphaOnly || slots_[sample].srgb == srgb)))
            ++sample;
        if (sample == slots_.size()) {
            slots_.push_back({slot, srgb});
            features_.samples.push_back({slot.uvSet, slot.transformed()});
        }
        features_.textures.push_back({name, static_cast<int>(sample), channel});
    }

private:
    struct Fetch {
        TextureSlot slot;
        bool srgb;
    };
    const Material& material_;
    SurfaceFeatures& features_;
    std::vector<Fetch> slots_;
};

bool valuesDiffer(const Brdf& brdf, int parameter, const ParameterValues& a, const ParameterValues& b) {
    const int offset = brdf.valueOffset(parameter);
    const int count = brdf.parameters[static_cast<size_t>(parameter)].components();
    for (int i = offset; i < offset + count; ++i)
        if (a[static_cast<size_t>(i)] != b[static_cast<size_t>(i)]) return true;
    return false;
}

struct Use {
    const Material* material;
    bool vertexColors = false;
};

BrdfFacts factsOf(const std::string& name, const std::vector<Use>& uses) {
    BrdfFacts facts;
    facts.name = name;
    facts.materials = static_cast<int>(uses.size());
    if (name == kUnlit) return facts;
    const Brdf& brdf = requireBrdf(name);
    facts.usesTangent = brdf.traits.usesTangent;
    const int baseColor = brdf.parameterIndex(brdf.baseColorParameter);
    for (const Use& use : uses) {
        facts.sharpness = std::max(facts.sharpness, brdf.lobeSharpness(use.material->values));
        if (use.vertexColors && baseColor >= 0) facts.perPixel.insert(baseColor);
        for (size_t p = 0; p < use.material->textures.size(); ++p)
            if (use.material->textures[p]) facts.perPixel.insert(static_cast<int>(p));
    }
    for (int p = 0; p < static_cast<int>(brdf.parameters.size()); ++p)
        for (const Use& use : uses)
            if (!facts.perPixel.contains(p) &&
                valuesDiffer(brdf, p, use.material->values, uses[0].material->values))
                facts.perMaterial.insert(p);
    return facts;
}

std::string imageLabel(const Scene& scene, int texture) {
    const int image = scene.textures[static_cast<size_t>(texture)].image;
    if (image < 0) return "texture " + std::to_string(texture) + " (no image)";
    const auto index = static_cast<size_t>(image);
    return "images[" + std::to_string(image) + "]" +
           (index < scene.imageNames.size() && !scene.imageNames[index].empty()
                ? " " + scene.imageNames[index]
                : "");
}

void summariseTextures(const Scene& scene, bool surroundings, SceneSummary& summary) {
    std::map<int, std::map<std::string, int>> users;  // texture -> slot -> materials
    for (int m : summary.materialsInUse) {
        const Material& material = scene.materials[static_cast<size_t>(m)];
        const SurfaceFeatures features = surfaceFeatures(material, Primitive{}, surroundings);
        for (const SurfaceTexture& texture : features.textures)
            ++users[slotOf(material, texture.slot).texture][texture.slot];
    }
    for (int t = 0; t < static_cast<int>(scene.textures.size()); ++t) {
        if (!users.contains(t)) {
            summary.unusedTextures.push_back(imageLabel(scene, t));
            continue;
        }
        std::string line = imageLabel(scene, t) + ":";
        for (const auto& [slot, count] : users[t])
            line += " " + slot + " of " + std::to_string(count) + (count == 1 ? " material," : " materials,");
        line.pop_back();
        summary.textures.push_back(line);
    }
}

void countLights(const Scene& scene, SceneSummary& summary) {
    const Bounds bounds = scene.bounds();
    for (const Light& light : scene.lights) {
        if (light.type == LightType::point || light.type == LightType::spot)
            summary.reachWeight += reachWeight(light);
        if (light.castsShadow) {
            ++summary.shadowLights[light.type];
            if (light.type == LightType::spot && needsCube(light)) ++summary.wideShadowSpots;
            // At so many radii of the scene it is 5 % of the width of a cube's face.
            constexpr double kDistant = 20.0;
            if (!isPunctual(light.type) && bounds.radius() > 0.0 &&
                glm::length(light.position - bounds.center()) > kDistant * bounds.radius())
                summary.distantShadowLights.insert(light.type);
        }
        switch (light.type) {
            case LightType::directional:
                ++summary.directionalLights;
                break;
            case LightType::point:
                ++summary.pointLights;
                summary.rangedPointLights += light.range ? 1 : 0;
                break;
            case LightType::spot:
                ++summary.spotLights;
                summary.rangedSpotLights += light.range ? 1 : 0;
                break;
            default:
                ++summary.bodyLights[light.type];
                if (light.image >= 0) {
                    const Bitmap& image = scene.images[static_cast<size_t>(light.image)];
                    summary.lightImages.push_back(std::to_string(image.width) + " x " +
                                                  std::to_string(image.height) + " texels");
                }
                break;
        }
    }
    summary.environment = scene.environment.has_value();
    if (scene.environment) {
        const Environment& environment = *scene.environment;
        summary.environmentPicture = environment.image >= 0;
        summary.environmentSeen = environment.background;
        summary.environmentOtherSeen = environment.background && environment.backgroundImage >= 0;
        summary.environmentCastsShadow = environment.castsShadow;
        summary.environmentNotes = environment.notes;
        if (environment.image >= 0) {
            const Bitmap& picture = scene.images[static_cast<size_t>(environment.image)];
            summary.environmentWidth = picture.width;
            summary.environmentHeight = picture.height;
        }
    }
    summary.fog = scene.fog.has_value();
    summary.fogFallsOff = scene.fog && scene.fog->heightFalloff > 0.0;
    summary.fogGrey = scene.fog && scene.fog->extinction == glm::dvec3(scene.fog->extinction.x) &&
                      scene.fog->scattering == glm::dvec3(scene.fog->scattering.x);
    summary.fogScatters = scene.fog && scene.fog->scattering != glm::dvec3(0.0);
    summary.ambient = scene.ambientRadiance && *scene.ambientRadiance != glm::dvec3(0.0);
}

/// Parameters that a texture scales may be anything down to their minimum; those of colour only shrink, and
/// the bound with them.
double peakOf(const Material& material, const Primitive& primitive) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    if (material.brdf == kUnlit) return 0.0;
    const Brdf& brdf = requireBrdf(material.brdf);
    if (!brdf.traits.scattersLight) return 0.0;
    if (!brdf.peak || !primitive.colors.empty()) return kNone;
    ParameterValues values = material.values;
    const auto largest = [&] {
        const glm::dvec3 peak = brdf.peak(values);
        const double most = std::max({peak.r, peak.g, peak.b});
        return most < kNone ? most : kNone;
    };
    double peak = largest();
    for (size_t p = 0; p < material.textures.size(); ++p) {
        const Parameter& parameter = brdf.parameters[p];
        if (!material.textures[p] || parameter.kind != ParameterKind::scalar) continue;
        values[static_cast<size_t>(brdf.valueOffset(static_cast<int>(p)))] = parameter.minimum;
        peak = std::max(peak, largest());
    }
    return peak;
}

void addPeak(const Material& material, const Primitive& primitive, SceneSummary& summary) {
    const double peak = peakOf(material, primitive);
    summary.peak = std::max(summary.peak, peak);
    if (std::isinf(peak) && summary.unbounded.empty()) summary.unbounded = material.brdf;
}

void countBands(const Scene& scene, const std::set<int>& materials, SceneSummary& summary) {
    for (int m : materials) {
        const Material& material = scene.materials[static_cast<size_t>(m)];
        const Brdf* brdf = findBrdf(material.brdf);
        if (brdf == nullptr || !shading::hasBands(*brdf, material.values)) continue;
        summary.bandedBrdfs.insert(material.brdf);
        const size_t eta = shading::fresnelPlaces(*brdf)->eta;
        const auto& metal = shading::metalSpectra()[static_cast<size_t>(material.values[eta]) - 1];
        ++summary.bands[metal.name + " in " + std::to_string(static_cast<int>(material.values[eta + 1])) +
                        " bands"];
    }
}

}  // namespace

const SurfaceTexture* SurfaceFeatures::texture(std::string_view slot) const {
    for (const SurfaceTexture& candidate : textures)
        if (candidate.slot == slot) return &candidate;
    return nullptr;
}

bool SurfaceFeatures::usesUv(int set) const {
    return std::any_of(samples.begin(), samples.end(),
                       [set](const SurfaceSample& s) { return s.uvSet == set; });
}

const TextureSlot& slotOf(const Material& material, std::string_view slot) {
    if (slot == "normal") return material.normalTexture;
    if (slot == "occlusion") return material.occlusionTexture;
    if (slot == "emission") return material.emissionTexture;
    if (slot == "alpha" || material.brdf == kUnlit) return material.baseColorTexture;
    return material.textures[static_cast<size_t>(requireBrdf(material.brdf).parameterIndex(slot))];
}

bool slotIsSrgb(const Material& material, std::string_view slot) {
    if (slot == "normal" || slot == "occlusion") return false;
    if (slot == "emission" || slot == "alpha" || material.brdf == kUnlit) return true;
    const Brdf& brdf = requireBrdf(material.brdf);
    return brdf.parameters[static_cast<size_t>(brdf.parameterIndex(slot))].textureIsSrgb;
}

SurfaceFeatures surfaceFeatures(const Material& material, const Primitive& primitive, bool surroundings) {
    SurfaceFeatures features;
    features.brdf = material.brdf;
    features.alphaMode = material.alphaMode;
    features.transmits = seesThrough(material);
    features.vertexColors = !primitive.colors.empty();
    features.emission = material.emission != glm::vec3(0.0f);

    SampleCollector collector(material, features);
    if (material.brdf == kUnlit) {
        collector.use("baseColor", material.baseColorTexture);
        features.emission = false;  // KHR_materials_unlit: the base colour is all there is
    } else {
        const Brdf& brdf = requireBrdf(material.brdf);
        for (size_t p = 0; p < material.textures.size(); ++p)
            collector.use(brdf.parameters[p].name, material.textures[p], material.textureChannels[p]);
        collector.use("normal", material.normalTexture);
        if (surroundings) collector.use("occlusion", material.occlusionTexture);
        if (features.emission) collector.use("emission", material.emissionTexture);
    }
    if (material.alphaMode != AlphaMode::opaque) collector.use("alpha", material.baseColorTexture, 3);
    return features;
}

double reachWeight(const Light& light) {
    return std::pow(std::max({light.intensity.r, light.intensity.g, light.intensity.b}), 0.6);
}

SceneSummary summarise(const Scene& scene) {
    SceneSummary summary;
    countLights(scene, summary);

    std::map<std::string, std::map<int, Use>> opaqueUses;  // model -> material -> use
    std::set<SurfaceFeatures> surfaces, withoutOcclusion;
    const bool surroundings = summary.ambient || (summary.environment && summary.environmentCastsShadow);
    std::set<int> materials;
    for (const Instance& instance : scene.instances) {
        const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
        const Material& material = scene.materials[static_cast<size_t>(primitive.material)];
        const SurfaceFeatures features = surfaceFeatures(material, primitive, surroundings);
        addPeak(material, primitive, summary);
        surfaces.insert(features);
        withoutOcclusion.insert(surfaceFeatures(material, primitive, false));
        materials.insert(primitive.material);
        ++summary.instances;
        summary.triangles += primitive.triangleCount();
        if (instance.castsShadow) {
            summary.castingTriangles += primitive.triangleCount();
            summary.maskedCasters |= material.alphaMode == AlphaMode::mask;
            summary.blendedCasters |= material.alphaMode == AlphaMode::blend;
        }
        summary.opaque |= !features.blended() && material.alphaMode == AlphaMode::opaque;
        summary.masked |= !features.blended() && material.alphaMode == AlphaMode::mask;
        summary.emission |= features.emission;
        summary.vertexColors |= features.vertexColors;
        summary.normalMaps |= features.texture("normal") != nullptr;
        summary.occlusion |= features.texture("occlusion") != nullptr;
        for (int set : {0, 1})
            summary.uv[set] |= features.usesUv(set);
        const bool usesTangent = material.brdf != kUnlit && requireBrdf(material.brdf).traits.usesTangent;
        summary.tangents |= usesTangent || features.texture("normal") != nullptr;
        if (features.blended()) {
            summary.blended = true;
            summary.transmits |= features.transmits;
            summary.blendedTriangles += primitive.triangleCount();
            ++summary.blendedInstances;
            summary.blendedBrdfs.insert(material.brdf);
            continue;
        }
        Use& use = opaqueUses[material.brdf][primitive.material];
        use.material = &material;
        use.vertexColors |= features.vertexColors;
    }
    if (!summary.bodyLights.empty() || summary.environment) summary.areaForms = areaForms(scene);
    for (const auto& [name, uses] : opaqueUses) {
        std::vector<Use> list;
        for (const auto& [index, use] : uses)
            list.push_back(use);
        summary.brdfs.push_back(factsOf(name, list));
    }
    countBands(scene, materials, summary);
    for (int material : materials)
        if (const auto why = whyFresnelStays(scene.materials[static_cast<size_t>(material)]))
            ++(why->empty() ? summary.exactFresnel : summary.keptFresnel[*why]);
    summary.tableRows = tableRows(scene.materials);
    summary.surfaces.assign(surfaces.begin(), surfaces.end());
    if (withoutOcclusion != surfaces)
        summary.surfacesWithoutOcclusion.assign(withoutOcclusion.begin(), withoutOcclusion.end());
    summary.materialsInUse.assign(materials.begin(), materials.end());
    summariseTextures(scene, surroundings, summary);
    return summary;
}

}  // namespace lobe
