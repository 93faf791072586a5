#include "passes/ray_pairs.hpp"

#include <algorithm>
#include <limits>

namespace lobe {
namespace {

struct Edge {
    uint64_t vertices;  ///< the smaller index above the larger
    uint32_t triangle;
    uint32_t corner;  ///< the one opposite
    auto operator<=>(const Edge&) const = default;
};

double boxArea(const Primitive& primitive, std::initializer_list<uint32_t> vertices) {
    Bounds box;
    for (const uint32_t vertex : vertices)
        box.add(glm::dvec3(primitive.positions[vertex]));
    const glm::dvec3 size = box.upper - box.lower;
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

std::vector<Edge> sortedEdges(const Primitive& primitive) {
    std::vector<Edge> edges;
    edges.reserve(primitive.indices.size());
    for (uint32_t i = 0; i < primitive.indices.size(); ++i) {
        const uint32_t first = i - i % 3;
        const auto [low, high] =
            std::minmax(primitive.indices[first + (i + 1) % 3], primitive.indices[first + (i + 2) % 3]);
        edges.push_back({uint64_t{low} << 32 | high, i / 3, i % 3});
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

/// For each corner of each triangle the corner across the opposite edge, or none.
constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
std::vector<uint32_t> cornersAcross(const Primitive& primitive) {
    std::vector<uint32_t> across(primitive.indices.size(), kNone);
    const std::vector<Edge> edges = sortedEdges(primitive);
    for (size_t i = 1; i < edges.size(); ++i) {
        const Edge& a = edges[i - 1];
        const Edge& b = edges[i];
        if (a.vertices != b.vertices || a.triangle == b.triangle) continue;
        const uint32_t p = 3 * a.triangle + a.corner, q = 3 * b.triangle + b.corner;
        if (across[p] != kNone) continue;  // more than two triangles at the edge
        across[p] = q;
        across[q] = p;
    }
    return across;
}

}  // namespace

std::vector<TrianglePair> pairTriangles(const Primitive& primitive) {
    const auto count = static_cast<uint32_t>(primitive.triangleCount());
    const std::vector<uint32_t> across = cornersAcross(primitive);
    const auto vertex = [&](uint32_t triangle, uint32_t corner) {
        return primitive.indices[3 * triangle + corner % 3];
    };
    std::vector<TrianglePair> pairs;
    pairs.reserve(count / 2 + 1);
    std::vector<bool> taken(count, false);
    for (uint32_t triangle = 0; triangle < count; ++triangle) {
        if (taken[triangle]) continue;
        taken[triangle] = true;
        const double own =
            boxArea(primitive, {vertex(triangle, 0), vertex(triangle, 1), vertex(triangle, 2)});
        double best = std::numeric_limits<double>::infinity();
        TrianglePair pair{vertex(triangle, 0), vertex(triangle, 1), vertex(triangle, 2), vertex(triangle, 2)};
        uint32_t partner = kNone;
        for (uint32_t corner = 0; corner < 3; ++corner) {
            const uint32_t other = across[3 * triangle + corner];
            if (other == kNone || taken[other / 3]) continue;
            const uint32_t a = vertex(triangle, corner), b = vertex(triangle, corner + 1),
                           c = vertex(triangle, corner + 2), d = primitive.indices[other];
            const double both = boxArea(primitive, {a, b, c, d});
            if (both >= best || both > own + boxArea(primitive, {b, c, d})) continue;
            best = both;
            pair = {a, b, c, d};
            partner = other / 3;
        }
        if (partner != kNone) taken[partner] = true;
        pairs.push_back(pair);
    }
    return pairs;
}

}  // namespace lobe
