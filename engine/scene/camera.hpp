/// Cameras: framing, orbits, and what a pixel sees.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>

#include "scene/scene.hpp"

namespace lobe {

/// What a framing camera must hold: the box as seen from its side, or the sphere about it, which also fits
/// when the camera orbits.
enum class Fit : uint8_t { box, sphere };

/// The documented camera of a scene without one: perspective, 45 degrees high, at azimuth 25 and elevation 15
/// degrees (0, 0 looks along -Z at the front), at the distance where the bounds just fit, with a margin of 5
/// %.
struct Framing {
    double azimuthDeg = 25.0;
    double elevationDeg = 15.0;
    double verticalFov = 0.7853981633974483;  ///< radians
    Fit fit = Fit::box;
};
Camera framingCamera(const Bounds& bounds, double aspect, const Framing& framing = {});

/// A camera at `position` that looks at `focalPoint`, +Y up (or -Z up when it looks along Y).
Camera lookAt(const glm::dvec3& position, const glm::dvec3& focalPoint, double verticalFov);

/// `camera` turned about the vertical axis through `pivot`.
Camera orbited(const Camera& camera, const glm::dvec3& pivot, double azimuthDeg);

/// Near and far planes that hold the bounds as seen from the camera, kept when the file gave them.
void fitDepthRange(Camera& camera, const Bounds& bounds);

/// A scene's camera by name or index ("2"), exact name first. Throws UsageError that lists what there is.
const Camera& findCamera(const Scene& scene, const std::string& nameOrIndex);

/// All that the passes need, in camera-relative world space: world axes, origin at the eye, so that float
/// coordinates stay small however far from the world's origin the camera is.
struct View {
    glm::dvec3 eye;  ///< world
    glm::dmat4
        clipFromRelative;  ///< reversed depth in 0..1: 1 at the near plane, 0 at the far plane or infinity
    /// Depth d to distance z along the view axis: z = (a + b d) / (c + e d).
    glm::dvec4 depthToZ;
    /// Ray of pixel (x, y) (pixel units, centre of the first = 0.5, row 0 at the bottom as GL counts):
    /// point(z) = origin + z direction, affine in x and y; direction has length 1 along the view axis.
    glm::dvec3 rayOrigin, rayOriginDx, rayOriginDy;
    glm::dvec3 rayDirection, rayDirectionDx, rayDirectionDy;
    glm::dvec3 forward;
    bool orthographic;
    int width, height;
};

/// `jitter` in pixels (0, 0 = pixel centres) moves the sample position within the pixel.
View makeView(const Camera& camera, int width, int height, glm::dvec2 jitter = glm::dvec2(0.0));

}  // namespace lobe
