#include "shading/phong_family.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace lobe::shading {
namespace {

constexpr double kMaxShininess = 1e6;

}  // namespace

std::vector<Parameter> phongParameters() {
    return {rgbParameter("ambient", glm::dvec3(0.0), "k_a: share of the ambient radiance that is reflected"),
            colorParameter("diffuse", glm::dvec3(0.5), "k_d: diffuse reflection"),
            colorParameter("specular", glm::dvec3(0.5), "k_s: scale of the lobe"),
            scalarParameter("shininess", 32.0, 0.0, kMaxShininess, "exponent n of the lobe"),
            choiceParameter(
                "normalization", {"classic", "energy"},
                "classic: k_d cos + k_s lobe, as textbooks write it; energy: a BRDF whose lobe has albedo 1 "
                "at normal incidence")};
}

PhongValues phongValues(std::span<const double> values) {
    return {rgbAt(values, 0), rgbAt(values, 3), rgbAt(values, 6), values[9], values[10] == 1.0};
}

glm::dvec3 phongAmbient(std::span<const double> values) {
    return rgbAt(values, 0);
}

AreaModel phongArea(std::function<double(const Directions&, const PhongValues&)> lobe) {
    AreaModel area;
    area.colors = {"ambient", "diffuse", "specular"};
    area.width = "shininess";
    area.widths = {0.1, kMaxShininess};
    area.weights = [](std::span<const double> values) {
        const PhongValues p = phongValues(values);
        return AreaWeights{p.diffuse * (p.energy ? 1.0 : glm::pi<double>()), {p.specular, glm::dvec3(0.0)}};
    };
    area.parts = [lobe = std::move(lobe)](const Directions& d, std::span<const double> values) {
        return AreaTerms{1.0, {glm::dvec3(lobe(d, phongValues(values))), glm::dvec3(0.0)}};
    };
    return area;
}

ParameterValues phongFromMetallicRoughness(const MetallicRoughness& surface, double shininess) {
    const glm::dvec3 diffuse = surface.baseColor * (1.0 - surface.metallic) * (1.0 - kDielectricF0);
    const glm::dvec3 specular = glm::mix(glm::dvec3(kDielectricF0), surface.baseColor, surface.metallic);
    ParameterValues values;
    for (const glm::dvec3& color : {surface.baseColor, diffuse, specular})
        values.insert(values.end(), {color.r, color.g, color.b});
    values.push_back(std::clamp(shininess, 0.0, kMaxShininess));
    values.push_back(1.0);
    return values;
}

double cosinePower(double cosine, double sine, double n) {
    if (n == 0.0) return 1.0;
    if (cosine <= 0.0) return 0.0;
    return std::exp(n * (sine < cosine ? 0.5 * std::log1p(-sine * sine) : std::log(cosine)));
}

double blinnExponent(double roughness) {
    return 2.0 / std::pow(roughness, 4.0) - 2.0;
}

}  // namespace lobe::shading
