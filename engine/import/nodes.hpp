/// The node tree: its shape, the pose of each node, and where that puts it in the world.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <vector>

#include "import/document.hpp"

namespace lobe {

/// A node's transform relative to its parent. A node has either these three or a matrix.
struct NodePose {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit
    glm::dvec3 scale{1.0};
    std::optional<glm::dmat4> matrix;  ///< affine
    std::vector<double> weights;       ///< of morph targets; empty: the mesh's own
};

struct NodeTree {
    std::vector<int> parents;  ///< -1: a root
    std::vector<int> order;    ///< all nodes, parents first
    std::vector<int> drawn;    ///< those that the scene shows, parents first
};

struct WorldPose {
    std::vector<glm::dmat4> transforms;  ///< world from node, affine, finite
    std::vector<glm::dquat> rotations;   ///< the same without any scale, for lights and cameras
};

/// Refuses nodes with two parents and cycles.
NodeTree readNodeTree(const Document& document);

/// The index of the scene that is shown, or nothing if the file has none: then all root nodes are.
std::optional<size_t> shownScene(const Document& document);

std::vector<NodePose> readRestPose(Document& document);

/// Whether a node's light and mesh cast shadows (LOBE_shadow).
bool castsShadow(const Document& document, size_t node);

/// Throws InputError where transforms multiply up to infinity.
WorldPose worldPose(const Document& document, const NodeTree& tree, const std::vector<NodePose>& pose);

}  // namespace lobe
