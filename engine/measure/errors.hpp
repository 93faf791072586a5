/// How far a picture is from the truth, as reports hold it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image/image.hpp"

namespace lobe::measure {

/// Mean over pixels and R, G, B of (test - truth)^2 / (truth^2 + 0.01).
double relativeSquaredError(const Image& test, const Image& truth);

/// The object "error" of a setting in report.json.
nlohmann::json errorJson(const Image& test, const Image& truth);

/// All keys of errorJson, in the order of the columns of report.csv.
const std::vector<std::string>& errorColumns();

/// Metrics of errorJson by which settings can be chosen, of which less is better: "relmse", "rmse", ...
const std::vector<std::string>& errorMetricNames();

/// Relative difference a pixel as colours of viridis, from 10^-4 to 1 in equal ratios.
Bitmap differenceMap(const Image& test, const Image& truth);

}  // namespace lobe::measure
