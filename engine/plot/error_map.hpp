/// How far a model's GLSL is from its double twin, over the angle of incidence and a parameter.
#pragma once

#include "plot/sampler.hpp"

namespace lobe::plot {

struct ErrorRequest {
    Model model;
    std::string over;            ///< a scalar parameter of the model; empty for the model as it is
    std::vector<double> values;  ///< of that parameter; one that is not used if `over` is empty
    std::vector<double> angles;  ///< of incidence, degrees
    double azimuth = 0.0;
};

/// The worst of kErrorViews directions of the eye and three channels.
struct ErrorCell {
    double value, angle;
    double ulp;    ///< |GLSL - twin| over the spacing of floats at the twin's value
    double share;  ///< of what the rounding of inputs allows (harness/comparison.hpp); above 1 is a failure
};

inline constexpr int kErrorViews = 32;

struct ErrorMap {
    ErrorRequest request;
    std::vector<ErrorCell> cells;  ///< by value, then by angle
    ErrorCell worstUlp{}, worstShare{};
};

/// Views are about the mirrored direction at distances of 0 to 5 widths of the lobe, and all over the
/// hemisphere, the same in every run. Throws UsageError for models that scatter no light, or for a sampler
/// that is the twin itself.
ErrorMap computeErrorMap(const Sampler& sampler, const ErrorRequest& request);

}  // namespace lobe::plot
