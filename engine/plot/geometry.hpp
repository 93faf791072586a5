/// Directions of plots. Angles in degrees; the plane of incidence is turned by `azimuth` from the tangent.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace lobe::plot {

/// To the light, which comes from the left: at `incidence` from the normal, 0 to below 90.
glm::dvec3 toLight(double incidence, double azimuth);

/// To the eye, in the plane of incidence: -90 to 90, positive on the side of the mirrored direction.
glm::dvec3 toEye(double angle, double azimuth);

/// `w` mirrored at the normal.
glm::dvec3 mirrored(const glm::dvec3& w);

/// `count` >= 2 values from `first` to `last`, both included, in arithmetic progression.
std::vector<double> linearSteps(double first, double last, int count);
/// In geometric progression; both ends above 0.
std::vector<double> geometricSteps(double first, double last, int count);

/// To so many significant digits.
double rounded(double value, int digits);

/// Whether values from `low` to `high` are better taken in equal ratios than in equal steps.
bool isWide(double low, double high);

/// Throws UsageError unless 0 <= incidence <= 89.9.
void requireIncidence(double incidence);

}  // namespace lobe::plot
