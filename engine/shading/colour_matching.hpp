/// From spectra to linear sRGB.
#pragma once

#include <glm/glm.hpp>

namespace lobe::shading {

/// CIE 1931 2 degree colour matching functions x, y, z of a wavelength in nm (fit of Wyman, Sloan and
/// Shirley, JCGT 2(2), 2013).
glm::dvec3 colourMatching(double wavelength);

/// CIE XYZ as linear sRGB of the same luminance (IEC 61966-2-1); channels may be negative.
glm::dvec3 linearSrgb(const glm::dvec3& xyz);

}  // namespace lobe::shading
