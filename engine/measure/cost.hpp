/// How run time grows with something: time = constant + factor n^exponent.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "measure/scene_report.hpp"

namespace lobe::measure {

struct PowerLaw {
    double constant = 0.0, factor = 0.0;  ///< ms, neither negative
    double exponent = 0.0;                ///< 0 to 3
    Interval exponentInterval;            ///< percentile bootstrap over rounds
    double misfit = 0.0;                  ///< root mean square of the relative distance from the points
    double at(double n) const;
};

/// Least squares of relative distances from the medians over rounds. `times[i]` are the rounds of counts[i],
/// as many for each. At least 3 counts that differ.
PowerLaw fitPowerLaw(const std::vector<double>& counts, const std::vector<std::vector<double>>& times,
                     double confidence = 0.95);

const std::vector<std::string>& costNames();  ///< lights, pixels, triangles, materials

/// The scene with more and more of `what`, measured in turn: {"what", "scene", "points", "fit"} of
/// docs/report.md. Throws UsageError for a scene without any of it.
nlohmann::json measureCost(gl::Context& context, const ReportScene& scene, const Quality& quality,
                           const std::string& what, double seconds, const ReportEvents& events);

}  // namespace lobe::measure
