/// Cameras, placed in the world.
#pragma once

#include <vector>

#include "import/nodes.hpp"
#include "scene/scene.hpp"

namespace lobe {

/// One camera a node that the scene shows. Scale is taken out, with a warning.
std::vector<Camera> readCameras(Document& document, const NodeTree& tree, const WorldPose& world);

}  // namespace lobe
