/// EXT_lights_image_based as a picture.
#pragma once

#include <span>

#include "scene/scene.hpp"

namespace lobe {

/// A face as the extension stores it, of radiance in 32-bit floats: with four channels RGBD, the sRGB colour
/// over alpha (0 where that is 0), else plain; and turned about its vertical axis, as OpenGL's cube maps have
/// it.
Bitmap unpackedFace(const Bitmap& face);

/// Irradiance on a unit normal of 9 coefficients for orthonormal harmonics without the Condon-Shortley phase,
/// in the order of Ramamoorthi and Hanrahan, SIGGRAPH 2001.
glm::dvec3 irradianceOf(std::span<const glm::dvec3> harmonics, const glm::dvec3& normal);

/// The least bent radiance that has that irradiance, at least 0, as an equirectangular picture.
Bitmap pictureOf(std::span<const glm::dvec3> harmonics);

/// Makes EnvironmentSource::imageBased of the scene's environment its picture: of its faces, which leave the
/// scene (they are its last images), or, where it has none, of its harmonics. Throws InputError.
void makeImageBased(Scene& scene);

}  // namespace lobe
