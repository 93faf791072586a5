/// The quality knobs, and the presets that set them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lobe {

enum class Shading : uint8_t {
    deferred,
    forward  ///< every surface in the forward pass: the check on the deferred path
};

enum class FresnelEquations : uint8_t {
    exact,   ///< as each material says
    schlick  ///< Schlick's approximation in place of the exact equations (withSchlick())
};

enum class Shadows : uint8_t {
    none,
    hard,  ///< as if every light were a point at its centre, or at infinity
    soft   ///< lights with a body cast penumbrae; for the others the same as hard
};

enum class ShadowMethod : uint8_t {
    automatic,  ///< the plan chooses for each type of light
    maps,       ///< depth from the light, filtered
    rays        ///< exact, through a hierarchy of bounding volumes
};

enum class AreaLights : uint8_t {
    analytic,  ///< integrals in closed form or by fits, where a model has them
    sampled    ///< points on the light: converges to the truth
};

enum class EnvironmentLighting : uint8_t {
    prefiltered,  ///< integrals over the map, made beforehand, where a model's lobe can be split from it
    sampled       ///< directions: converges to the truth
};

enum class EnvironmentDiffuse : uint8_t {
    sh2,  ///< nine coefficients of spherical harmonics
    sh4,  ///< twenty-five
    map   ///< integrated for every direction of a small map
};

enum class AmbientOcclusion : uint8_t {
    off,
    low,  ///< few looks into the depth buffer
    high
};

enum class Transparency : uint8_t {
    sorted,  ///< whole objects, back to front
    peeled   ///< layer by layer, exact
};

struct Quality {
    /// Samples per pixel: jittered frames, accumulated in 32-bit float, box filter (anti-aliasing none,
    /// ssaa4, ssaa16).
    int samples = 4;
    /// Bits of each per-pixel parameter in the G-buffer: 8, 16 (unorm) or 32 (float). Normals follow where
    /// normalBits does not say otherwise: 32 here means 2x32F.
    int gbufferBits = 16;
    /// Bits of each of the two octahedral coordinates of a normal in the G-buffer: 8, 16 (unorm) or 32
    /// (float); 0: what the sharpest lobe needs, 16 or 32.
    int normalBits = 0;
    /// Bits a texel component of textures that are filtered: 8, 16 or 32 (float).
    int textureBits = 8;
    Shading shading = Shading::deferred;
    /// Light lists per cluster of pixels: from this many lights of a type on; 0: never.
    int clusterFrom = 9;

    /// Bits of each component of the target that lights add to: 16 or 32 (float). The mean of the samples has
    /// 32 either way. A sample's radiance from 65504 on is infinite with 16.
    int radianceBits = 32;
    FresnelEquations fresnel = FresnelEquations::exact;

    Shadows shadows = Shadows::soft;
    ShadowMethod shadowMethod = ShadowMethod::automatic;
    int shadowSize = 2048;  ///< texels along each side of a shadow map
    int shadowTaps = 16;    ///< depth comparisons for each look into a shadow map
    AreaLights areaLights = AreaLights::analytic;
    /// Points on each light with a body, for each sample of a pixel: for its shadow, and where it is sampled.
    int lightSamples = 16;
    /// Most radiance that lights which are left out may take from a pixel, in thousandths of the radiance
    /// that is shown as white; 0: no light is left out.
    int lightThreshold = 0;
    int airlightNodes =
        8;  ///< of the quadrature along the view ray, for each light that fog scatters; 0: none
    EnvironmentLighting envLighting = EnvironmentLighting::prefiltered;
    EnvironmentDiffuse envDiffuse = EnvironmentDiffuse::map;
    /// Directions to the environment, for each sample of a pixel, where it is sampled.
    int envSamples = 32;
    /// Of the prefiltered environment, where shadows are on: what the depth buffer shows to be in its way.
    AmbientOcclusion ambientOcclusion = AmbientOcclusion::low;
    Transparency transparency = Transparency::sorted;

    bool operator==(const Quality&) const = default;
};

/// draft, balanced, high, converged.
const std::vector<std::string>& qualityPresetNames();
Quality qualityPreset(const std::string& name);  ///< throws UsageError

}  // namespace lobe
