/// What the plan must know of a scene: a few facts, taken once.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace lobe {

/// Facts about all materials of one model that are in use.
struct BrdfFacts {
    std::string name;
    int materials = 0;
    std::set<int> texturedParameters;   ///< indices into Brdf::parameters
    bool vertexColors = false;          ///< some primitive multiplies its base colour by vertex colours
    double sharpness = 0.0;             ///< largest Brdf::lobeSharpness
    bool usesTangent = false;
};

/// One combination of features that a surface shader must serve: a variant of the G-buffer or forward program.
struct SurfaceFeatures {
    std::string brdf;
    std::set<int> texturedParameters;
    bool normalMap = false;
    bool occlusionMap = false;
    bool emissionMap = false;
    bool emission = false;
    bool vertexColors = false;
    bool alphaTexture = false;
    bool secondUv = false;
    bool textureTransform = false;
    AlphaMode alphaMode = AlphaMode::opaque;
    auto operator<=>(const SurfaceFeatures&) const = default;
};

struct SceneSummary {
    std::vector<BrdfFacts> brdfs;          ///< sorted by name; "unlit" included
    std::set<SurfaceFeatures> surfaces;
    int materialCount = 0;                 ///< in use
    int directionalLights = 0, pointLights = 0, spotLights = 0;
    int rangedPointLights = 0, rangedSpotLights = 0;
    bool ambient = false;
    bool emission = false;
    bool blended = false, masked = false, opaque = false;
    bool normalMaps = false, tangents = false, vertexColors = false, secondUv = false, occlusion = false;
    size_t triangles = 0, instances = 0;
    std::vector<std::string> textures;     ///< names of those in use, with their user
    std::vector<std::string> unusedTextures;
};

SceneSummary summarise(const Scene& scene);

/// What a material asks of a surface shader, with the vertex data that `primitive` brings.
SurfaceFeatures surfaceFeatures(const Material& material, const Primitive& primitive);

/// The scene with every material's model replaced (`--brdf NAME`), parameters by Brdf::fromMetallicRoughness and the
/// base colour texture carried over; unlit materials stay.
Scene withBrdf(const Scene& scene, const Brdf& brdf);

/// The documented light of a scene without any: see docs/scenes.md. Returns false if the scene needs none.
bool addDefaultLight(Scene& scene, const Camera& camera);

}  // namespace lobe
