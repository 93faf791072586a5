/// The environment as the settings change it: another picture, turned, brighter, blurred behind surfaces or
/// not seen.
#pragma once

#include "scene/scene.hpp"
#include "settings.hpp"

namespace lobe::app {

/// The settings that change it, by name; empty: none, as where there is no environment.
nlohmann::json environmentChanges(const Scene& scene, const Settings& settings);

/// Whether there will be one.
bool hasEnvironment(const Scene& scene, const Settings& settings);

/// Turns it and makes it brighter, as the settings say.
void turnEnvironment(Environment& environment, const Settings& settings);

/// Changes the scene, its content's hash included. Throws InputError for a picture that cannot be read.
void applyEnvironment(Scene& scene, const Settings& settings);

}  // namespace lobe::app
