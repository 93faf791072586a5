#include "plot/fit_errors.hpp"

#include <cmath>

#include "base/error.hpp"
#include "fit/table_cache.hpp"

namespace lobe::plot {

FitErrors computeFitErrors(const FitErrorsRequest& request) {
    FitErrors result{request, {}};
    std::vector<fit::TableRequest> tables;
    for (double value : request.values) {
        const Model model =
            request.over.empty() ? request.model : withParameter(request.model, request.over, value);
        tables.push_back({model.brdf, model.values});
        if (const auto reason = fit::refusal(tables.back()))
            throw UsageError(model.brdf->name + ": its lights with a body are sampled: " + *reason);
        if (model.brdf->area->terms == 0)
            throw UsageError(model.brdf->name + ": is in closed form; expected a model with a lobe");
    }
    const std::vector<fit::AreaTable> fitted = fit::TableCache().tables(tables);
    for (size_t v = 0; v < tables.size(); ++v) {
        std::vector<fit::DiscError> row;
        for (double angle : request.angles) {
            const double sine = std::sin(0.5 * glm::radians(angle));
            row.push_back(fit::discError(tables[v], fitted[v], 2.0 * sine * sine));
        }
        result.errors.push_back(std::move(row));
    }
    return result;
}

}  // namespace lobe::plot
