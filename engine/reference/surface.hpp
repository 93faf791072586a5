/// What a ray sees: surfaces with everything that shading needs of them, in double.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>

#include "scene/camera.hpp"
#include "scene/scene.hpp"

namespace lobe::reference {

/// Points origin + t direction for t in tMin..tMax; world, metres. The direction has any length but zero.
struct Ray {
    glm::dvec3 origin{0.0};
    glm::dvec3 direction{0.0, 0.0, -1.0};
    double tMin = 0.0;
    double tMax = std::numeric_limits<double>::infinity();
};

/// How a ray changes from pixel to pixel, from which textures take their footprint.
struct RayDifferentials {
    glm::dvec3 originDx{0.0}, originDy{0.0};
    glm::dvec3 directionDx{0.0}, directionDy{0.0};
};

/// The ray through a point of the picture, in pixels as View counts them: centres at .5, the bottom row
/// first. Its t is the distance along the view axis, from the near to the far plane.
Ray pixelRay(const View& view, double x, double y);
RayDifferentials pixelDifferentials(const View& view);

struct SurfacePoint {
    glm::dvec3 position{0.0};         ///< world, metres, on the triangle
    glm::dvec3 geometricNormal{0.0};  ///< world, unit, on the side that the ray came from
    /// World, as the engine's shaders build it: unit and at right angles; the bitangent is mirrored where the
    /// tangent's handedness says so.
    glm::dvec3 tangent{0.0}, bitangent{0.0}, normal{0.0};

    const Brdf* brdf = nullptr;  ///< null: unlit, emission is all there is
    /// Parameters with textures and vertex colours multiplied in. Valid as long as this and the tracer are.
    std::span<const double> values() const {
        return constantValues != nullptr ? std::span<const double>(*constantValues) : variedValues;
    }
    const ParameterValues* constantValues = nullptr;  ///< the material's, where nothing varies them
    ParameterValues variedValues;

    double alpha = 1.0;  ///< coverage in 0..1; 1 of opaque and masked surfaces
    AlphaMode alphaMode = AlphaMode::opaque;
    bool seenThrough = false;  ///< blended, or of a model that lets light through
    glm::dvec3 emission{0.0};  ///< radiance, W/(m^2 sr)
    double occlusion = 1.0;    ///< factor of ambient light; 1 where the scene has none
    int material = -1;         ///< index into Scene::materials
    uint32_t instance = 0;     ///< index into Scene::instances
    uint32_t triangle = 0;     ///< of that instance's primitive
    double t = 0.0;            ///< along the ray: of pixel rays the distance along the view axis
    double distance = 0.0;     ///< from the ray's origin, metres
};

}  // namespace lobe::reference
