#include "plan/quality.hpp"

#include "base/closest_name.hpp"
#include "base/error.hpp"

namespace lobe {

const std::vector<std::string>& qualityPresetNames() {
    static const std::vector<std::string> names = {"draft", "balanced", "high", "converged"};
    return names;
}

Quality qualityPreset(const std::string& name) {
    if (name == "draft")
        return {.samples = 1,
                .gbufferBits = 8,
                .textureBits = 8,
                .shadows = Shadows::none,
                .envDiffuse = EnvironmentDiffuse::sh2,
                .envSamples = 16,
                .ambientOcclusion = AmbientOcclusion::off};
    if (name == "balanced") return {};
    if (name == "high")
        return {
            .samples = 4, .gbufferBits = 32, .textureBits = 16, .ambientOcclusion = AmbientOcclusion::high};
    if (name == "converged")
        return {.samples = 16,
                .gbufferBits = 32,
                .textureBits = 32,
                .shadowMethod = ShadowMethod::rays,
                .areaLights = AreaLights::sampled,
                .lightSamples = 64,
                .airlightNodes = 32,
                .envLighting = EnvironmentLighting::sampled,
                .envSamples = 64,
                .transparency = Transparency::peeled};
    throw UsageError("quality '" + name + "'; expected draft, balanced, high or converged" +
                     didYouMean(name, qualityPresetNames()));
}

}  // namespace lobe
