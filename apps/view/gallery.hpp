/// The scenes that come with Lobe.
#pragma once

#include <string>
#include <vector>

namespace lobe::view {

/// Files, those directly in the folder first. Looked for in: $LOBE_SCENE_DIR; ../share/lobe/scenes beside the
/// running program; the source tree it was built from. Empty where there are none.
std::vector<std::string> galleryScenes();

/// "lights/rect": below the folder, without extension.
std::string galleryName(const std::string& file);

}  // namespace lobe::view
