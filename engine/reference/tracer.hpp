/// Rays against a scene's triangles: Embree finds candidates in float, every test is made in double.
#pragma once

#include <memory>
#include <vector>

#include "reference/surface.hpp"

namespace lobe::reference {

/// Unchanged after construction: any number of threads may trace at once.
class Tracer {
public:
    /// Keeps the scene. `eye` is where floats have their digits: the camera's place. Throws InputError where
    /// the scene does not fit into floats as seen from there, or into memory.
    Tracer(std::shared_ptr<const Scene> scene, const glm::dvec3& eye);
    ~Tracer();
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;

    /// Replaces `layers` by the surfaces along the ray, front to back, down to the first that is not seen
    /// through. Masks cut holes; back faces of one-sided materials are not seen. Without differentials
    /// textures are read at their finest level. Surfaces at one place come in the order of the scene.
    void surfacesAlong(const Ray& ray, const RayDifferentials* differentials,
                       std::vector<SurfacePoint>& layers) const;

    /// Product of 1 - alpha of what lies on the way from a surface in a direction (world, any length but
    /// zero), up to tMax times the direction (infinity allowed): 1 = visible, 0 = blocked. Both sides of
    /// surfaces block, also of the one it starts on: light from behind the triangle has to pass it. Textures
    /// are read at their finest level.
    double visibility(const SurfacePoint& from, const glm::dvec3& direction, double tMax) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lobe::reference
