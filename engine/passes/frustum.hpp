/// Which bounds a view can see.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/camera.hpp"

namespace lobe {

/// Planes of the view frustum in relative space, positive inside; reversed depth has no far plane when
/// infinite.
std::vector<glm::dvec4> frustumPlanes(const View& view);

struct BoundingSphere {
    glm::dvec3 center{0.0};  ///< relative to the eye
    double radius = 0.0;
};

/// A sphere in a node's own space, as large as any stretching of the node makes it.
BoundingSphere movedSphere(const glm::dmat4& worldFromLocal, const glm::dvec3& center, double radius,
                           const glm::dvec3& eye);

bool inView(const std::vector<glm::dvec4>& planes, const BoundingSphere& bound);

}  // namespace lobe
