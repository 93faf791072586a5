// Metals in bands of wavelength, for a whole scene.
#include <algorithm>
#include <map>

#include "plan/summary.hpp"
#include "scene/brdf_tables.hpp"
#include "shading/bands.hpp"
#include "shading/fresnel.hpp"
#include "shading/metals.hpp"

namespace lobe {
namespace {

using shading::FresnelPlaces;

/// The metal whose three indices these are: named in the scene, or by brdf_set.
const shading::Metal* metalIn(std::span<const double> values, const FresnelPlaces& places) {
    const auto same = [&](const glm::dvec3& rgb, size_t offset) {
        return rgb.r == values[offset] && rgb.g == values[offset + 1] && rgb.b == values[offset + 2];
    };
    for (const shading::Metal& metal : shading::metals())
        if (same(metal.eta, places.eta) && same(metal.k, places.k)) return &metal;
    return nullptr;
}

bool isTextured(const Brdf& brdf, const Material& material) {
    return std::any_of(material.textures.begin(), material.textures.end(), [&](const TextureSlot& slot) {
        const std::string& name = brdf.parameters[static_cast<size_t>(&slot - material.textures.data())].name;
        return slot && (name == "eta" || name == "k");
    });
}

std::string namesOf(const std::vector<std::string>& names) {
    constexpr size_t kMost = 3;
    std::string text = names.size() == 1 ? "material " : "materials ";
    for (size_t i = 0; i < std::min(kMost, names.size()); ++i)
        text += (i > 0 ? ", '" : "'") + names[i] + "'";
    return text + (names.size() > kMost ? " and " + std::to_string(names.size() - kMost) + " more" : "");
}

}  // namespace

Scene withBands(const Scene& scene, int count) {
    Scene result = scene;
    bool any = false;
    std::map<std::string, std::vector<std::string>> kept;  // reason -> materials
    for (Material& material : result.materials) {
        const Brdf* brdf = findBrdf(material.brdf);
        const auto places = brdf != nullptr ? shading::fresnelPlaces(*brdf) : std::nullopt;
        if (!places || material.values[places->type] != static_cast<double>(shading::FresnelType::conductor))
            continue;
        const shading::Metal* metal = metalIn(material.values, *places);
        const shading::MetalSpectrum* spectrum =
            metal != nullptr ? shading::metalSpectrum(metal->name) : nullptr;
        if (isTextured(*brdf, material)) {
            kept["its index is textured"].push_back(material.name);
        } else if (spectrum == nullptr) {
            kept[metal != nullptr ? "no spectrum of " + metal->name + " comes with Lobe"
                                  : "its index is given for red, green and blue only"]
                .push_back(material.name);
        } else {
            shading::setBands(*brdf, material.values, *spectrum, count);
            any = true;
        }
    }
    for (const auto& [reason, names] : kept)
        result.warnings.push_back("bands: " + namesOf(names) + ": " + reason + "; evaluated in RGB");
    if (!any)
        result.warnings.emplace_back("bands: no material has a metal by name; nothing is evaluated in bands");
    placeTables(result.materials);
    return result;
}

}  // namespace lobe
