/// Vertices that split when their corners need different values.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/scene.hpp"

namespace lobe {

/// Gives corners their own vertices: `keys` has a value a corner, and corners of one vertex with different
/// keys get different vertices (the first key keeps the vertex, others are appended). Returns for each vertex
/// one of its corners, or UINT32_MAX for vertices that no triangle uses.
std::vector<uint32_t> splitVertices(Primitive& primitive, std::span<const uint32_t> keys);

/// Gives each corner a vertex of its own.
void unshareVertices(Primitive& primitive);

}  // namespace lobe
