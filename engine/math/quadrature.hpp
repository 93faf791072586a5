/// Gauss-Legendre quadrature on intervals and on the sphere's polar coordinates about any axis.
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

/// Integral over all directions of f(w) dw in polar coordinates about the unit `axis`: panels of the polar
/// angle between successive `polarBreaks` (radians, from 0 to pi for the whole sphere), `azimuthPanels` equal
/// panels around. For lobes: put the axis on the peak and grade the breaks towards 0.
double integrateSphere(const std::function<double(const glm::dvec3&)>& f, const glm::dvec3& axis,
                       std::span<const double> polarBreaks, int azimuthPanels, const QuadratureRule& rule);

/// 0, then `count` angles in geometric progression from `first` to pi.
std::vector<double> gradedPolarBreaks(double first, int count);

}  // namespace lobe
