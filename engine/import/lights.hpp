/// Lights, placed in the world.
#pragma once

#include <vector>

#include "import/nodes.hpp"
#include "scene/scene.hpp"

namespace lobe {

/// One light a node that the scene shows: KHR_lights_punctual, points with a body by LOBE_light_shape, and
/// EXT_lights_area. Node scale counts for the size of the last only, as that extension says.
std::vector<Light> readLights(const Document& document, const NodeTree& tree, const WorldPose& world);

}  // namespace lobe
