/// Where shadow maps look: projections of the scene as its lights see it, as tight as casters and what the
/// camera sees allow. Pure: no OpenGL.
///
/// frame  world, double; maps are drawn and read relative to their origin and to the eye
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "scene/camera.hpp"
#include "scene/scene.hpp"

namespace lobe {

/// One map: light arrives along z, in parallel or from the origin. Depths that it stores grow towards the
/// light: 1 - z / reach in parallel light, reach / z in a perspective; 0 where nothing is.
struct ShadowProjection {
    bool perspective = false;
    bool empty = false;      ///< nothing that could be seen in shadow
    glm::dvec3 origin{0.0};  ///< world: the light, or the middle of the side of the box where light enters
    glm::dvec3 x{1, 0, 0}, y{0, 1, 0},
        z{0, 0, 1};         ///< unit, world: across the map, up, the way that light travels
    glm::dvec2 texel{1.0};  ///< size of a texel, m; of a perspective: at 1 m along z
    double reach = 1.0;     ///< depth of the box, m; of a perspective: where it begins, m
};

/// What surrounds a filter of side x side bilinear comparisons, in texels.
struct ShadowFilter {
    int side = 1;
    /// Farthest that the centre of a texel that is read may be from the receiver, along one axis: half the
    /// filter, the texel that bilinear taps reach further, and what rasterisers round (vertices to 1/256
    /// texel, depths where they are extrapolated from the map's corner).
    double radius() const { return 0.5 * (side - 1) + 1.0 + 1.0 / 128.0; }
    /// Taps reach so far inside from a point that they are made about.
    double reach() const { return 0.5 * (side - 1) + 1.0; }
    /// Kept free about what a map must hold: taps, and the shift of the receiver along its normal.
    int guard() const;
};

/// The shift of a receiver along its normal, towards the light, that lets no plane shadow itself: w R (|n.x|
/// + |n.y|), w the texel's size at the receiver; in a perspective at the place that it is shifted to
/// (docs/shadows.md). `position` is relative to the map's origin; `normal` unit, towards the light. Rounding
/// is not included.
double normalOffset(const ShadowProjection& map, const glm::dvec3& position, const glm::dvec3& normal,
                    double radius);

/// Texel coordinates from the map's middle, and the depth that the map would store for a point (relative to
/// its origin).
glm::dvec3 shadowCoordinates(const ShadowProjection& map, const glm::dvec3& position);

/// Draws into `size` texels a side, as seen from the map's origin: a View with depth in 0..1.
View shadowView(const ShadowProjection& map, int size);

/// A spot's map; the cone within the guard.
ShadowProjection fitSpot(const Light& light, double sceneRadius, int size, const ShadowFilter& filter);

/// Faces of a cube about a light: +X -X +Y -Y +Z -Z. x and y are the axes that follow the face's own in
/// cyclic order.
ShadowProjection cubeFace(const glm::dvec3& position, int face, double sceneRadius, int size,
                          const ShadowFilter& filter);

/// The least depth along the map's axis of what casts into a perspective map, m; infinite where nothing does.
/// Of a light that shines to one side (`facing`, unit) what is on that side counts.
double nearestCaster(const Scene& scene, const ShadowProjection& map, int size,
                     const std::optional<glm::dvec3>& facing = {});

inline constexpr int kMostCascades = 4;

/// A directional light's maps. One of `size` texels a side; or, where that would be coarser on the screen,
/// four of half the side, each for a range of distances from the camera: those whose largest texel, in
/// pixels, is smallest.
struct DirectionalMaps {
    std::vector<ShadowProjection> maps;
    /// Distance along the view axis where the next map begins, m; infinite after the last.
    std::array<double, kMostCascades - 1> ends;
};

/// What the fit of parallel light needs of a scene whatever the camera is, in axes of the light about a
/// pivot.
class DirectionalFit {
public:
    /// The scene is kept by reference.
    DirectionalFit(const Scene& scene, const glm::dvec3& direction);
    DirectionalMaps fit(const View& view, int size, const ShadowFilter& filter) const;

private:
    struct Box {
        glm::dvec3 lower{1e300}, upper{-1e300};
        void add(const glm::dvec3& point);
        bool empty() const { return !(lower.x <= upper.x); }
    };
    Box visible(const View& view, double& nearest, double& farthest) const;
    std::vector<Box> slices(const View& view, const std::vector<double>& edges) const;
    ShadowProjection around(const Box& box, int size, const ShadowFilter& filter) const;
    Box crop(const Box& seen) const;

    const Scene& scene_;
    glm::dvec3 pivot_;
    glm::dmat3 lightFromWorld_;
    Box casters_;
    double end_ = 0.0;  ///< farthest along the light of all that can be in shadow
};

}  // namespace lobe
