/// Ideal diffuse reflection: f_r = k_d / pi.
#include <glm/gtc/constants.hpp>

#include "shading/parameters.hpp"

namespace lobe::brdf_entry {

Brdf lambert() {
    using namespace shading;
    Brdf brdf;
    brdf.name = "lambert";
    brdf.title = "Lambert";
    brdf.source = "J. H. Lambert, Photometria, 1760";
    brdf.parameters = {colorParameter("diffuse", glm::dvec3(1.0), "reflectance k_d")};
    brdf.baseColorParameter = "diffuse";
    brdf.fCos = [](const Directions& d, std::span<const double> values) {
        if (!aboveSurface(d)) return glm::dvec3(0.0);
        return rgbAt(values, 0) / glm::pi<double>() * d.wi.z;
    };
    AreaModel area;
    area.terms = 0;
    area.colors = {"diffuse"};
    area.weights = [](std::span<const double> values) { return AreaWeights{rgbAt(values, 0), {}}; };
    area.parts = [](const Directions&, std::span<const double>) { return AreaTerms{}; };
    brdf.area = std::move(area);
    brdf.ambient = [](std::span<const double> values) { return rgbAt(values, 0); };
    brdf.lobeSharpness = [](std::span<const double>) { return 0.0; };
    brdf.peak = [](std::span<const double> values) { return rgbAt(values, 0) / glm::pi<double>(); };
    brdf.samplingLobes = [](const glm::dvec3&, std::span<const double>) {
        SamplingLobes lobes;
        lobes.add({LobeShape::cosine});
        return lobes;
    };
    brdf.fromMetallicRoughness = [](const MetallicRoughness& surface) {
        return ParameterValues{surface.baseColor.r, surface.baseColor.g, surface.baseColor.b};
    };
    return brdf;
}

}  // namespace lobe::brdf_entry
