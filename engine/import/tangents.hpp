/// Tangents by the MikkTSpace algorithm (M. S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008),
/// which glTF asks for where a file has none, so that normal maps baked elsewhere fit.
#pragma once

#include <span>

#include "scene/scene.hpp"

namespace lobe {

/// Computes tangents from positions, normals and `uvs` (one a vertex); vertices split where tangents differ.
/// The handedness is glTF's: bitangent = cross(normal, tangent) * w points to lower v in the picture's rows.
void makeTangents(Primitive& primitive, std::span<const glm::vec2> uvs);

/// Makes all tangents unit, perpendicular to their normals, with w = 1 or -1. Those that are zero, not finite
/// or parallel to the normal are replaced by any that is perpendicular; returns how many.
size_t repairTangents(Primitive& primitive);

/// Any unit vector perpendicular to a unit one.
glm::vec3 anyPerpendicular(const glm::vec3& normal);

}  // namespace lobe
