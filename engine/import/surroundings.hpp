/// What surrounds a scene: ambient light, environment, fog.
#pragma once

#include "import/textures.hpp"
#include "scene/scene.hpp"

namespace lobe {

/// LOBE_ambient, LOBE_environment and LOBE_fog of the scene that is shown. The environment's picture is added
/// to `images`. Throws InputError.
void readSurroundings(Document& document, TextureTable& images, Scene& scene);

}  // namespace lobe
