/// What the plan must know of a scene: a few facts, taken once.
#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "plan/area_forms.hpp"
#include "scene/scene.hpp"

namespace lobe {

/// Name under which an unlit surface stands where others have a registered model.
inline constexpr const char* kUnlit = "unlit";

/// Facts about all materials of one model that are in use.
struct BrdfFacts {
    std::string name;
    int materials = 0;
    std::set<int> perPixel;     ///< indices into Brdf::parameters that a texture or vertex colours vary
    std::set<int> perMaterial;  ///< not per pixel, but different from material to material
    double sharpness = 0.0;     ///< largest Brdf::lobeSharpness
    bool usesTangent = false;
};

/// One texture fetch of a surface shader.
struct SurfaceSample {
    int uvSet = 0;
    bool transformed = false;
    auto operator<=>(const SurfaceSample&) const = default;
};

/// What a fetched texel is used for. Slots are parameter names, or "normal", "occlusion", "emission",
/// "alpha".
struct SurfaceTexture {
    std::string slot;
    int sample = 0;   ///< index into SurfaceFeatures::samples
    int channel = 0;  ///< for scalar slots
    auto operator<=>(const SurfaceTexture&) const = default;
};

/// One combination of features that a surface shader must serve: a variant of the G-buffer or forward
/// program.
struct SurfaceFeatures {
    std::string brdf;
    std::vector<SurfaceSample> samples;
    std::vector<SurfaceTexture> textures;
    bool emission = false;
    bool vertexColors = false;
    AlphaMode alphaMode = AlphaMode::opaque;
    bool transmits = false;  ///< seesThrough(): something of what lies behind shows, in the surface's colour
    auto operator<=>(const SurfaceFeatures&) const = default;

    const SurfaceTexture* texture(std::string_view slot) const;
    bool usesUv(int set) const;
    /// Drawn over what lies behind it, after all that is not.
    bool blended() const { return transmits || alphaMode == AlphaMode::blend; }
};

struct SceneSummary {
    std::set<std::string>
        bandedBrdfs;       ///< models of materials whose metals are evaluated in bands of wavelength
    int exactFresnel = 0;  ///< materials that withSchlick() would change
    std::map<std::string, int> keptFresnel;  ///< why others' exact Fresnel equations stay -> materials
    std::map<std::string, int> bands;        ///< "gold in 16 bands" -> materials
    size_t tableRows = 0;                    ///< of the tables that models read beside their parameters
    std::vector<BrdfFacts> brdfs;  ///< sorted by name; kUnlit included; of opaque and masked surfaces only
    std::set<std::string> blendedBrdfs;
    std::vector<SurfaceFeatures> surfaces;  ///< sorted, each once; with occlusion textures where there is
                                            ///< ambient light or an environment that surfaces block
    std::vector<SurfaceFeatures> surfacesWithoutOcclusion;  ///< where these differ, the same without
    std::vector<int> materialsInUse;                        ///< indices into Scene::materials, ascending
    int directionalLights = 0, pointLights = 0, spotLights = 0;
    int rangedPointLights = 0, rangedSpotLights = 0;
    std::map<LightType, int> bodyLights;        ///< rect, disk, sphere, tube: how many, where there are any
    std::vector<std::string> lightImages;       ///< "64 x 48 texels", of each rect that shows an image
    std::map<std::string, AreaForm> areaForms;  ///< of each model, where there are such lights
    std::map<LightType, int> shadowLights;      ///< that cast shadows, of each type
    /// Of these types, those with one so far away that of a cube of maps the scene would take few texels.
    std::set<LightType> distantShadowLights;
    int wideShadowSpots = 0;  ///< of these, whose shadow maps are cubes (plan/shadow_layout.hpp)
    bool environment = false, fog = false;
    bool environmentPicture = false;                  ///< it is not the same from everywhere
    bool environmentSeen = false;                     ///< where no surface is
    bool environmentOtherSeen = false;                ///< and then as another picture
    bool environmentCastsShadow = false;              ///< surfaces block it
    int environmentWidth = 0, environmentHeight = 0;  ///< of its picture, texels
    std::vector<std::string> environmentNotes;        ///< Environment::notes
    /// What bounds the light of a light that is left out: the largest f_r cos(theta) of any material in use,
    /// 1/sr, infinite where one has no bound, and then the model that has none.
    double peak = 0.0;
    std::string unbounded;
    double reachWeight = 0.0;  ///< sum of lightReach()'s weights of point and spot lights
    bool fogFallsOff = false;  ///< with height
    bool fogGrey = false;      ///< alike in all channels
    bool fogScatters = false;  ///< light of point and spot lights to the eye
    bool ambient = false;
    bool emission = false;
    bool opaque = false, masked = false, blended = false;
    bool transmits = false;  ///< any of the blended ones
    size_t blendedTriangles = 0;
    bool normalMaps = false, tangents = false, vertexColors = false, occlusion = false;
    bool uv[2] = {false, false};
    size_t triangles = 0, instances = 0, blendedInstances = 0;
    size_t castingTriangles = 0;  ///< counting each instance that casts shadows
    bool maskedCasters = false, blendedCasters = false;
    std::vector<std::string> textures;  ///< "images[0] helmet_albedo.jpg: baseColor of 2 materials"
    std::vector<std::string> unusedTextures;

    int castingLights(LightType type) const {
        const auto found = shadowLights.find(type);
        return found == shadowLights.end() ? 0 : found->second;
    }
    bool lit() const { return directionalLights + pointLights + spotLights > 0 || ambient; }
};

SceneSummary summarise(const Scene& scene);

/// Largest channel of a light's intensity to the power 3/5. Lights that may each take as much from a pixel as
/// their weight's share of the sum have the least volume to light in sum.
double reachWeight(const Light& light);

/// What a material asks of a surface shader, with the vertex data that `primitive` brings. `surroundings`:
/// there is ambient light, or an environment, for occlusion textures to act on.
SurfaceFeatures surfaceFeatures(const Material& material, const Primitive& primitive, bool surroundings);

/// The texture slot behind a name of SurfaceTexture::slot.
const TextureSlot& slotOf(const Material& material, std::string_view slot);
/// Whether the texels of a slot are sRGB encoded.
bool slotIsSrgb(const Material& material, std::string_view slot);

/// The scene with every material's model replaced (`--brdf NAME`): parameters by Brdf::fromMetallicRoughness,
/// the base colour texture carried over, other textures by their mean; unlit materials stay.
Scene withBrdf(const Scene& scene, const Brdf& brdf);

/// A parameter's value for a whole scene (`--brdf-set NAME=TEXT`).
struct ParameterOverride {
    std::string name;  ///< as in the scene format or in GLSL; "metal": the three of Fresnel by a name
    std::string text;  ///< as it was written
    std::vector<double> numbers;  ///< what `text` says, where it is one number or three
};

/// The scene with the value set in each material whose model has that parameter, in place of its texture too.
/// Throws UsageError for a value that does not fit, and for a parameter that no model of the scene has.
Scene withParameters(const Scene& scene, const std::vector<ParameterOverride>& changes);

/// The scene with the metals that it names, where their spectra are known, in `count` bands of wavelength (4
/// to 64) in place of three indices; of others it says in its warnings that they stay in RGB.
Scene withBands(const Scene& scene, int count);

/// The scene with lights that cast no shadows.
Scene withoutShadows(const Scene& scene);

/// Why withSchlick() leaves a material's exact Fresnel equations; empty if it replaces them. Without a value
/// if the material has none.
std::optional<std::string> whyFresnelStays(const Material& material);

/// The scene with Schlick's approximation, of the same reflectance at normal incidence, in place of exact
/// Fresnel equations. They stay where one F0 cannot stand for them: in bands of wavelength, and under a
/// textured index.
Scene withSchlick(const Scene& scene);

/// The documented light of a scene without any (docs/scenes.md): a key light over the camera's left shoulder
/// and a little ambient. Returns false, and adds nothing, if the scene has a light or nothing that takes
/// light.
bool addDefaultLight(Scene& scene, const Camera& camera);

}  // namespace lobe
