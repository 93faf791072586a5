#include "reference/mesh.hpp"

#include <algorithm>
#include <cmath>

namespace lobe::reference {
namespace {

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// v / |v|, or zero; the largest component is divided out first, as squares of tiny lengths flush to zero.
glm::dvec3 unitOrZero(const glm::dvec3& v) {
    const double m = largest(v);
    return m > 0.0 ? glm::normalize(v / m) : glm::dvec3(0.0);
}

/// Sign of dot(direction, m); where that is zero, its sign once the direction is turned by (e, e^2, e^3) with
/// e too small to count: the same for all triangles, so that exactly one of those around an edge is met.
double signedVolume(const glm::dvec3& direction, const glm::dvec3& m, int& sign) {
    const double volume = glm::dot(direction, m);
    double first = volume;
    for (int i = 0; first == 0.0 && i < 3; ++i)
        first = m[i];
    sign = (first > 0.0) - (first < 0.0);
    return volume;
}

}  // namespace

Mesh::Mesh(const Instance& instance, const Primitive& primitive, const glm::dvec3& eye)
    : primitive_(&primitive), worldFromLocal_(instance.worldFromLocal) {
    const glm::dmat3& m = worldFromLocal_;
    // Inverse transpose up to a positive factor, also of matrices without inverse.
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    mirrored_ = glm::dot(m[0], cofactors[0]) < 0.0;
    normalFromLocal_ = mirrored_ ? -cofactors : cofactors;

    const glm::dvec3 place = glm::dvec3(instance.worldFromLocal[3]) - eye;
    const glm::dvec3 placeSize = glm::abs(glm::dvec3(instance.worldFromLocal[3])) + glm::abs(eye);
    const glm::dmat3 sizes(glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2]));
    positions_.reserve(primitive.positions.size());
    for (const glm::vec3& local : primitive.positions) {
        positions_.push_back(m * glm::dvec3(local) + place);
        magnitude_ = std::max(magnitude_, largest(sizes * glm::abs(glm::dvec3(local)) + placeSize));
    }
}

std::array<size_t, 3> Mesh::corners(uint32_t triangle) const {
    const uint32_t* first = primitive_->indices.data() + size_t{3} * triangle;
    return {first[0], first[1], first[2]};
}

glm::dvec3 Mesh::vertexNormal(size_t vertex) const {
    return unitOrZero(normalFromLocal_ * glm::dvec3(primitive_->normals[vertex]));
}

glm::dvec4 Mesh::vertexTangent(size_t vertex) const {
    if (primitive_->tangents.empty()) return {0.0, 0.0, 0.0, 1.0};
    const glm::dvec4 local(primitive_->tangents[vertex]);
    return glm::dvec4(unitOrZero(worldFromLocal_ * glm::dvec3(local)), local.w);
}

glm::dvec3 Mesh::facetNormal(uint32_t triangle) const {
    const auto [a, b, c] = corners(triangle);
    const glm::dvec3 normal = unitOrZero(
        glm::cross(unitOrZero(positions_[b] - positions_[a]), unitOrZero(positions_[c] - positions_[a])));
    return mirrored_ ? -normal : normal;
}

std::optional<Hit> Mesh::intersect(uint32_t triangle, const glm::dvec3& origin,
                                   const glm::dvec3& direction) const {
    const auto [ia, ib, ic] = corners(triangle);
    const glm::dvec3 a = positions_[ia] - origin;
    const glm::dvec3 b = positions_[ib] - origin;
    const glm::dvec3 c = positions_[ic] - origin;
    // Each is exactly the negative of the neighbour's across the same edge, whatever the rounding.
    int signA, signB, signC;
    const double u = signedVolume(direction, glm::cross(b, c), signA);
    const double v = signedVolume(direction, glm::cross(c, a), signB);
    if (signA != signB) return {};
    const double w = signedVolume(direction, glm::cross(a, b), signC);
    if (signA != signC) return {};
    const double volume = u + v + w;
    if (volume == 0.0) return {};  // seen from its edge
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double slope = glm::dot(normal, direction);
    if (slope == 0.0) return {};

    Hit hit;
    hit.triangle = triangle;
    hit.weights = glm::dvec3(u, v, w) / volume;
    hit.t = glm::dot(normal, a) / slope;
    hit.front = (slope < 0.0) != mirrored_;
    if (!std::isfinite(hit.t)) return {};
    return hit;
}

Footprint Mesh::footprint(uint32_t triangle, const glm::dvec3& origin, const glm::dvec3& direction,
                          const RayDifferentials& change) const {
    const auto [ia, ib, ic] = corners(triangle);
    const glm::dvec3 a = positions_[ia] - origin;
    const glm::dvec3 b = positions_[ib] - origin;
    const glm::dvec3 c = positions_[ic] - origin;
    const auto volumes = [](const glm::dvec3& d, const glm::dvec3& p, const glm::dvec3& q,
                            const glm::dvec3& r) {
        return glm::dvec3(glm::dot(d, glm::cross(q, r)), glm::dot(d, glm::cross(r, p)),
                          glm::dot(d, glm::cross(p, q)));
    };
    const glm::dvec3 volume = volumes(direction, a, b, c);
    const double total = volume.x + volume.y + volume.z;
    const glm::dvec3 weights = volume / total;
    // Weights are the volumes over their sum; moving the origin by o moves each edge's normal by o x (p - q).
    const auto derivative = [&](const glm::dvec3& originChange, const glm::dvec3& directionChange) {
        glm::dvec3 d = volumes(directionChange, a, b, c);
        d.x += glm::dot(direction, glm::cross(originChange, b - c));
        d.y += glm::dot(direction, glm::cross(originChange, c - a));
        d.z += glm::dot(direction, glm::cross(originChange, a - b));
        return (d - weights * (d.x + d.y + d.z)) / total;
    };
    return {derivative(change.originDx, change.directionDx), derivative(change.originDy, change.directionDy)};
}

}  // namespace lobe::reference
