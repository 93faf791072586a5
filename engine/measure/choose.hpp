/// From a report to the setting that is good enough, or fast enough.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "plan/quality.hpp"

namespace lobe::measure {

struct Goal {
    std::optional<double> maxError = {};  ///< of `metric`; the least that is wanted, where larger is better
    std::string metric = "relmse";
    std::optional<double> budget = {};  ///< ms a frame
};

struct Chosen {
    Quality quality;
    std::string label;
    double error = 0.0;  ///< to be expected, of the goal's metric
    double milliseconds =
        0.0;            ///< to be expected a frame: timer queries, or on the wall where there are none
    std::string basis;  ///< for people: what the expectation comes from
};

/// With a maximal error the fastest setting that keeps it; with a budget alone the least wrong that keeps
/// that; with both, the fastest, if it keeps both. Only settings that were measured are chosen. A scene that
/// the report holds (by content hash) is judged by its own entry; another one by the worst of all entries,
/// for which it is no promise. Times grow with the number of pixels. Throws UsageError that says the best
/// that can be had if nothing keeps the goal, or no setting has the metric.
Chosen choose(const nlohmann::json& report, const std::string& contentHash, double pixels, const Goal& goal);

/// "16ms", "16.7 ms", "0.5s" or "16" as milliseconds. Throws UsageError naming `option`.
double parseDuration(const std::string& option, const std::string& text);

}  // namespace lobe::measure
