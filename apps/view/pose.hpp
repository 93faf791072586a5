/// Where the person looks from, as settings say it.
#pragma once

#include <glm/glm.hpp>

namespace lobe::view {

struct Pose {
    glm::dvec3 position{0.0, 0.0, 1.0};  ///< world, metres
    glm::dvec3 focal{0.0};               ///< what is looked at, and turned about
    double viewAngle = 45.0;             ///< vertical, degrees

    bool operator==(const Pose&) const = default;
};

}  // namespace lobe::view
