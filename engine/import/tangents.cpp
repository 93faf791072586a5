#include "import/tangents.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cfloat>
#include <cmath>

#include "import/vertices.hpp"
#include "import/welding.hpp"

namespace lobe {

namespace {

constexpr uint32_t kNone = UINT32_MAX;

/// Gradients of the texture coordinates on a triangle.
struct Facet {
    glm::dvec3 alongU{0.0};   ///< unit, or zero
    bool degenerate = false;  ///< two corners at one place: takes no part, and copies from its neighbours
    bool mirrored = false;    ///< texture and surface run round in different directions
    bool joinsAny =
        true;  ///< no area in the texture: joins whatever group reaches it first, adds nothing to it
};

glm::dvec3 unitOrZero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > DBL_MIN ? v / length : glm::dvec3(0.0);
}

glm::dvec3 inPlane(const glm::dvec3& v, const glm::dvec3& normal) {
    return unitOrZero(v - normal * glm::dot(normal, v));
}

/// Corners of the same smoothly mapped surface around one place.
struct Group {
    glm::dvec3 sum{0.0};
    bool mirrored = false;
};

class MikkTSpace {
public:
    MikkTSpace(const Primitive& primitive, std::span<const glm::vec2> uvs)
        : primitive_(primitive), uvs_(uvs) {
        weldCorners();
        measureFacets();
        findNeighbours();
        group();
    }

    /// For each corner its group or kNone; the groups' tangents.
    std::vector<uint32_t> groupOf;
    std::vector<glm::vec4> tangents;

private:
    size_t cornerCount() const { return primitive_.indices.size(); }
    glm::dvec3 position(size_t corner) const { return {primitive_.positions[primitive_.indices[corner]]}; }
    glm::dvec3 normal(size_t corner) const { return {primitive_.normals[primitive_.indices[corner]]}; }
    static uint32_t following(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
    static uint32_t preceding(uint32_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

    /// Vertices are one where position, normal and texture coordinate agree.
    void weldCorners() {
        std::vector<uint32_t> words;
        words.reserve(primitive_.positions.size() * 8);
        for (size_t v = 0; v < primitive_.positions.size(); ++v) {
            const glm::vec3& p = primitive_.positions[v];
            const glm::vec3& n = primitive_.normals[v];
            words.insert(words.end(),
                         {weldWord(p.x), weldWord(p.y), weldWord(p.z), weldWord(n.x), weldWord(n.y),
                          weldWord(n.z), weldWord(uvs_[v].x), weldWord(uvs_[v].y)});
        }
        const std::vector<uint32_t> first = weld(words, 8);
        places_.resize(cornerCount());
        for (size_t corner = 0; corner < cornerCount(); ++corner) {
            places_[corner] = first[primitive_.indices[corner]];
        }
    }

    void measureFacets() {
        facets_.resize(primitive_.triangleCount());
        for (size_t t = 0; t < facets_.size(); ++t) {
            const std::array<glm::vec3, 3> p{primitive_.positions[primitive_.indices[3 * t]],
                                             primitive_.positions[primitive_.indices[3 * t + 1]],
                                             primitive_.positions[primitive_.indices[3 * t + 2]]};
            Facet& facet = facets_[t];
            facet.degenerate = p[0] == p[1] || p[0] == p[2] || p[1] == p[2];
            const glm::vec2 origin = uvs_[primitive_.indices[3 * t]];
            const glm::vec2 uv1 = uvs_[primitive_.indices[3 * t + 1]] - origin;
            const glm::vec2 uv2 = uvs_[primitive_.indices[3 * t + 2]] - origin;
            // In float, as elsewhere, so that the same triangles count as having no area.
            const float area = uv1.x * uv2.y - uv1.y * uv2.x;
            const glm::dvec3 side1 = glm::dvec3(p[1]) - glm::dvec3(p[0]);
            const glm::dvec3 side2 = glm::dvec3(p[2]) - glm::dvec3(p[0]);
            const glm::dvec3 alongU = double{uv2.y} * side1 - double{uv1.y} * side2;
            const glm::dvec3 alongV = double{uv1.x} * side2 - double{uv2.x} * side1;
            // glTF's v grows downwards in the picture, so an unmirrored map has a negative area.
            facet.mirrored = area > 0.0f;
            facet.alongU = unitOrZero(alongU) * (area > 0.0f ? 1.0 : -1.0);
            facet.joinsAny = std::abs(area) <= FLT_MIN || glm::length(alongU) <= double{FLT_MIN} ||
                             glm::length(alongV) <= double{FLT_MIN};
        }
    }

    /// Pairs sides of triangles that run along each other in opposite directions, each with the first that is
    /// free.
    void findNeighbours() {
        struct Side {
            uint64_t places;
            uint32_t corner;  ///< where it starts
        };
        std::vector<Side> sides;
        sides.reserve(cornerCount());
        for (uint32_t corner = 0; corner < cornerCount(); ++corner) {
            if (!facets_[corner / 3].degenerate) {
                const uint32_t a = places_[corner];
                const uint32_t b = places_[following(corner)];
                sides.push_back({uint64_t{std::min(a, b)} << 32 | std::max(a, b), corner});
            }
        }
        std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
            return a.places != b.places ? a.places < b.places : a.corner < b.corner;
        });
        neighbours_.assign(cornerCount(), kNone);
        size_t waiting = 0;  // sides [waiting, i) without a partner yet all run the same way
        for (size_t i = 0; i < sides.size(); ++i) {
            if (sides[waiting].places != sides[i].places) {
                waiting = i;
            }
            while (waiting < i && neighbours_[sides[waiting].corner] != kNone) {
                ++waiting;
            }
            if (waiting < i && places_[sides[waiting].corner] != places_[sides[i].corner]) {
                neighbours_[sides[waiting].corner] = sides[i].corner / 3;
                neighbours_[sides[i].corner] = sides[waiting].corner / 3;
            }
        }
    }

    void group() {
        groupOf.assign(cornerCount(), kNone);
        for (uint32_t corner = 0; corner < cornerCount(); ++corner) {
            const Facet& facet = facets_[corner / 3];
            if (!facet.degenerate && !facet.joinsAny && groupOf[corner] == kNone) {
                groups_.push_back({glm::dvec3(0.0), facet.mirrored});
                spread(corner);
            }
        }
        for (const Group& group : groups_) {
            tangents.emplace_back(glm::vec3(unitOrZero(group.sum)), group.mirrored ? -1.0f : 1.0f);
        }
        fillDegenerate();
    }

    /// Collects all corners at the same place that are reached over sides without a change of mirroring.
    void spread(uint32_t start) {
        const auto id = static_cast<uint32_t>(groups_.size() - 1);
        Group& group = groups_.back();
        pending_.assign(1, start / 3);
        while (!pending_.empty()) {
            const uint32_t triangle = pending_.back();
            pending_.pop_back();
            const uint32_t first = 3 * triangle;
            uint32_t corner = first;
            while (corner < first + 3 && places_[corner] != places_[start]) {
                ++corner;
            }
            if (corner == first + 3 || groupOf[corner] != kNone) {
                continue;
            }
            Facet& facet = facets_[triangle];
            if (facet.joinsAny && groupOf[first] == kNone && groupOf[first + 1] == kNone &&
                groupOf[first + 2] == kNone) {
                facet.mirrored = group.mirrored;
            }
            if (facet.mirrored != group.mirrored) {
                continue;
            }
            groupOf[corner] = id;
            add(group, facet, corner);
            for (const uint32_t side : {preceding(corner), corner}) {  // the last one in is looked at first
                if (neighbours_[side] != kNone) {
                    pending_.push_back(neighbours_[side]);
                }
            }
        }
    }

    /// Directions weighted by the triangle's angle at the corner, both as projected along the normal.
    void add(Group& group, const Facet& facet, uint32_t corner) const {
        if (facet.joinsAny) {
            return;
        }
        const glm::dvec3 n = normal(corner);
        const glm::dvec3 p = position(corner);
        const glm::dvec3 a = inPlane(position(preceding(corner)) - p, n);
        const glm::dvec3 b = inPlane(position(following(corner)) - p, n);
        const double angle = std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
        group.sum += angle * inPlane(facet.alongU, n);
    }

    /// Corners of degenerate triangles take the tangent of any other corner at their place.
    void fillDegenerate() {
        std::vector<uint32_t> groupAt;
        for (uint32_t corner = 0; corner < cornerCount(); ++corner) {
            if (!facets_[corner / 3].degenerate) {
                continue;
            }
            if (groupAt.empty()) {
                groupAt.assign(primitive_.positions.size(), kNone);
                for (uint32_t other = 0; other < cornerCount(); ++other) {
                    if (groupOf[other] != kNone && groupAt[places_[other]] == kNone) {
                        groupAt[places_[other]] = groupOf[other];
                    }
                }
            }
            groupOf[corner] = groupAt[places_[corner]];
        }
    }

    const Primitive& primitive_;
    std::span<const glm::vec2> uvs_;
    std::vector<uint32_t> places_;  ///< of each corner: its welded vertex
    std::vector<Facet> facets_;
    std::vector<uint32_t> neighbours_;  ///< of each corner: the triangle across the side that starts there
    std::vector<Group> groups_;
    std::vector<uint32_t> pending_;
};

}  // namespace

void makeTangents(Primitive& primitive, std::span<const glm::vec2> uvs) {
    MikkTSpace space(primitive, uvs);
    // Groups with the same tangent need no vertices of their own.
    std::vector<uint32_t> words;
    words.reserve(space.tangents.size() * 4);
    for (const glm::vec4& t : space.tangents) {
        words.insert(words.end(), {weldWord(t.x), weldWord(t.y), weldWord(t.z), weldWord(t.w)});
    }
    const std::vector<uint32_t> first = weld(words, 4);
    std::vector<uint32_t> keys(space.groupOf.size(), kNone);
    for (size_t corner = 0; corner < keys.size(); ++corner) {
        if (space.groupOf[corner] != kNone) {
            keys[corner] = first[space.groupOf[corner]];
        }
    }
    primitive.tangents.clear();
    const std::vector<uint32_t> cornerOf = splitVertices(primitive, keys);
    primitive.tangents.assign(primitive.positions.size(), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    for (size_t v = 0; v < cornerOf.size(); ++v) {
        if (cornerOf[v] != kNone && keys[cornerOf[v]] != kNone) {
            primitive.tangents[v] = space.tangents[keys[cornerOf[v]]];
        }
    }
    repairTangents(primitive);
}

size_t repairTangents(Primitive& primitive) {
    constexpr double kLeastSine = 1e-4;  // to the normal; below it the direction is rounding error
    size_t repaired = 0;
    for (size_t v = 0; v < primitive.tangents.size(); ++v) {
        const glm::dvec3 normal(primitive.normals[v]);
        const glm::dvec3 tangent(primitive.tangents[v]);
        const glm::dvec3 projected = tangent - normal * glm::dot(normal, tangent);
        const double length = glm::length(projected);
        const float sign = primitive.tangents[v].w < 0.0f ? -1.0f : 1.0f;
        if (std::isfinite(length) && length > kLeastSine * glm::length(tangent)) {
            primitive.tangents[v] = glm::vec4(glm::vec3(projected / length), sign);
        } else {
            primitive.tangents[v] = glm::vec4(anyPerpendicular(primitive.normals[v]), sign);
            ++repaired;
        }
    }
    return repaired;
}

glm::vec3 anyPerpendicular(const glm::vec3& normal) {
    const glm::dvec3 n(normal);
    const glm::dvec3 other = std::abs(n.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    return glm::vec3(glm::normalize(other - n * glm::dot(n, other)));
}

}  // namespace lobe
