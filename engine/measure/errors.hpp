/// How far a picture is from the truth, as reports hold it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image/metrics.hpp"

namespace lobe::measure {

struct PictureError {
    /// The object "error" of a setting in report.json. Edges apart from shading where the truth has layers
    /// for it (image/edges.hpp), else null; all null in a picture with a non-finite pixel, which are counted.
    nlohmann::json values;
    /// relmse; infinite in a picture with a non-finite pixel.
    double relativeSquare = 0.0;
    /// Root of the relative square error a pixel, as colours of viridis: 10^-4 dark to 1 bright, in equal
    /// ratios. A non-finite pixel counts as black.
    Bitmap map;
};
PictureError pictureError(const Image& test, const Image& truth);

/// All keys of errorJson, in the order of the columns of report.csv.
const std::vector<std::string>& errorColumns();

/// Those by which settings can be chosen.
const std::vector<std::string>& errorMetricNames();
/// PSNR and SSIM.
bool largerIsBetter(const std::string& metric);

}  // namespace lobe::measure
