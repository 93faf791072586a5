#include "import/normals.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "import/vertices.hpp"
#include "import/welding.hpp"

namespace lobe {

namespace {

constexpr double kCreaseCosine = 0.5;        // of 60 degrees
const glm::dvec3 kAnyNormal(0.0, 0.0, 1.0);  // of what has no area

glm::dvec3 cornerPosition(const Primitive& primitive, size_t corner) {
    return {primitive.positions[primitive.indices[corner]]};
}

glm::dvec3 unitOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? v / length : otherwise;
}

/// Unit, or zero for a facet without area.
glm::dvec3 facetNormal(const Primitive& primitive, size_t triangle) {
    const glm::dvec3 a = cornerPosition(primitive, 3 * triangle);
    const glm::dvec3 b = cornerPosition(primitive, 3 * triangle + 1);
    const glm::dvec3 c = cornerPosition(primitive, 3 * triangle + 2);
    return unitOr(glm::cross(b - a, c - a), glm::dvec3(0.0));
}

/// The triangle's angle at a corner, in radians.
double cornerAngle(const Primitive& primitive, size_t corner) {
    const size_t first = corner / 3 * 3;
    const glm::dvec3 p = cornerPosition(primitive, corner);
    const glm::dvec3 a = cornerPosition(primitive, first + (corner + 1) % 3) - p;
    const glm::dvec3 b = cornerPosition(primitive, first + (corner + 2) % 3) - p;
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

std::vector<glm::dvec3> facetNormals(const Primitive& primitive) {
    std::vector<glm::dvec3> normals(primitive.triangleCount());
    for (size_t t = 0; t < normals.size(); ++t) {
        normals[t] = facetNormal(primitive, t);
    }
    return normals;
}

/// Sets of corners, joined pair by pair.
class Groups {
public:
    explicit Groups(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
    uint32_t find(uint32_t corner) {
        while (parent_[corner] != corner) {
            parent_[corner] = parent_[parent_[corner]];
            corner = parent_[corner];
        }
        return corner;
    }
    void join(uint32_t a, uint32_t b) {
        const uint32_t rootA = find(a);
        const uint32_t rootB = find(b);
        parent_[std::max(rootA, rootB)] = std::min(rootA, rootB);
    }

private:
    std::vector<uint32_t> parent_;
};

/// A triangle's side between places (welded vertices) low and high, with its corners there.
struct Side {
    uint64_t places;  ///< low << 32 | high
    uint32_t lowCorner;
    uint32_t highCorner;
};

std::vector<Side> sortedSides(const Primitive& primitive, const std::vector<uint32_t>& places) {
    std::vector<Side> sides;
    sides.reserve(primitive.indices.size());
    for (uint32_t corner = 0; corner < primitive.indices.size(); ++corner) {
        const uint32_t other = corner / 3 * 3 + (corner + 1) % 3;
        const uint32_t here = places[primitive.indices[corner]];
        const uint32_t there = places[primitive.indices[other]];
        if (here < there) {
            sides.push_back({uint64_t{here} << 32 | there, corner, other});
        } else if (there < here) {
            sides.push_back({uint64_t{there} << 32 | here, other, corner});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return a.places != b.places ? a.places < b.places : a.lowCorner < b.lowCorner;
    });
    return sides;
}

}  // namespace

void makeFlatNormals(Primitive& primitive) {
    const std::vector<glm::dvec3> facets = facetNormals(primitive);
    primitive.normals.clear();
    unshareVertices(primitive);
    primitive.normals.resize(primitive.positions.size());
    for (size_t corner = 0; corner < primitive.normals.size(); ++corner) {
        primitive.normals[corner] = glm::vec3(unitOr(facets[corner / 3], kAnyNormal));
    }
}

void makeSmoothNormals(Primitive& primitive) {
    const std::vector<glm::dvec3> facets = facetNormals(primitive);
    const std::vector<uint32_t> places = weldPositions(primitive.positions);
    const std::vector<Side> sides = sortedSides(primitive, places);
    Groups groups(primitive.indices.size());
    for (size_t i = 1; i < sides.size(); ++i) {
        const Side& a = sides[i - 1];
        const Side& b = sides[i];
        if (a.places == b.places &&
            glm::dot(facets[a.lowCorner / 3], facets[b.lowCorner / 3]) >= kCreaseCosine) {
            groups.join(a.lowCorner, b.lowCorner);
            groups.join(a.highCorner, b.highCorner);
        }
    }
    std::vector<uint32_t> keys(primitive.indices.size());
    std::vector<glm::dvec3> sums(primitive.indices.size(), glm::dvec3(0.0));
    for (uint32_t corner = 0; corner < keys.size(); ++corner) {
        keys[corner] = groups.find(corner);
        sums[keys[corner]] += facets[corner / 3] * cornerAngle(primitive, corner);
    }
    primitive.normals.clear();
    const std::vector<uint32_t> cornerOf = splitVertices(primitive, keys);
    primitive.normals.resize(primitive.positions.size());
    for (size_t v = 0; v < cornerOf.size(); ++v) {
        primitive.normals[v] =
            glm::vec3(cornerOf[v] == UINT32_MAX ? kAnyNormal : unitOr(sums[keys[cornerOf[v]]], kAnyNormal));
    }
}

size_t repairNormals(Primitive& primitive) {
    std::vector<uint32_t> broken;
    for (uint32_t v = 0; v < primitive.normals.size(); ++v) {
        const glm::dvec3 normal(primitive.normals[v]);
        const double length = glm::length(normal);
        if (length > 0.0 && std::isfinite(length)) {
            primitive.normals[v] = glm::vec3(normal / length);
        } else {
            broken.push_back(v);
        }
    }
    if (broken.empty()) {
        return 0;
    }
    std::vector<glm::dvec3> sums(primitive.positions.size(), glm::dvec3(0.0));
    for (size_t corner = 0; corner < primitive.indices.size(); ++corner) {
        sums[primitive.indices[corner]] +=
            facetNormal(primitive, corner / 3) * cornerAngle(primitive, corner);
    }
    for (const uint32_t v : broken) {
        primitive.normals[v] = glm::vec3(unitOr(sums[v], kAnyNormal));
    }
    return broken.size();
}

}  // namespace lobe
