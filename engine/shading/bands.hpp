/// Fresnel's equations in bands of wavelength: what each band reflects, summed to linear sRGB.
#pragma once

#include <complex>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "shading/brdf.hpp"
#include "shading/spectral_metals.hpp"

namespace lobe::shading {

/// One of N parts of 380 to 780 nm, all of one width.
struct Band {
    double from = 0.0, to = 0.0;  ///< nm
    std::complex<double> index;   ///< mean over the band
    glm::dvec3 weight{0.0};       ///< in red, green and blue; may be negative; those of all bands add up to 1
};

/// Weights from the CIE 1931 2 degree colour matching functions (fit of Wyman, Sloan and Shirley, JCGT 2(2),
/// 2013) under CIE D65, turned to linear sRGB and divided by their sums: what reflects all wavelengths alike
/// is grey.
const std::vector<Band>& bandsOf(const MetalSpectrum& metal, int count);

/// Linear sRGB reflectance at cos(theta): sum of weight times Fresnel's exact reflectance, at least 0 a
/// channel.
glm::dvec3 bandReflectance(const std::vector<Band>& bands, double cosTheta, double oneMinusCos);
inline glm::dvec3 bandReflectance(const std::vector<Band>& bands, double cosTheta) {
    return bandReflectance(bands, cosTheta, 1.0 - cosTheta);
}

/// Rows that fresnel_bands() of common/fresnel.glsl reads: the number of groups of three bands in x; then, a
/// group, a row of eta, a row of k, and the weights of each band.
const TableRows& bandRows(const MetalSpectrum& metal, int count);

/// Where a model's values hold the object "fresnel" of the scene format; nothing for models without.
struct FresnelPlaces {
    size_t type = 0, eta = 0, k = 0;
};
std::optional<FresnelPlaces> fresnelPlaces(const Brdf& brdf);

/// Bands in a model's values: type FresnelType::bands, which no file names; eta = (number of the spectrum
/// from 1, number of bands, 0); k = (first row of its table, 0, 0).
bool hasBands(const Brdf& brdf, std::span<const double> values);
void setBands(const Brdf& brdf, ParameterValues& values, const MetalSpectrum& metal, int count);
/// The spectrum that `eta` of such values stands for, and its bands' rows.
const std::vector<Band>& bandsIn(std::span<const double> eta);
const TableRows& bandRowsIn(std::span<const double> eta);

}  // namespace lobe::shading
