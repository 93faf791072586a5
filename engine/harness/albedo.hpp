/// Directional albedo of a model's twin by quadrature.
#pragma once

#include "shading/brdf.hpp"

namespace lobe::harness {

struct Albedo {
    double value;
    double error;  ///< difference from half as many nodes
};

/// Integral of f_r cos over the light's directions for an eye at `cosine` from the normal, in one channel:
/// polar coordinates about the mirrored direction, panels graded from a hundredth of the lobe's width.
Albedo albedo(const Brdf& brdf, const ParameterValues& values, double cosine, int channel = 0);

}  // namespace lobe::harness
