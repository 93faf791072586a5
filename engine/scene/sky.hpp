/// Skies as radiance by direction, and the sun that belongs to them.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "image/image.hpp"
#include "scene/environment_source.hpp"

namespace lobe {

/// Photometric units become radiometric ones of the visible part of the spectrum, per channel, by this many
/// lm/W: what white light of 380 to 780 nm has (as Radiance has it, Ward 1994).
inline constexpr double kLumensPerWatt = 179.0;

/// Limits of Preetham's turbidity: below, the zenith's luminance would turn negative; above, the paper has no
/// data.
inline constexpr double kLeastTurbidity = 1.7, kMostTurbidity = 10.0;

/// A sky whose colours are those of its model's default: radiance 1 of a constant one, a bright horizon below
/// a blue zenith of a gradient, grey ground of Preetham's.
Sky defaultSky(SkyModel model);

/// Linear sRGB mixed with the grey of its luminance until no channel is negative.
glm::dvec3 insideGamut(const glm::dvec3& rgb);

/// Irradiance of the sun's disc on a facing surface at the ground, W/m^2 in linear sRGB: spectrum and
/// transmittance of the atmosphere after Preetham, Shirley and Smits, "A Practical Analytic Model for
/// Daylight", SIGGRAPH 1999, appendix 1. `elevation`: rad, 0 to pi / 2.
glm::dvec3 sunIrradiance(double turbidity, double elevation);

/// - constant: Sky::zenith from everywhere.
/// - gradient: from the horizon to the zenith, and to the nadir, linear in the sine of elevation.
/// - preetham: the clear sky of that paper (appendix 2: Perez' distribution, zenith luminance and
/// chromaticity);
///   below the horizon a Lambert ground of Sky::ground as that sky and its sun light it.
class SkyRadiance {
public:
    /// Values in the ranges that Sky names.
    explicit SkyRadiance(const Sky& sky);

    /// W/(m^2 sr), linear sRGB, from a unit direction; without the sun's disc. Finite, at least 0.
    glm::dvec3 at(const glm::dvec3& direction) const;
    /// Of the sun's disc on a facing surface, W/m^2; 0 where the sky has no sun.
    const glm::dvec3& sun() const { return sun_; }
    /// Unit, towards the sun.
    const glm::dvec3& toSun() const { return toSun_; }
    /// Of sky and sun on the level ground, W/m^2; preetham.
    const glm::dvec3& onGround() const { return onGround_; }

private:
    struct Perez {
        std::array<double, 5> c{};
        double zenith = 0.0;  ///< over the distribution's value there
        double at(double cosZenith, double cosGamma, double gamma) const;
    };
    glm::dvec3 above(const glm::dvec3& direction) const;
    Sky sky_;
    std::array<Perez, 3> perez_;  ///< x, y, and Y in cd/m^2
    glm::dvec3 sun_{0.0}, toSun_{0.0, 1.0, 0.0}, onGround_{0.0};
};

/// As an equirectangular picture of 32-bit floats, 2 `height` x `height`, texels as in their middles.
/// `sunDiameter`, rad: with the sun's disc of that size in it, texels near it as means; 0: without.
Bitmap skyPicture(const SkyRadiance& sky, int height, double sunDiameter = 0.0);

}  // namespace lobe
