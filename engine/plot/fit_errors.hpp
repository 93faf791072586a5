/// How far the fits that lights with a body are reflected by are from their model, over angle of view and
/// width.
#pragma once

#include "fit/disc_error.hpp"
#include "plot/sampler.hpp"

namespace lobe::plot {

struct FitErrorsRequest {
    Model model;
    std::string over;            ///< a scalar parameter of the model; empty for the model as it is
    std::vector<double> values;  ///< of that parameter; one that is not used if `over` is empty
    std::vector<double> angles;  ///< of view, degrees
};

/// errors[v][a] for values[v] and angles[a].
struct FitErrors {
    FitErrorsRequest request;
    std::vector<std::vector<fit::DiscError>> errors;
};

/// Each width has a fit of its own, as a material with constant parameters. Throws UsageError with the reason
/// for models and values that nothing is fitted for.
FitErrors computeFitErrors(const FitErrorsRequest& request);

}  // namespace lobe::plot
