// Schlick's approximation in place of Fresnel's equations, for a whole scene.
#include "plan/summary.hpp"
#include "shading/bands.hpp"
#include "shading/fresnel.hpp"

namespace lobe {

using shading::FresnelType;

std::optional<std::string> whyFresnelStays(const Material& material) {
    const Brdf* brdf = findBrdf(material.brdf);
    const auto places = brdf != nullptr ? shading::fresnelPlaces(*brdf) : std::nullopt;
    if (!places || !brdf->traits.scattersLight) return std::nullopt;  // a mirror shows F0 only
    const auto type = static_cast<FresnelType>(static_cast<int>(material.values[places->type]));
    if (type == FresnelType::schlick) return std::nullopt;
    if (type == FresnelType::bands) return "the metal is evaluated in bands of wavelength";
    for (const char* name : {"eta", "k"})
        if (material.textures[static_cast<size_t>(brdf->parameterIndex(name))])
            return "the index is textured";
    return "";
}

Scene withSchlick(const Scene& scene) {
    Scene result = scene;
    for (Material& material : result.materials) {
        if (whyFresnelStays(material) != "") continue;
        const Brdf& brdf = requireBrdf(material.brdf);
        const size_t type = shading::fresnelPlaces(brdf)->type;
        const auto values = std::span<const double>(material.values).subspan(type, shading::kFresnelValues);
        const glm::dvec3 f0 = shading::fresnelReflectance(values, 1.0);
        const int index = brdf.parameterIndex("f0");
        const auto place = static_cast<size_t>(brdf.valueOffset(index));
        for (int c = 0; c < 3; ++c)
            material.values[place + static_cast<size_t>(c)] = f0[c];
        material.values[type] = static_cast<double>(FresnelType::schlick);
        material.textures[static_cast<size_t>(index)] = {};  // it would multiply what was not read before
    }
    return result;
}

}  // namespace lobe
