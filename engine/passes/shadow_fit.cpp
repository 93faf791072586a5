#include "passes/shadow_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lobe {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Where a perspective map begins, in radii of the scene.
constexpr double kPerspectiveStart = 1e-6;
/// A map that need be no smaller than this part of what all casters take up holds them all, and stays when
/// the camera moves.
constexpr double kWorthCropping = 0.7;
/// Ranges of distance, each as deep in proportion, that cascades are made of.
constexpr int kSlices = 48;

glm::dmat3 axesAlong(const glm::dvec3& z) {
    const glm::dvec3 up = std::abs(z.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(up, z));
    return {x, glm::cross(z, x), z};
}

using Polygon = std::vector<glm::dvec3>;

/// What of a polygon is where dot(plane, p) + plane.w >= 0.
void clip(Polygon& polygon, const glm::dvec4& plane, Polygon& scratch) {
    scratch.clear();
    const auto side = [&](const glm::dvec3& p) { return glm::dot(glm::dvec3(plane), p) + plane.w; };
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[i];
        const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
        const double sa = side(a), sb = side(b);
        if (sa >= 0.0) scratch.push_back(a);
        if ((sa >= 0.0) != (sb >= 0.0)) scratch.push_back(a + (b - a) * (sa / (sa - sb)));
    }
    polygon.swap(scratch);
}

double nearOf(const View& view) {
    return (view.depthToZ.x + view.depthToZ.y) / (view.depthToZ.z + view.depthToZ.w);
}

double farOf(const View& view) {
    return view.depthToZ.z > 0.0 ? view.depthToZ.x / view.depthToZ.z : kInfinity;
}

/// Planes of what a picture shows, and a pixel about it, relative to the eye; the same for all jittered
/// samples.
std::vector<glm::dvec4> planesOf(const View& view) {
    const glm::dvec3 dx = view.orthographic ? view.rayOriginDx : view.rayDirectionDx;
    const glm::dvec3 dy = view.orthographic ? view.rayOriginDy : view.rayDirectionDy;
    const glm::dvec3 right = glm::normalize(dx), up = glm::normalize(dy);
    const double halfWidth = glm::length(dx) * (0.5 * view.width + 1.0);
    const double halfHeight = glm::length(dy) * (0.5 * view.height + 1.0);
    std::vector<glm::dvec4> planes;
    const auto pair = [&](const glm::dvec3& axis, double half) {
        for (const double sign : {-1.0, 1.0})
            planes.push_back(view.orthographic ? glm::dvec4(sign * axis, half)
                                               : glm::dvec4(sign * axis + half * view.forward, 0.0));
    };
    pair(right, halfWidth);
    pair(up, halfHeight);
    planes.emplace_back(view.forward, -nearOf(view));
    if (std::isfinite(farOf(view))) planes.emplace_back(-view.forward, farOf(view));
    return planes;
}

/// Calls `found` with what of each triangle is inside all planes, relative to `eye`.
template<class Found>
void clippedTriangles(const Scene& scene, const glm::dvec3& eye, const std::vector<glm::dvec4>& planes,
                      bool castersOnly, const Found& found) {
    std::vector<glm::dvec3> points;
    std::vector<unsigned> outside;  // of which planes, a bit each
    Polygon polygon, scratch;
    for (const Instance& instance : scene.instances) {
        if (castersOnly && !instance.castsShadow) continue;
        const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
        glm::dmat4 relativeFromLocal = instance.worldFromLocal;
        relativeFromLocal[3] -= glm::dvec4(eye, 0.0);
        points.clear();
        outside.clear();
        for (const glm::vec3& position : primitive.positions) {
            const glm::dvec3 p(relativeFromLocal * glm::dvec4(position, 1.0));
            unsigned bits = 0;
            for (size_t i = 0; i < planes.size(); ++i)
                if (!(glm::dot(glm::dvec3(planes[i]), p) + planes[i].w >= 0.0)) bits |= 1u << i;
            points.push_back(p);
            outside.push_back(bits);
        }
        for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            const uint32_t* corner = &primitive.indices[i];
            if ((outside[corner[0]] & outside[corner[1]] & outside[corner[2]]) != 0) continue;
            const unsigned crossed = outside[corner[0]] | outside[corner[1]] | outside[corner[2]];
            polygon = {points[corner[0]], points[corner[1]], points[corner[2]]};
            for (size_t p = 0; p < planes.size() && !polygon.empty(); ++p)
                if ((crossed & (1u << p)) != 0) clip(polygon, planes[p], scratch);
            if (!polygon.empty()) found(polygon);
        }
    }
}

}  // namespace

int ShadowFilter::guard() const {
    return static_cast<int>(std::ceil(reach() + std::numbers::sqrt2 * radius())) + 1;
}

double normalOffset(const ShadowProjection& map, const glm::dvec3& position, const glm::dvec3& normal,
                    double radius) {
    const double slope = radius * (std::abs(glm::dot(map.x, normal)) * map.texel.x +
                                   std::abs(glm::dot(map.y, normal)) * map.texel.y);
    if (!map.perspective) return slope;
    // The shift itself may lead further from the light, where texels are larger.
    return std::max(glm::dot(map.z, position), 0.0) * slope / std::max(1.0 - slope, 0.5);
}

glm::dvec3 shadowCoordinates(const ShadowProjection& map, const glm::dvec3& position) {
    const double z = glm::dot(map.z, position);
    const glm::dvec2 across(glm::dot(map.x, position), glm::dot(map.y, position));
    return map.perspective ? glm::dvec3(across / (map.texel * z), map.reach / z)
                           : glm::dvec3(across / map.texel, 1.0 - z / map.reach);
}

View shadowView(const ShadowProjection& map, int size) {
    View view{};
    view.eye = map.origin;
    view.forward = map.z;
    view.orthographic = !map.perspective;
    view.width = view.height = size;
    glm::dmat4 rows(0.0);  // columns of its transpose
    const glm::dvec2 half = map.texel * (0.5 * size);
    rows[0] = glm::dvec4(map.x / half.x, 0.0);
    rows[1] = glm::dvec4(map.y / half.y, 0.0);
    if (map.perspective) {
        rows[2] = glm::dvec4(0.0, 0.0, 0.0, map.reach);
        rows[3] = glm::dvec4(map.z, 0.0);
    } else {
        rows[2] = glm::dvec4(-map.z / map.reach, 1.0);
        rows[3] = glm::dvec4(0.0, 0.0, 0.0, 1.0);
    }
    view.clipFromRelative = glm::transpose(rows);
    return view;
}

ShadowProjection fitSpot(const Light& light, double sceneRadius, int size, const ShadowFilter& filter) {
    ShadowProjection map;
    map.perspective = true;
    map.origin = light.position;
    const glm::dmat3 axes = axesAlong(light.direction);
    map.x = axes[0];
    map.y = axes[1];
    map.z = axes[2];
    const double tangent = std::max(std::tan(light.outerConeAngle), 1e-6);
    map.texel = glm::dvec2(2.0 * tangent / (size - 2.0 * filter.guard()));
    map.reach = std::max(sceneRadius * kPerspectiveStart, 1e-30);
    return map;
}

ShadowProjection cubeFace(const glm::dvec3& position, int face, double sceneRadius, int size,
                          const ShadowFilter& filter) {
    ShadowProjection map;
    map.perspective = true;
    map.origin = position;
    const int axis = face / 2;
    glm::dvec3 units[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    map.x = units[(axis + 1) % 3];
    map.y = units[(axis + 2) % 3];
    map.z = units[axis] * (face % 2 == 0 ? 1.0 : -1.0);
    map.texel = glm::dvec2(2.0 / (size - 2.0 * filter.guard()));
    map.reach = std::max(sceneRadius * kPerspectiveStart, 1e-30);
    return map;
}

double nearestCaster(const Scene& scene, const ShadowProjection& map, int size,
                     const std::optional<glm::dvec3>& facing) {
    const glm::dvec2 half = map.texel * (0.5 * size);
    std::vector<glm::dvec4> planes{{map.z, -map.reach}};
    for (const double sign : {-1.0, 1.0}) {
        planes.emplace_back(half.x * map.z + sign * map.x, 0.0);
        planes.emplace_back(half.y * map.z + sign * map.y, 0.0);
    }
    if (facing) planes.emplace_back(*facing, -map.reach);
    double nearest = kInfinity;
    clippedTriangles(scene, map.origin, planes, true, [&](const Polygon& polygon) {
        for (const glm::dvec3& point : polygon)
            nearest = std::min(nearest, glm::dot(point, map.z));
    });
    return nearest;
}

void DirectionalFit::Box::add(const glm::dvec3& point) {
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
}

DirectionalFit::DirectionalFit(const Scene& scene, const glm::dvec3& direction)
    : scene_(scene), pivot_(scene.bounds().center()), lightFromWorld_(glm::transpose(axesAlong(direction))) {
    end_ = -kInfinity;
    for (const Instance& instance : scene.instances) {
        const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
        glm::dmat4 pivoted = instance.worldFromLocal;
        pivoted[3] -= glm::dvec4(pivot_, 0.0);
        const glm::dmat4 lightFromLocal = glm::dmat4(lightFromWorld_) * pivoted;
        for (const glm::vec3& position : primitive.positions) {
            const glm::dvec3 p(lightFromLocal * glm::dvec4(position, 1.0));
            end_ = std::max(end_, p.z);
            if (instance.castsShadow) casters_.add(p);
        }
    }
}

DirectionalFit::Box DirectionalFit::visible(const View& view, double& nearest, double& farthest) const {
    Box seen;
    nearest = kInfinity;
    farthest = 0.0;
    const glm::dvec3 shift = view.eye - pivot_;
    clippedTriangles(scene_, view.eye, planesOf(view), false, [&](const Polygon& polygon) {
        for (const glm::dvec3& point : polygon) {
            const double z = glm::dot(point, view.forward);
            nearest = std::min(nearest, z);
            farthest = std::max(farthest, z);
            seen.add(lightFromWorld_ * (point + shift));
        }
    });
    return seen;
}

/// What is seen between each two neighbours of `edges`.
std::vector<DirectionalFit::Box> DirectionalFit::slices(const View& view,
                                                        const std::vector<double>& edges) const {
    std::vector<Box> boxes(edges.size() - 1);
    const glm::dvec3 shift = view.eye - pivot_;
    const auto sliceOf = [&](double z) {
        const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, z);
        return static_cast<size_t>(above - edges.begin()) - 1;
    };
    Polygon part, scratch;
    clippedTriangles(scene_, view.eye, planesOf(view), false, [&](const Polygon& polygon) {
        double low = kInfinity, high = 0.0;
        for (const glm::dvec3& point : polygon) {
            low = std::min(low, glm::dot(point, view.forward));
            high = std::max(high, glm::dot(point, view.forward));
        }
        for (size_t i = sliceOf(low); i <= sliceOf(high); ++i) {
            part = polygon;
            if (low < edges[i]) clip(part, glm::dvec4(view.forward, -edges[i]), scratch);
            if (high > edges[i + 1]) clip(part, glm::dvec4(-view.forward, edges[i + 1]), scratch);
            for (const glm::dvec3& point : part)
                boxes[i].add(lightFromWorld_ * (point + shift));
        }
    });
    return boxes;
}

/// Where something that is seen can be in shadow: all of the casters' side of the light if that is hardly
/// larger.
DirectionalFit::Box DirectionalFit::crop(const Box& seen) const {
    Box box;
    if (seen.empty() || casters_.empty()) return box;
    box.lower = glm::max(seen.lower, casters_.lower);
    box.upper = glm::min(seen.upper, casters_.upper);
    box.lower.z = casters_.lower.z;
    box.upper.z = end_;
    if (!(box.lower.x <= box.upper.x && box.lower.y <= box.upper.y)) return {};
    const auto area = [](const Box& b) { return (b.upper.x - b.lower.x) * (b.upper.y - b.lower.y); };
    if (area(box) >= kWorthCropping * area(casters_)) {
        box.lower = glm::dvec3(casters_.lower.x, casters_.lower.y, box.lower.z);
        box.upper = glm::dvec3(casters_.upper.x, casters_.upper.y, box.upper.z);
    }
    return box;
}

ShadowProjection DirectionalFit::around(const Box& box, int size, const ShadowFilter& filter) const {
    ShadowProjection map;
    const glm::dmat3 worldFromLight = glm::transpose(lightFromWorld_);
    map.x = worldFromLight[0];
    map.y = worldFromLight[1];
    map.z = worldFromLight[2];
    map.empty = box.empty();
    map.origin = pivot_;
    if (map.empty) return map;
    const glm::dvec3 extent = box.upper - box.lower;
    const double least = std::max(1e-6 * std::max(extent.x, std::max(extent.y, extent.z)), 1e-30);
    // The box begins and ends a little outside, so that nothing that casts or receives is clipped.
    const double margin = std::max(1e-4 * extent.z, least);
    const glm::dvec3 middle = 0.5 * (box.lower + box.upper);
    map.origin = pivot_ + worldFromLight * glm::dvec3(middle.x, middle.y, box.lower.z - margin);
    map.reach = extent.z + 2.0 * margin;
    map.texel = glm::max(glm::dvec2(extent.x, extent.y), glm::dvec2(least)) / (size - 2.0 * filter.guard());
    return map;
}

DirectionalMaps DirectionalFit::fit(const View& view, int size, const ShadowFilter& filter) const {
    double zNear = 0.0, zFar = 0.0;
    const Box seen = visible(view, zNear, zFar);
    DirectionalMaps one;
    one.ends.fill(kInfinity);
    one.maps.push_back(around(crop(seen), size, filter));
    if (view.orthographic || one.maps[0].empty || !(zFar > zNear)) return one;
    const double pixel = glm::length(view.rayDirectionDx);  // its size at 1 m
    const auto coarseness = [&](const Box& box, int texels, double distance) {
        const ShadowProjection map = around(crop(box), texels, filter);
        return map.empty ? 0.0 : std::max(map.texel.x, map.texel.y) / (pixel * distance);
    };
    const double worst = coarseness(seen, size, zNear);
    if (worst <= 1.0) return one;

    std::vector<double> edges;
    for (int i = 0; i <= kSlices; ++i)
        edges.push_back(zNear * std::pow(zFar / zNear, static_cast<double>(i) / kSlices));
    const std::vector<Box> boxes = slices(view, edges);
    // worstOf[k][j]: the least that k + 1 cascades over the first j slices can have as their worst;
    // from[k][j]: where the last of them begins.
    std::array<std::array<double, kSlices + 1>, kMostCascades> worstOf{};
    std::array<std::array<int, kSlices + 1>, kMostCascades> from{};
    for (auto& row : worstOf)
        row.fill(kInfinity);
    for (int i = 0; i < kSlices; ++i) {
        Box box;
        double start = 0.0;
        for (int j = i; j < kSlices; ++j) {
            if (!boxes[static_cast<size_t>(j)].empty()) {
                if (box.empty()) start = edges[static_cast<size_t>(j)];
                box.add(boxes[static_cast<size_t>(j)].lower);
                box.add(boxes[static_cast<size_t>(j)].upper);
            }
            const double own = box.empty() ? 0.0 : coarseness(box, size / 2, start);
            const auto end = static_cast<size_t>(j) + 1;
            for (size_t k = 0; k < kMostCascades; ++k) {
                const double before = i == 0   ? (k == 0 ? 0.0 : kInfinity)
                                      : k == 0 ? kInfinity
                                               : worstOf[k - 1][static_cast<size_t>(i)];
                if (std::max(before, own) >= worstOf[k][end]) continue;
                worstOf[k][end] = std::max(before, own);
                from[k][end] = i;
            }
        }
    }
    if (!(worstOf[kMostCascades - 1][kSlices] < worst)) return one;
    DirectionalMaps four;
    four.maps.resize(kMostCascades);
    int end = kSlices;
    for (int k = kMostCascades - 1; k >= 0; --k) {
        const int start = from[static_cast<size_t>(k)][static_cast<size_t>(end)];
        Box box;
        for (int i = start; i < end; ++i)
            if (const Box& slice = boxes[static_cast<size_t>(i)]; !slice.empty()) {
                box.add(slice.lower);
                box.add(slice.upper);
            }
        four.maps[static_cast<size_t>(k)] = around(crop(box), size / 2, filter);
        if (k > 0) four.ends[static_cast<size_t>(k) - 1] = edges[static_cast<size_t>(start)];
        end = start;
    }
    return four;
}

}  // namespace lobe
