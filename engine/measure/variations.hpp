/// Scenes that look the same with more of something in them: what run time grows with.
#pragma once

#include "scene/scene.hpp"

namespace lobe::measure {

/// Each light `copies` times, each with its share of the intensity.
Scene withLightCopies(const Scene& scene, int copies);

/// Each triangle split into four at the middles of its edges, `levels` times: 4^levels as many. Normals and
/// tangents between are normalised means, which are those that interpolation gives.
Scene withFinerTriangles(const Scene& scene, int levels);

/// Each primitive cut into up to `parts` runs of its triangles, each with a material of its own.
Scene withMaterialParts(const Scene& scene, int parts);

}  // namespace lobe::measure
