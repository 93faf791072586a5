/// The sun in a picture of an environment: kept in it, or taken out as a light.
#pragma once

#include "scene/scene.hpp"
#include "settings.hpp"

namespace lobe::app {

/// What of `env_sun` and `sun_size` can change the environment that the other settings give, by name.
nlohmann::json sunChanges(const Scene& scene, const Settings& settings);

/// Takes the sun out of the scene's picture of its environment, or says in Environment::notes why it stays.
/// The picture with it is still what is seen behind surfaces.
void applySun(Scene& scene, const Settings& settings);

/// The settings for a truth: that of a picture has its sun in it, unless it is asked to be taken out.
Settings settingsOfTruth(Settings settings);

}  // namespace lobe::app
