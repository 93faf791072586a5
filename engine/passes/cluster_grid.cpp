#include "passes/cluster_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lobe {
namespace {

/// The shader takes log2 of a float z: what is this close to a slice's border may fall on either side.
constexpr double kSliceSlack = 1e-4;

/// Whether a cone (apex, axis, half angle, length) may touch a sphere. Exact for the infinite cone's side.
bool coneTouches(const LightVolume& light, const glm::dvec3& center, double radius) {
    if (light.coneAngle <= 0.0 || light.coneAngle >= std::numbers::pi / 2) return true;
    const glm::dvec3 v = center - light.center;
    const double along = glm::dot(v, light.axis);
    const double across = std::sqrt(std::max(0.0, glm::dot(v, v) - along * along));
    const double outside = std::cos(light.coneAngle) * across - along * std::sin(light.coneAngle);
    return outside <= radius && along <= radius + light.radius && along >= -radius;
}

}  // namespace

ClusterGrid::ClusterGrid(const View& view, double nearZ, double farZ)
    : view_(view),
      columns_((view.width + kTile - 1) / kTile),
      rows_((view.height + kTile - 1) / kTile),
      nearZ_(nearZ),
      farZ_(std::max(farZ, nearZ * 1.001)),
      logRatio_(std::log2(farZ_ / nearZ_)) {
    for (int slice = 0; slice < kSlices; ++slice)
        for (int row = 0; row < rows_; ++row)
            for (int column = 0; column < columns_; ++column)
                bounds_.push_back(boundOf(column, row, slice));
    const auto plane = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                          const glm::dvec3& inside) {
        glm::dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
        if (glm::dot(normal, inside - a) < 0.0) normal = -normal;
        return glm::dvec4(normal, -glm::dot(normal, a));
    };
    // A border of columns or rows is the plane through two points of it at different depths and heights.
    for (int i = 0; i <= columns_; ++i) {
        const double x = i * kTile;
        columnPlanes_.push_back(plane(pointAt(x, 0, nearZ_), pointAt(x, 0, farZ_),
                                      pointAt(x, view.height, farZ_), pointAt(x + kTile, 0, farZ_)));
    }
    for (int i = 0; i <= rows_; ++i) {
        const double y = i * kTile;
        rowPlanes_.push_back(plane(pointAt(0, y, nearZ_), pointAt(0, y, farZ_), pointAt(view.width, y, farZ_),
                                   pointAt(0, y + kTile, farZ_)));
    }
}

glm::vec3 ClusterGrid::sliceFactors() const {
    const double scale = kSlices / logRatio_;
    return glm::vec3(scale, -std::log2(nearZ_) * scale, kSlices);
}

int ClusterGrid::sliceOf(double z) const {
    if (z <= nearZ_) return 0;
    return std::clamp(static_cast<int>(std::log2(z / nearZ_) * kSlices / logRatio_), 0, kSlices - 1);
}

double ClusterGrid::sliceStart(int slice) const {
    return nearZ_ * std::exp2(logRatio_ * slice / kSlices);
}

glm::dvec3 ClusterGrid::pointAt(double x, double y, double z) const {
    return view_.rayOrigin + x * view_.rayOriginDx + y * view_.rayOriginDy +
           z * (view_.rayDirection + x * view_.rayDirectionDx + y * view_.rayDirectionDy);
}

ClusterGrid::Sphere ClusterGrid::boundOf(int column, int row, int slice) const {
    const double z0 = sliceStart(slice) * (1.0 - kSliceSlack);
    const double z1 = sliceStart(slice + 1) * (1.0 + kSliceSlack);
    glm::dvec3 corners[8];
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 8; ++i) {
        corners[i] = pointAt((column + (i & 1)) * kTile, (row + ((i >> 1) & 1)) * kTile, (i & 4) ? z1 : z0);
        sum += corners[i];
    }
    Sphere sphere{sum / 8.0, 0.0};
    for (const glm::dvec3& corner : corners)
        sphere.radius = std::max(sphere.radius, glm::length(corner - sphere.center));
    return sphere;
}

ClusterLists ClusterGrid::assign(std::span<const LightVolume> lights, uint32_t firstIndex) const {
    const size_t clusters = bounds_.size();
    std::vector<std::vector<uint32_t>> lists(clusters);
    std::vector<char> tileUsed(static_cast<size_t>(columns_) * static_cast<size_t>(rows_), 0);
    const auto span = [](const std::vector<glm::dvec4>& planes, const LightVolume& light, int count) {
        int first = 0;
        int last = count - 1;
        const auto distance = [&](int i) {
            const glm::dvec4& p = planes[static_cast<size_t>(i)];
            return glm::dot(glm::dvec3(p), light.center) + p.w;
        };
        while (first <= last && distance(first + 1) > light.radius)
            ++first;
        while (last >= first && distance(last) < -light.radius)
            --last;
        return std::pair(first, last);
    };
    for (size_t l = 0; l < lights.size(); ++l) {
        const LightVolume& light = lights[l];
        const double z = glm::dot(light.center, view_.forward);
        // Points behind the eye are in no cluster; the first and last slice also hold what lies outside the
        // range.
        if (z + light.radius <= 0.0 && !view_.orthographic) continue;
        const int slice0 = sliceOf((z - light.radius) * (1.0 - kSliceSlack));
        const int slice1 = sliceOf((z + light.radius) * (1.0 + kSliceSlack));
        // Behind the eye the side planes of a perspective view swap sides: such lights take every column and
        // row.
        const bool around = !view_.orthographic && z - light.radius <= 0.0;
        const auto [c0, c1] = around ? std::pair(0, columns_ - 1) : span(columnPlanes_, light, columns_);
        const auto [r0, r1] = around ? std::pair(0, rows_ - 1) : span(rowPlanes_, light, rows_);
        for (int slice = slice0; slice <= slice1; ++slice)
            for (int row = r0; row <= r1; ++row)
                for (int column = c0; column <= c1; ++column) {
                    const size_t cluster =
                        (static_cast<size_t>(slice) * static_cast<size_t>(rows_) + static_cast<size_t>(row)) *
                            static_cast<size_t>(columns_) +
                        static_cast<size_t>(column);
                    const bool open =
                        slice == 0 || slice == kSlices - 1;  // no bound: may hold anything beyond
                    const Sphere& bound = bounds_[cluster];
                    if (!open && (glm::length(bound.center - light.center) > bound.radius + light.radius ||
                                  !coneTouches(light, bound.center, bound.radius)))
                        continue;
                    lists[cluster].push_back(firstIndex + static_cast<uint32_t>(l));
                    tileUsed[static_cast<size_t>(row) * static_cast<size_t>(columns_) +
                             static_cast<size_t>(column)] = 1;
                }
    }
    ClusterLists result;
    result.ranges.reserve(clusters * 2);
    for (const std::vector<uint32_t>& list : lists) {
        result.ranges.push_back(static_cast<uint32_t>(result.indices.size()));
        result.ranges.push_back(static_cast<uint32_t>(list.size()));
        result.indices.insert(result.indices.end(), list.begin(), list.end());
    }
    for (int row = 0; row < rows_; ++row)
        for (int column = 0; column < columns_; ++column)
            if (tileUsed[static_cast<size_t>(row) * static_cast<size_t>(columns_) +
                         static_cast<size_t>(column)])
                result.tiles.emplace_back(column, row);
    return result;
}

}  // namespace lobe
