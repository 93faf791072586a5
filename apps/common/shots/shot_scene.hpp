/// From a loaded scene and a shot's settings to what is drawn: model override, default light, camera.
#pragma once

#include <memory>

#include "passes/renderer.hpp"
#include "settings.hpp"
#include "shots.hpp"

namespace lobe::app {

/// What of the settings changes the scene, by name: two shots with equal changes share the changed scene.
/// Empty: none.
nlohmann::json changesOf(const Scene& scene, const Settings& settings);

/// The scene as the settings change it. `base` is returned itself if they do not.
std::shared_ptr<const Scene> preparedScene(const std::shared_ptr<const Scene>& base,
                                           const Settings& settings);

/// Throws UsageError for settings that place the camera in more than one way, or half.
void requireOneCamera(const Settings& settings);

/// The camera of one frame. Throws UsageError (no such camera, contradictory settings).
Camera cameraOf(const Scene& scene, const Settings& settings, int frame);

RenderOptions renderOptionsOf(const Settings& settings);

/// Whether the true picture has shadows: unless they are asked away by name. Presets of quality leave the
/// truth as it is.
bool truthHasShadows(const Settings& settings);

}  // namespace lobe::app
