/// Double-precision twins of light/*.glsl: irradiance on a facing surface from punctual lights
/// (KHR_lights_punctual; docs/models/lights.md).
#pragma once

#include <optional>

namespace lobe {

/// Window of a light's range: max(1 - (d/range)^4, 0); 1 without range. `distance2` = d^2 in m^2.
double rangeWindow(double distance2, std::optional<double> range);

/// Inverse square law with window: 1/m^2. d^2 is kept above kMinDistance2.
double distanceAttenuation(double distance2, std::optional<double> range);
inline constexpr double kMinDistance2 = 1e-12;

/// 1 / range^2 as the GLSL form takes it, never infinite as a float; 0 without range.
double inverseRange2(std::optional<double> range);

/// Spot falloff in 0..1: clamp((cos theta - cos outer) / max(0.001, cos inner - cos outer), 0, 1)^2.
double spotAttenuation(double cosTheta, double innerConeAngle, double outerConeAngle);

/// The two numbers that the GLSL form takes: attenuation = clamp(offset - scale * (1 - cos theta), 0, 1)^2,
/// where 1 - cos theta comes from |axis + wi|^2 / 2 and keeps its digits in narrow cones.
struct SpotScaleOffset {
    double scale;
    double offset;
};
SpotScaleOffset spotScaleOffset(double innerConeAngle, double outerConeAngle);

}  // namespace lobe
