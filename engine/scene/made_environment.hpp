/// Environments that no picture is given for: from a sky or the faces of a cube; and their suns, which are
/// lights of the scene.
#pragma once

#include "scene/scene.hpp"

namespace lobe {

/// Angular diameter of the sun seen from the earth, rad: 0.5334 degrees.
inline constexpr double kSunDiameter = 0.00930842;

/// A light as far away as directions and irradiance are the same all over the scene to 1e-4: directional, or
/// for a `diameter` (rad) above 0 a disk of it, which mirrors show and whose shadows have penumbras.
/// `irradiance`: on a facing surface, W/m^2; `toSun`: unit.
Light sunLight(const glm::dvec3& toSun, const glm::dvec3& irradiance, double diameter, const Bounds& bounds);

/// Makes the picture that Environment::source describes, with its sun among the lights and, where the
/// environment is seen, a picture with the sun's disc for behind surfaces. Nothing where it describes none.
void makeEnvironment(Scene& scene);

/// Makes `light` the environment's sun.
void addSun(Scene& scene, Light light);

/// Takes the environment away, with its sun.
void removeEnvironment(Scene& scene);

/// Turns the environment about +Y, with its sun; rad, counter-clockwise seen from above.
void turnEnvironment(Scene& scene, double angle);

/// Multiplies its radiance, and its sun's.
void scaleEnvironment(Scene& scene, double factor);

/// Adds a picture to the scene; its index.
int addPicture(Scene& scene, Bitmap bitmap, const std::string& name);

}  // namespace lobe
