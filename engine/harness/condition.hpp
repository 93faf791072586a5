/// How much the rounding of a model's inputs alone must change its value: the yardstick of every tolerance.
#pragma once

#include <glm/glm.hpp>

#include "math/ulp.hpp"
#include "shading/brdf.hpp"

namespace lobe::harness {

/// Condition numbers of f_r cos for each colour channel, by differences on the twin; 0 where f is
/// 0.
struct Condition {
    /// sum over the components x of both directions of |x df/dx| / f: what relative rounding of each
    /// component costs. Small at grazing angles, where a float still holds the cosine to 24 bits.
    glm::dvec3 componentwise{0.0};
    /// (|grad_wi f| + |grad_wo f|) / f per radian: what rounding of directions in other axes costs.
    glm::dvec3 angular{0.0};
    /// sum over both directions of |df/de| / f, e the departure of its length from 1, of which the half
    /// vector takes part, and the direction itself where the model says so (BrdfTraits::anglesOnly): what
    /// unit vectors that are unit only to float rounding cost.
    glm::dvec3 length{0.0};
    /// sum over the parameters p of |q df/dp| / f, q = |p|, or 1 - p where that is smaller and the range ends
    /// at 1: 1 - p is exact in floats where p is near 1.
    glm::dvec3 parameters{0.0};
    /// (sum of the absolute values of the terms) / f, at least 1: what the roundings of terms that cancel
    /// cost.
    glm::dvec3 terms{1.0};
};

/// Differences over `step`, relative, absolute for angles. The default is a few roundings of a float, rather
/// than the limit, so that the top of a narrow lobe, where the slope vanishes, counts with its curvature.
Condition conditionOf(const Brdf& brdf, const Directions& d, std::span<const double> values,
                      double step = 4.0 * kFloatRounding);

}  // namespace lobe::harness
