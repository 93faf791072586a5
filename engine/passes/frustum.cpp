#include "passes/frustum.hpp"

#include <algorithm>
#include <cmath>

namespace lobe {

std::vector<glm::dvec4> frustumPlanes(const View& view) {
    const glm::dmat4 rows = glm::transpose(view.clipFromRelative);
    std::vector<glm::dvec4> planes = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                                      rows[3] - rows[1], rows[3] - rows[2], rows[2]};
    for (glm::dvec4& plane : planes) {
        const double length = glm::length(glm::dvec3(plane));
        plane = length > 0.0 ? plane / length : glm::dvec4(0, 0, 0, 1);
    }
    return planes;
}

BoundingSphere movedSphere(const glm::dmat4& m, const glm::dvec3& center, double radius,
                           const glm::dvec3& eye) {
    // The Frobenius norm bounds how much any direction is stretched.
    const double stretch = std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
    return {glm::dvec3(m * glm::dvec4(center, 1.0)) - eye, radius * stretch};
}

bool inView(const std::vector<glm::dvec4>& planes, const BoundingSphere& bound) {
    return std::all_of(planes.begin(), planes.end(), [&](const glm::dvec4& plane) {
        return glm::dot(glm::dvec3(plane), bound.center) + plane.w >= -bound.radius;
    });
}

}  // namespace lobe
