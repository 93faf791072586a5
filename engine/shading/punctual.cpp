#include "shading/punctual.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lobe {
namespace {

/// KHR_lights_punctual's floor for cos inner - cos outer: where it acts, the spot's edge is softer than the
/// cone.
constexpr double kMinConeWidth = 0.001;

double coneWidth(double innerConeAngle, double outerConeAngle) {
    return std::max(kMinConeWidth, std::cos(innerConeAngle) - std::cos(outerConeAngle));
}

}  // namespace

double rangeWindow(double distance2, std::optional<double> range) {
    if (!range) return 1.0;
    return std::clamp(1.0 - std::pow(std::sqrt(distance2) / *range, 4.0), 0.0, 1.0);
}

double distanceAttenuation(double distance2, std::optional<double> range) {
    return rangeWindow(distance2, range) / std::max(distance2, kMinDistance2);
}

double inverseRange2(std::optional<double> range) {
    if (!range) return 0.0;
    return std::min(1.0 / (*range * *range), static_cast<double>(std::numeric_limits<float>::max()));
}

double spotAttenuation(double cosTheta, double innerConeAngle, double outerConeAngle) {
    const double t = std::clamp(
        (cosTheta - std::cos(outerConeAngle)) / coneWidth(innerConeAngle, outerConeAngle), 0.0, 1.0);
    return t * t;
}

SpotScaleOffset spotScaleOffset(double innerConeAngle, double outerConeAngle) {
    const double scale = 1.0 / coneWidth(innerConeAngle, outerConeAngle);
    const double s = std::sin(outerConeAngle / 2.0);
    return {scale, 2.0 * s * s * scale};
}

}  // namespace lobe
