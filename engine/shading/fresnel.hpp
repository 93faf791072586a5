/// Reflectance of a smooth interface for unpolarised light, and the four parameters by which models name it.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "shading/parameters.hpp"

namespace lobe::shading {

/// `bands` (shading/bands.hpp) takes the place of a metal's three indices where more are asked for.
enum class FresnelType : uint8_t { schlick, dielectric, conductor, bands };

/// Exact, for one wavelength.
double exactReflectance(std::complex<double> index, double cosTheta);
/// 1 - cos(theta) given along, to all digits near 0 too.
double exactReflectance(std::complex<double> index, double cosTheta, double oneMinusCos);

/// Parameters `fresnel` (the type), `f0`, `eta`, `k`: the scene format's object "fresnel".
std::vector<Parameter> fresnelParameters();
inline constexpr size_t kFresnelValues = 10;

/// Reflectance at cos(theta) in 0..1 for the ten values of fresnelParameters(). Exact equations (Born and
/// Wolf, Principles of Optics) with complex index eta + i k; Schlick, Computer Graphics Forum 13(3), 1994.
glm::dvec3 fresnelReflectance(std::span<const double> values, double cosTheta);

/// The same for the angle between either direction and their half vector, to all digits near 0 too.
glm::dvec3 fresnelReflectance(std::span<const double> values, const Directions& d);

/// 1 - V.H, to all digits near 0 too.
double oneMinusCosThetaD(const Directions& d);

/// Squared amplitudes from Snell's law with the complex index eta + i k, perpendicular (s) and parallel (p)
/// to the plane of incidence; unpolarised light has their mean.
struct PolarisedReflectance {
    double s, p;
};
PolarisedReflectance polarisedReflectance(std::complex<double> index, double cosTheta, double oneMinusCos);

struct Metal;
/// Makes the model's interface the metal's: conductor with its index. `values` are the model's.
void setMetal(const Brdf& brdf, std::span<double> values, const Metal& metal);

/// The equations that an interface of type `present` is computed with once the parameters `named` were set: a
/// value puts in use what reads it (`f0`: Schlick; `k`: conductor; `eta`: dielectric, where neither exact
/// type is in use). `named` may hold "metal", which stands for conductor, eta and k, and "fresnel" with its
/// `choice`. Throws UsageError "WHERE: ..." where two of them contradict each other.
FresnelType fresnelTypeFor(FresnelType present, const std::vector<std::string>& named,
                           const std::string& choice, const std::string& where);

/// The values that imitate a metallic-roughness surface: Schlick with glTF's normal reflectance.
std::vector<double> fresnelFromMetallicRoughness(const MetallicRoughness& surface);

}  // namespace lobe::shading
