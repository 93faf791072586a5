/// Lights, placed in the world.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "import/nodes.hpp"
#include "scene/scene.hpp"

namespace lobe {

/// The picture that a rect shows (LOBE_light_image), not yet read.
struct NamedImage {
    std::string uri;
    std::string property;  ///< where the scene names it
};

struct PlacedLight {
    Light light;                      ///< without image
    bool visible = false;             ///< its body is to be drawn (LOBE_visible_light)
    std::optional<NamedImage> image;  ///< of Light::image
};

/// One light a node that the scene shows: KHR_lights_punctual, points with a body by LOBE_light_shape, and
/// EXT_lights_area. Node scale counts for the size of the last only, as that extension says.
std::vector<PlacedLight> readLights(const Document& document, const NodeTree& tree, const WorldPose& world);

}  // namespace lobe
