/// Distance between floating-point numbers in units of the last place.
#pragma once

#include <cstdint>

namespace lobe {

/// Number of representable values from `a` to `b`; -0 and +0 are one value. The largest number there is if
/// either is NaN.
uint64_t ulpDistance(float a, float b);
uint64_t ulpDistance(double a, double b);

/// Half the gap between 1 and the next float: the relative error of one correctly rounded float operation.
inline constexpr double kFloatRounding = 0x1p-24;

}  // namespace lobe
