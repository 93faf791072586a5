/// Rays through a scene, by Embree: which surfaces a pixel sees, and what a point sees of a light.
#pragma once

#include <memory>
#include <vector>

#include "reference/surface.hpp"

namespace lobe::reference {

/// Embree works in float: the triangles are stored relative to the eye, so that they are as exact there as
/// the renderer's own, and each hit is computed again in double. One for any number of threads.
class Tracer {
public:
    /// The scene must outlive the tracer. Throws Error if Embree fails (memory).
    Tracer(const Scene& scene, const glm::dvec3& eye);
    ~Tracer();
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;

    /// Surfaces along a ray, front to back, until the first that covers all: back faces of single-sided
    /// surfaces and what masks cut out are not there, as in the renderer. `near` and `far`: distances in
    /// units of the ray's direction.
    std::vector<SurfacePoint> surfacesAlong(const PixelRay& ray, double near, double far) const;

    /// Transmittance from a surface in a unit direction over `distance` metres (or infinity): 0 where an
    /// opaque surface, of whatever side, or the surface's own back is in the way; times 1 - coverage of
    /// blended ones. The ray starts off the surface by a bound of the rounding of its place
    /// (docs/reference.md).
    double visibility(const SurfacePoint& from, const glm::dvec3& direction, double distance) const;

    const Surfaces& surfaces() const { return surfaces_; }

private:
    struct Device;
    Surfaces surfaces_;
    glm::dvec3 eye_;
    std::unique_ptr<Device> device_;
};

}  // namespace lobe::reference
