/// The parts of glTF 2.0 and its extensions that Lobe reads, as a schema.
#pragma once

#include "import/json_schema.hpp"

namespace lobe {

const ObjectSchema& gltfSchema();

/// KHR_lights_punctual's root object: its lights are indexed by nodes, which gltfSchema() can't check.
inline constexpr const char* kLightsExtension = "KHR_lights_punctual";
/// The same for EXT_lights_area.
inline constexpr const char* kAreaLightsExtension = "EXT_lights_area";
inline constexpr const char* kImageBasedExtension = "EXT_lights_image_based";
inline constexpr const char* kLightShapeExtension = "LOBE_light_shape";
/// On a rect of EXT_lights_area: the picture that it shows.
inline constexpr const char* kLightImageExtension = "LOBE_light_image";
/// On a node: whether its light and its mesh cast shadows.
inline constexpr const char* kShadowExtension = "LOBE_shadow";
/// On a node: whether its light, which has a body, is seen.
inline constexpr const char* kVisibleLightExtension = "LOBE_visible_light";

}  // namespace lobe
