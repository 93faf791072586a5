/// Triangles that share an edge, two by two: a pair has four vertices, and a ray tests it for little more
/// than one.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/scene.hpp"

namespace lobe {

/// Vertices a, b, c, d of the triangles (a, b, c) and (d, c, b); d = c where there is one triangle only.
using TrianglePair = std::array<uint32_t, 4>;

/// Every triangle of the primitive in one pair, with the neighbour that makes the smallest box; alone where
/// both boxes are smaller than the one about the two, by area.
std::vector<TrianglePair> pairTriangles(const Primitive& primitive);

}  // namespace lobe
