/// A scene's triangles in a hierarchy of boxes, flattened for rays in shaders
/// (shaders/glsl/shadow/rays.glsl).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.hpp"

namespace lobe {

/// How the hierarchy is built; the defaults are what is fastest on llvmpipe (docs/shadows.md).
struct RayHierarchyOptions {
    int pairsPerLeaf = 4;        ///< at most
    float traversalCost = 1.0f;  ///< of a node, in tests of a pair
};

/// Coordinates are (world - center) * scale, within -1..1: neither squares of tiny scenes nor of huge ones
/// leave the range of float.
struct RayHierarchy {
    /// Texels of four: lower corner (as bits of floats), link; upper corner, count.
    std::vector<uint32_t> nodes;
    /// Texels of four: pairs of triangles.
    std::vector<float> triangles;
    /// Alpha of the textures' finest levels, 0..1 (floats beyond it as they are).
    std::vector<float> texels;
    int opaqueNodes = 0;  ///< nodes of opaque surfaces, which come first
    int allNodes = 0;
    glm::dvec3 center{0.0};
    double scale = 1.0;  ///< a power of two, 1/m
    /// How far a point of a surface, as drawn in float, may be off the same surface here, m; but for what
    /// grows with the distance from the eye.
    double error = 0.0;

    size_t bytes() const {
        return nodes.size() * sizeof(uint32_t) + (triangles.size() + texels.size()) * sizeof(float);
    }
};

/// The surfaces that cast shadows. Throws InputError if there is not enough memory.
RayHierarchy buildRayHierarchy(const Scene& scene, const RayHierarchyOptions& options = {});

}  // namespace lobe
