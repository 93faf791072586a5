/// SceneSummary x Quality x Capabilities -> FramePlan: what runs, in which variant, into which targets, and
/// what is left out, each with its reason. Pure: no OpenGL, no files.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "plan/aov.hpp"
#include "plan/capabilities.hpp"
#include "plan/quality.hpp"
#include "plan/shadow_layout.hpp"
#include "plan/summary.hpp"

namespace lobe {

/// A texture of the frame, by what it holds.
struct Channel {
    std::string name;    ///< "depth", "normal", "material", "parameters0", "radiance", ...
    std::string format;  ///< GL name: "RG16", "RGBA32F", "DEPTH_COMPONENT32F"
    int bytesPerPixel = 0;
    std::string holds;   ///< for people: "octahedral shading normal", "baseColor.rgb roughness"
    std::string reason;  ///< why it is there and why in this format
};

/// Where a parameter that varies within a material is kept in the G-buffer.
struct ParameterPlace {
    int parameter = -1;  ///< index in Brdf::parameters
    int target = 0;      ///< parameters0, parameters1, ...
    int component = 0;   ///< first component in that target
};

/// One model of the opaque surfaces, as the lighting passes see it. Parameters that are in neither list are
/// the same for all its materials and reach the shaders as uniforms.
struct PlannedBrdf {
    std::string name;
    int stencil = 0;                       ///< mask value; 0 when all pixels have this model
    std::vector<ParameterPlace> perPixel;  ///< read from the G-buffer
    std::vector<int> perMaterial;          ///< looked up in the material table, packed in this order
};

/// One compiled form of a pass's program.
struct Variant {
    std::string brdf;
    int surface = -1;                            ///< index into FramePlan::surfaces; -1 for screen passes
    std::map<std::string, std::string> defines;  ///< sorted by key
};

struct PlannedPass {
    std::string name;     ///< "gbuffer", "light.point", "forward", ...
    std::string program;  ///< shader file; empty for passes without one
    std::vector<Variant> variants;
    std::vector<std::string> reads, writes;  ///< channel names
    std::string reason;                      ///< why it runs
};

struct LeftOut {
    std::string kind;  ///< "pass", "channel", "vertex data", "texture", "buffer", "program part"
    std::string name;
    std::string reason;
};

/// How the shadows of one type of light are found.
enum class PlannedShadow : uint8_t { none, maps, rays };

/// How what the surfaces of one model show of lights with a body is found.
enum class AreaMethod : uint8_t {
    analytic,  ///< the whole light in closed form; its shadow by points
    sampled,   ///< by points on the light
    mirrored   ///< where the mirrored ray meets it
};
struct PlannedArea {
    AreaMethod method = AreaMethod::sampled;
    std::string reason;
    AreaForm form = {};  ///< the table of fits, where it is analytic
};

/// How what the surfaces of one model show of the environment is found.
enum class EnvironmentMethod : uint8_t {
    prefiltered,  ///< from the map integrated over the model's lobe
    sampled,      ///< by directions
    mirrored      ///< where the mirrored ray points
};
struct PlannedEnvironment {
    EnvironmentMethod method = EnvironmentMethod::sampled;
    std::string reason;
    AreaForm form = {};  ///< what the prefiltered map is made for
};

struct FramePlan {
    Quality quality;
    int samples = 1;
    bool reversedDepth = true;  ///< needs clip control; otherwise linear z in a channel of its own
    bool masked = false;        ///< lighting passes are masked by stencil, a value a model
    bool ambient = false;
    bool surroundings = false;  ///< surfaces are drawn with SceneSummary's `surroundings`
    bool clusteredPoint = false, clusteredSpot = false;
    /// Metres beyond which a light of intensity 1 W/sr is left out; one of intensity I: times I^(1/5). 0:
    /// none is.
    double lightReach = 0.0;
    int globalPointLights = 0, globalSpotLights = 0;  ///< lights that reach every pixel, outside the clusters
    std::map<LightType, PlannedShadow> shadows;       ///< of each type that the scene has
    std::map<std::string, PlannedArea> areaMethods;   ///< by model, where the scene has lights with a body
    int areaPoints = 0;         ///< on each light with a body, in each frame; 0: none are needed
    int areaPointsForward = 0;  ///< the same, for surfaces of the forward pass
    bool lightImages = false;   ///< images of rects are looked up
    std::map<std::string, PlannedEnvironment>
        environmentMethods;             ///< by model, where the scene has an environment
    int environmentSamples = 0;         ///< directions to it in each frame; 0: none are needed
    int environmentSamplesForward = 0;  ///< the same, for surfaces of the forward pass
    PlannedShadow environmentShadow = PlannedShadow::none;
    /// Occlusion textures keep what is prefiltered of it from surfaces.
    bool occlusionTextures = false;
    /// So does what the depth buffer shows: half planes about the view ray, looks along each side of one. 0:
    /// it does not.
    int occlusionSlices = 0, occlusionSteps = 0;
    bool environmentMap = false;   ///< its picture itself is looked up, not only what is made of it
    bool rays = false;             ///< the scene's hierarchy of boxes is made for the rays of some program
    int airlightNodes = 0;         ///< of each lamp's airlight; 0: there is none
    int mostLayers = 0;            ///< of blended surfaces that are peeled; 0: they are sorted by object
    PlannedShadowMaps shadowMaps;  ///< of the types whose shadows are maps
    std::vector<SurfaceFeatures> surfaces;
    std::vector<PlannedBrdf> brdfs;
    std::vector<Channel> channels;
    std::vector<std::string>
        gbufferTargets;  ///< colour attachments of the G-buffer pass, in order of location
    std::vector<std::string>
        contributionTargets;               ///< of the contributions AOV, in order of summation; else empty
    std::vector<std::string> dataTargets;  ///< colour attachments of the AOV pass
    std::vector<PlannedPass> passes;
    std::vector<LeftOut> leftOut;
    std::vector<std::string>
        lightGroups;                    ///< for people: "point: 100 lights in clusters of 64 px x 24 slices"
    std::vector<std::string> textures;  ///< for people: one line a texture kept
    std::vector<std::string> notes;     ///< decisions about the whole frame

    PlannedShadow shadowOf(LightType type) const;
    bool anyShadow() const;
    const PlannedPass* pass(std::string_view name) const;
    const Channel* channel(std::string_view name) const;
    const PlannedBrdf* brdf(std::string_view name) const;
    int gbufferBytesPerPixel() const;
};

/// Most rays, and most points without rays, that a fragment of one draw follows to lights with a body:
/// llvmpipe ends loops at 65535 rounds in all, and few rays take more than 500.
inline constexpr int kRaysPerDraw = 16;
/// Of draws that cannot be split.
inline constexpr int kRaysPerForwardDraw = 64;
inline constexpr int kPointsPerDraw = 32768;

/// Directions to the environment from which pixels take theirs.
inline constexpr int kEnvironmentDirections = 16384;

/// "directional", "rect", ...
const char* nameOf(LightType type);

FramePlan planFrame(const SceneSummary& summary, const Quality& quality, const Capabilities& capabilities,
                    const AovSet& aovs = {Aov::radiance});

std::string toText(const FramePlan& plan);  ///< for `lobe plan`
std::string toJson(const FramePlan& plan);  ///< schema: docs/plan.md; key "schema": 1

}  // namespace lobe
