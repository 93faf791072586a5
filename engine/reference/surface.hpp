/// What a ray finds of a surface: all that shading needs, in double.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "reference/texture_reader.hpp"
#include "scene/scene.hpp"

namespace lobe::reference {

/// World, metres; `direction` of any length: distances are in units of it. `dx`, `dy`: the rays of the next
/// pixels to the right and above, where there are such.
struct Ray {
    glm::dvec3 origin{0.0}, direction{0.0};
};
struct PixelRay : Ray {
    Ray dx, dy;
};

/// A triangle of an instance.
struct Facet {
    unsigned instance = 0, triangle = 0;
    bool operator==(const Facet&) const = default;
};

struct SurfacePoint {
    Facet facet;
    glm::dvec3 position{0.0};
    glm::dvec3 geometricNormal{0.0};  ///< unit, on the side that is seen
    double extent = 0.0;              ///< to the farthest corner of the facet, metres
    glm::dmat3 frame{1.0};            ///< tangent, bitangent, shading normal
    int material = -1;
    const Brdf* brdf = nullptr;  ///< null: unlit, all is emission
    ParameterValues values;
    glm::dvec3 emission{0.0};
    double alpha = 1.0;  ///< coverage; 1 of opaque and masked surfaces
    double occlusion = 1.0;
};

/// Reads a scene's surfaces as the engine's shaders define them (docs/scenes.md), from the formulas.
class Surfaces {
public:
    explicit Surfaces(const Scene& scene);

    /// Where `ray` meets the plane of a facet: its distance in units of the ray's direction.
    double distanceTo(const Facet& facet, const Ray& ray) const;

    /// Whether the side that glTF calls the front is seen along `direction`.
    bool frontSeen(const Facet& facet, const glm::dvec3& direction) const;

    /// Coverage where a ray meets a facet, 0 to 1: of masked surfaces 0 or 1.
    double coverage(const Facet& facet, const PixelRay& ray) const;
    /// The same for a ray without neighbours: textures at their finest.
    double coverage(const Facet& facet, const Ray& ray) const;

    SurfacePoint at(const Facet& facet, const PixelRay& ray) const;

    AlphaMode alphaMode(unsigned instance) const;
    bool doubleSided(unsigned instance) const;

private:
    const Primitive& primitiveOf(unsigned instance) const;
    const Material& materialOf(unsigned instance) const;
    std::array<glm::dvec3, 3> corners(const Facet& facet) const;
    std::array<uint32_t, 3> indices(const Facet& facet) const;
    /// Barycentric coordinates of the point where a ray meets the facet's plane.
    glm::dvec3 weightsAt(const Facet& facet, const Ray& ray) const;
    UvFootprint footprint(const Facet& facet, int set, const glm::dvec3& weights, const glm::dvec3& dx,
                          const glm::dvec3& dy, bool known) const;
    double alphaAt(const Facet& facet, const glm::dvec3& weights, const glm::dvec3& dx, const glm::dvec3& dy,
                   bool known) const;
    void shade(SurfacePoint& point, const glm::dvec3& weights, const glm::dvec3& dx, const glm::dvec3& dy,
               bool front) const;

    const Scene& scene_;
    TextureReader textures_;
    std::vector<glm::dmat3> normalFromLocal_;  ///< inverse transpose up to a positive factor, by instance
    std::vector<bool> mirrored_;
};

}  // namespace lobe::reference
