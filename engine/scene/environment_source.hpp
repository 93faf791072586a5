/// What an environment's picture is made of where a scene names no picture: a sky, or six faces of a cube.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace lobe {

enum class SkyModel : uint8_t { constant, gradient, preetham };

/// A sky as it is described (scene/sky.hpp). +Y is up; directions have their azimuth from +Z towards +X.
struct Sky {
    SkyModel model = SkyModel::preetham;
    glm::dvec3 zenith{1.0};           ///< W/(m^2 sr), constant (everywhere) and gradient
    glm::dvec3 horizon{1.0};          ///< W/(m^2 sr), gradient
    glm::dvec3 ground{0.2};           ///< W/(m^2 sr) of the nadir, gradient; reflectance, preetham
    double turbidity = 3.0;           ///< preetham, 1.7 to 10
    double sunElevation = 0.785;      ///< preetham, rad above the horizon, 0 to pi / 2
    double sunAzimuth = 0.0;          ///< preetham, rad
    double sunDiameter = 0.00930842;  ///< preetham, rad: 0 is a directional light, else a disk far away
};

/// EXT_lights_image_based.
struct ImageBasedLight {
    std::vector<int> faces;             ///< indices into Scene::images: +X -X +Y -Y +Z -Z, or none
    std::vector<glm::dvec3> harmonics;  ///< of irradiance, 9 as the extension orders them, or none
};

struct EnvironmentSource {
    std::optional<Sky> sky;
    std::optional<ImageBasedLight> imageBased;  ///< until it is made a picture
};

}  // namespace lobe
