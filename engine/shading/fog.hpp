/// Double-precision twins of light/fog.glsl and light/airlight.glsl: what fog takes from a ray, and what it
/// scatters into it (docs/fog_and_transparency.md).
#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace lobe {

/// A medium whose density falls off with height: extinction sigma(y) = extinction exp(-heightFalloff (y -
/// height)).
struct FogMedium {
    glm::dvec3 extinction{0.0};  ///< 1/m
    double heightFalloff = 0.0;  ///< 1/m; 0: the same everywhere
    double height = 0.0;         ///< world y, metres
    glm::dvec3 scattering{0.0};  ///< 1/m, at most the extinction; of homogeneous fog only
    double anisotropy = 0.0;     ///< Henyey and Greenstein's g, in (-1, 1): the mean cosine of scattering
};

/// (1 - e^-x) / x for x >= 0: 1 at 0, 0 at infinity.
double fogPhi(double x);

/// 1 - e^-depth for a depth from 0 to infinity.
double fogOpacity(double depth);

/// Optical depth of a straight way of `length` metres (or infinity) that starts at world height `start` and
/// rises by `rise` (-1 to 1) a metre. The mean density is taken from the lower end, so that nothing
/// overflows.
glm::dvec3 fogOpticalDepth(const FogMedium& fog, double start, double rise, double length);
glm::dvec3 fogTransmittance(const FogMedium& fog, double start, double rise, double length);

/// Henyey and Greenstein's phase function, 1/sr, integrating to 1 over all directions; `cosine` between the
/// way that light travels before and after.
double henyeyGreenstein(double cosine, double anisotropy);

/// A point light, or a spot light where it has a cone.
struct FogLight {
    glm::dvec3 position{0.0};
    glm::dvec3 intensity{1.0};  ///< W/sr
    std::optional<double> range;
    glm::dvec3 axis{0.0, 0.0, -1.0};  ///< of the cone, unit, the way light travels
    double innerConeAngle = 0.0;      ///< radians
    std::optional<double> outerConeAngle;
};

/// How near to a light a ray counts as passing, metres: the radiance there is finite.
inline constexpr double kAirlightNearest = 1e-6;

/// Radiance that homogeneous fog scatters once, of one light, towards the origin of a ray (direction unit)
/// from its first `length` metres (or infinity): the integral over s of
///   scattering p(cos) I w(r) A / (r^2) exp(-extinction (s + r)),
/// r the distance from the point at s to the light, w the window of its range, A the spot's falloff, p Henyey
/// and Greenstein's phase function. Light is dimmed on its way to the point and from there to the origin.
/// Distances from the ray to the light below kAirlightNearest count as that. To a relative error of about
/// 1e-9.
glm::dvec3 airlight(const FogMedium& fog, const FogLight& light, const glm::dvec3& origin,
                    const glm::dvec3& direction, double length);

}  // namespace lobe
