/// Gauss-Legendre quadrature on intervals and on the hemisphere.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace lobe {

/// Nodes in (-1, 1), ascending, and their weights, which sum to 2. Exact for polynomials up to degree 2 n
/// - 1.
struct QuadratureRule {
    std::vector<double> nodes;
    std::vector<double> weights;
};

/// The rule of n >= 1 points, to the last few digits of double.
QuadratureRule gaussLegendre(int n);

/// Integral over the panels between successive `breaks`, each with the same rule.
double integratePanels(const std::function<double(double)>& f, std::span<const double> breaks,
                       const QuadratureRule& rule);

/// 0, then `count` values in geometric progression from `first` to `last`.
std::vector<double> gradedBreaks(double first, double last, int count);

/// Integral over the upper hemisphere (z > 0) of f(w) dw, in polar coordinates about the unit `axis`, which
/// must lie in it: `azimuthPanels` equal panels around; between axis and horizon the given `polarBreaks`, as
/// fractions from 0 to 1 of that angle. The horizon bounds the panels, so that f may jump there. For lobes:
/// put the axis on the peak and grade the breaks towards 0.
double integrateHemisphere(const std::function<double(const glm::dvec3&)>& f, const glm::dvec3& axis,
                           std::span<const double> polarBreaks, int azimuthPanels,
                           const QuadratureRule& rule);

}  // namespace lobe
