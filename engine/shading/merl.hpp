/// Tables of isotropic reflectance over half and difference angles, as the MERL database stores them.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "shading/brdf.hpp"

namespace lobe::shading {

/// Cells along theta_h, theta_d and phi_d.
struct MerlSize {
    size_t thetaH = 90, thetaD = 90, phiD = 180;
    size_t cells() const { return thetaH * thetaD * phiD; }
};

/// The pair of directions of these angles in radians (Rusinkiewicz, EGWR 1998); its half vector lies in the
/// xz plane. One of them may be below the horizon.
Directions fromHalfAndDifference(double thetaH, double thetaD, double phiD);

/// Rows as measured.glsl reads them from a file of the database (Matusik et al., ACM TOG 22(3), 2003): three
/// little-endian int32 sizes, then all red, all green and all blue values as float64. Negative values mark
/// cells that were not measured and become 0. Throws InputError.
TableRows merlTable(std::span<const std::byte> file);

/// The same from a function of the directions, by its values at the cells' centres.
TableRows tabulated(const MerlSize& size, const std::function<glm::dvec3(const Directions&)>& reflectance);

}  // namespace lobe::shading
