/// Lights with a body that are to be seen: surfaces that show their radiance.
#pragma once

#include "scene/scene.hpp"

namespace lobe {

/// Adds a surface of the light's shape and radiance, which takes no light and casts no shadow, to the scene.
/// A rect or disk is seen from the side that emits. The light must have a body; `texture`: index into
/// Scene::textures of the image on it, if it has one.
void addBody(Scene& scene, const Light& light, int texture);

}  // namespace lobe
