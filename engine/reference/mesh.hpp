/// The triangles of one instance, where it stands, and their exact intersection with rays.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "reference/surface.hpp"

namespace lobe::reference {

/// Where a ray meets a triangle.
struct Hit {
    uint32_t instance = 0;
    uint32_t triangle = 0;
    double t = 0.0;
    glm::dvec3 weights{0.0};  ///< barycentric, of the triangle's vertices
    bool front = true;        ///< the side that is seen
};

/// Change of the barycentric weights from pixel to pixel.
struct Footprint {
    glm::dvec3 dx{0.0}, dy{0.0};
};

/// Vertices relative to the eye, so that they keep their digits.
class Mesh {
public:
    Mesh(const Instance& instance, const Primitive& primitive, const glm::dvec3& eye);

    uint32_t triangles() const { return static_cast<uint32_t>(primitive_->triangleCount()); }
    const Primitive& primitive() const { return *primitive_; }
    /// Indices of a triangle's vertices.
    std::array<size_t, 3> corners(uint32_t triangle) const;
    const glm::dvec3& position(size_t vertex) const { return positions_[vertex]; }
    /// Bounds the sizes that vertices are sums of: their rounding is a few 2^-53 of it.
    double magnitude() const { return magnitude_; }

    /// World, unit or zero, as vertex shaders get them.
    glm::dvec3 vertexNormal(size_t vertex) const;
    glm::dvec4 vertexTangent(size_t vertex) const;
    /// Unit, on the front side; zero without area.
    glm::dvec3 facetNormal(uint32_t triangle) const;

    /// Where the line origin + t direction, relative to the eye, passes through the triangle; t of any sign.
    /// Lines through an edge or a vertex that triangles share pass through one of those that surround it.
    std::optional<Hit> intersect(uint32_t triangle, const glm::dvec3& origin,
                                 const glm::dvec3& direction) const;
    /// How the weights of that intersection change with the ray.
    Footprint footprint(uint32_t triangle, const glm::dvec3& origin, const glm::dvec3& direction,
                        const RayDifferentials& change) const;

private:
    const Primitive* primitive_;
    std::vector<glm::dvec3> positions_;
    glm::dmat3 worldFromLocal_;
    glm::dmat3 normalFromLocal_;
    bool mirrored_;
    double magnitude_ = 0.0;
};

}  // namespace lobe::reference
