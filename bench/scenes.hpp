/// Generated scenes for benchmarks; deterministic.
#pragma once

#include "scene/scene.hpp"

namespace lobe::bench {

/// One quad that fills the picture, one directional light: passes at their cheapest.
Scene flat();

/// 9 balls of 4 n^2 triangles each over a floor; no light.
Scene balls(int n);

/// A hall of about a million triangles: 100 materials of metallic_roughness and Blinn-Phong on columns and
/// statues (spheres), a floor and walls, 64 ranged point lights and 8 spots.
Scene hall();

/// A floor with `count` ranged point lights, each of which reaches about 1/40 of it.
Scene lightField(int count);

}  // namespace lobe::bench
