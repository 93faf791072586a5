/// What lies under a pixel.
#pragma once

#include <memory>
#include <optional>

#include "scene/camera.hpp"
#include "scene/scene.hpp"

namespace lobe::view {

struct Picked {
    int material = -1, instance = -1;  ///< indices into the scene
    glm::dvec3 position{0.0};          ///< world, metres
    glm::dvec3 normal{0.0};            ///< world, unit
    double distance = 0.0;             ///< from the eye, metres
};

/// The nearest surface under pixel (x, y), row 0 at the top; nothing where there is none. Throws InputError
/// for scenes too far away for floats.
std::optional<Picked> pick(const std::shared_ptr<const Scene>& scene, const Camera& camera, int width,
                           int height, double x, double y);

}  // namespace lobe::view
