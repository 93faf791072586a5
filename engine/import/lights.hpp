/// Lights, placed in the world.
#pragma once

#include <vector>

#include "import/nodes.hpp"
#include "scene/scene.hpp"

namespace lobe {

struct PlacedLight {
    Light light;
    bool visible = false;  ///< its body is to be drawn (LOBE_visible_light)
};

/// One light a node that the scene shows: KHR_lights_punctual, points with a body by LOBE_light_shape, and
/// EXT_lights_area. Node scale counts for the size of the last only, as that extension says.
std::vector<PlacedLight> readLights(const Document& document, const NodeTree& tree, const WorldPose& world);

}  // namespace lobe
