#include "reference/surface.hpp"

namespace lobe::reference {

Ray pixelRay(const View& view, double x, double y) {
    const glm::dvec4& map = view.depthToZ;  // reversed: 1 is near, 0 is far
    Ray ray;
    ray.origin = view.eye + view.rayOrigin + x * view.rayOriginDx + y * view.rayOriginDy;
    ray.direction = view.rayDirection + x * view.rayDirectionDx + y * view.rayDirectionDy;
    ray.tMin = (map.x + map.y) / (map.z + map.w);
    if (map.z > 0.0) ray.tMax = map.x / map.z;
    return ray;
}

RayDifferentials pixelDifferentials(const View& view) {
    return {view.rayOriginDx, view.rayOriginDy, view.rayDirectionDx, view.rayDirectionDy};
}

}  // namespace lobe::reference
