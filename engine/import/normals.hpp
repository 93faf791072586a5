/// Normals where a file has none, or broken ones.
#pragma once

#include "scene/scene.hpp"

namespace lobe {

/// Gives each triangle its own vertices with the facet's normal.
void makeFlatNormals(Primitive& primitive);

/// Averages the normals of facets around each corner, weighted by the angle there. Facets that meet at an
/// edge by more than 60 degrees are kept apart; vertices split where that happens. Vertices at the same place
/// count as one.
void makeSmoothNormals(Primitive& primitive);

/// Makes all normals unit. Those that are zero or not finite take the average of the facets around them;
/// returns how many.
size_t repairNormals(Primitive& primitive);

}  // namespace lobe
