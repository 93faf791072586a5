/// Cosine powers under linear maps: the shapes that lobes of reflectance models are fitted with.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace lobe::fit {

/// Where the eye is, as a fit sees it: in the plane of incidence y = 0, at x >= 0. Columns of `frame` are the
/// axes that transformed lobes are given in: across the mirrored direction in the plane of incidence,
/// perpendicular to that plane, and the mirrored direction.
struct View {
    glm::dvec3 wo;
    glm::dmat3 frame;

    /// `oneMinusCos` = 1 - N.V, in 0..1.
    explicit View(double oneMinusCos);
};

/// The density D(w) = (k + 1) / (2 pi) cos^k(v) |det N| / |N w|^3, v = N w / |N w|, where v.z > 0, else 0: a
/// cosine power about +z, of integral 1, mapped by M = N^-1 (Heitz et al., ACM TOG 35(4), 2016, with k = 1).
///   N = (a 0 b; 0 c 0; d 0 1) in the view's frame, a, c > 0.
struct TransformedLobe {
    double a = 1.0, b = 0.0, c = 1.0, d = 0.0;
    double k = 1.0;  ///< at least 0

    /// N w for w in the view's frame.
    glm::dvec3 map(const glm::dvec3& w) const { return {a * w.x + b * w.z, c * w.y, d * w.x + w.z}; }
    /// D for w in the view's frame, in 1/sr.
    double density(const glm::dvec3& w) const;
};

/// The part of a convex polygon where dot(w, normal) >= 0.
std::vector<glm::dvec3> clipped(std::span<const glm::dvec3> polygon, const glm::dvec3& normal);

/// Integral of the density over the directions in which the origin sees a convex polygon, its vertices not
/// normalised and in the view's frame: the twin of the sums about the boundary in
/// light/transformed_lobe.glsl, with quadrature of high order. Positive for vertices that run
/// counter-clockwise as the origin sees them.
double polygonIntegral(const TransformedLobe& lobe, std::span<const glm::dvec3> polygon);

}  // namespace lobe::fit
