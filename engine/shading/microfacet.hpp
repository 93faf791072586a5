/// What the microfacet models' registry entries have in common: k_d, k_s, and a lobe that Fresnel's equations
/// weight.
#pragma once

#include "shading/fresnel.hpp"

namespace lobe::shading {

/// `diffuse`, `specular`, then the lobe's own, then those of fresnelParameters().
std::vector<Parameter> microfacetParameters(std::vector<Parameter> lobe);

/// k_d / pi + k_s F lobe for `lobe` = D G / (4 cos cos), times cos(theta_i).
glm::dvec3 microfacetFCos(const Directions& d, std::span<const double> values, double lobe);

/// D and G as given, and F: the lobe is their product over 4 cos cos.
std::vector<BrdfFactor> microfacetFactors(const Directions& d, std::span<const double> values,
                                          double distribution, double masking);

/// k_d + k_s F at normal incidence.
glm::dvec3 microfacetAmbient(std::span<const double> values);

/// Brdf::peak for a bound of D G / (4 cos(theta_o)). F is at most 1; in bands of wavelength there is none.
glm::dvec3 microfacetPeak(std::span<const double> values, double lobe);

/// Weights k_d and k_s F at wo; `lobe` says the rest.
SamplingLobes microfacetLobes(const glm::dvec3& wo, std::span<const double> values, SamplingLobe lobe);

/// k_d = 0.96 (1 - metallic) base colour, k_s = 1, Schlick's F with glTF's normal reflectance; `lobe` has the
/// values of the lobe's own parameters.
ParameterValues microfacetFromMetallicRoughness(const MetallicRoughness& surface,
                                                const std::vector<double>& lobe);

/// Lambert's part k_d; terms of Schlick's F, (1 - S) lobe and S lobe with S = (1 - V.H)^5, or of the exact F,
/// F lobe. `lobe` is D G / (4 cos cos) for directions above the surface.
AreaModel microfacetArea(std::function<double(const Directions&, std::span<const double>)> lobe);

/// Whether any channel of k_s is above 0.
bool hasSpecular(std::span<const double> values);

/// Beckmann's distribution, D (N.H) of integral 1 over the hemisphere, for the unit half vector in the local
/// frame.
double beckmann(const glm::dvec3& h, double m);

}  // namespace lobe::shading
