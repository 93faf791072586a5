/// Skies of the command line.
#pragma once

#include "scene/scene.hpp"
#include "settings.hpp"

namespace lobe::app {

/// The settings of skies and suns that are set, by name. Throws UsageError where there is no sky that they
/// could change, and where sky and env are both set.
nlohmann::json skyChanges(const Scene& scene, const Settings& settings);

/// The environment as these settings make it: of a new sky, or of the scene's own with other values. Nothing
/// where none is set.
void applySky(Scene& scene, const Settings& settings);

}  // namespace lobe::app
