/// Light lists by cluster, made on the CPU (Olsson, Billeter, Assarsson, "Clustered deferred and forward
/// shading", HPG 2012): tiles of 64 x 64 pixels, sliced in depth with equal ratios.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/camera.hpp"

namespace lobe {

/// What a light with a range can reach: a sphere, cut by a cone for spots. Relative to the eye, world axes.
struct LightVolume {
    glm::dvec3 center;
    double radius;
    glm::dvec3 axis{0.0};    ///< of the cone, unit
    double coneAngle = 0.0;  ///< half angle, radians; 0: the whole sphere
};

struct ClusterLists {
    std::vector<uint32_t> ranges;   ///< first, count: two a cluster, in the order (slice, row, column)
    std::vector<uint32_t> indices;  ///< into the lights given, ascending in each cluster
    std::vector<glm::vec2> tiles;   ///< column, row of each tile that any light reaches
};

class ClusterGrid {
public:
    static constexpr int kTile = 64;
    static constexpr int kSlices = 24;

    /// Slices divide [nearZ, farZ]; what lies outside belongs to the first or last.
    ClusterGrid(const View& view, double nearZ, double farZ);

    int columns() const { return columns_; }
    int rows() const { return rows_; }
    /// The shader's slice = clamp(log2(z) * x + y, 0, z - 1).
    glm::vec3 sliceFactors() const;

    /// Conservative: a light that reaches any point of a cluster is in its list. `firstIndex` is added to
    /// each index.
    ClusterLists assign(std::span<const LightVolume> lights, uint32_t firstIndex) const;

private:
    struct Sphere {
        glm::dvec3 center;
        double radius;
    };
    int sliceOf(double z) const;
    double sliceStart(int slice) const;
    Sphere boundOf(int column, int row, int slice) const;
    glm::dvec3 pointAt(double x, double y, double z) const;

    View view_;
    int columns_, rows_;
    double nearZ_, farZ_, logRatio_;
    std::vector<Sphere> bounds_;
    std::vector<glm::dvec4> columnPlanes_, rowPlanes_;  ///< positive towards higher columns, rows
};

}  // namespace lobe
