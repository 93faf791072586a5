/// Ideal specular reflection: a delta in the mirrored direction, weighted by Fresnel's equations.
#include "shading/fresnel.hpp"

namespace lobe::brdf_entry {

Brdf mirror() {
    using namespace shading;
    Brdf brdf;
    brdf.name = "mirror";
    brdf.title = "Ideal mirror";
    brdf.source =
        "M. Born and E. Wolf, Principles of Optics; C. Schlick, Computer Graphics Forum 13(3), 1994";
    brdf.parameters = fresnelParameters();
    brdf.traits.scattersLight = false;
    brdf.baseColorParameter = "f0";
    brdf.fCos = [](const Directions&, std::span<const double>) { return glm::dvec3(0.0); };
    brdf.mirror = [](double cosTheta, std::span<const double> values) {
        return fresnelReflectance(values, cosTheta);
    };
    brdf.ambient = [](std::span<const double> values) { return fresnelReflectance(values, 1.0); };
    brdf.lobeSharpness = [](std::span<const double>) { return 0.0; };
    brdf.fromMetallicRoughness = fresnelFromMetallicRoughness;
    return brdf;
}

}  // namespace lobe::brdf_entry
