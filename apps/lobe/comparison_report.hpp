/// What lobe compare finds, as a table and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image/metrics.hpp"

namespace lobe::app {

/// Some of the pixels, or some of the light.
struct ComparedPart {
    std::string kind;  ///< all, edges, shading, light or material
    std::string name;  ///< of the light type, or the material's index in its file
    ErrorMetrics metrics;
};

/// A threshold on a metric of the whole picture.
struct Threshold {
    Metric metric;
    double value;
    bool isMinimum;  ///< the metric has to be at least the value, else at most
};
bool holds(const Threshold& threshold, const ErrorMetrics& whole);

struct ComparisonReport {
    std::string test, truth;
    int width = 0, height = 0;
    bool display = false;
    std::vector<Metric> shown;
    std::vector<ComparedPart> parts;  ///< the whole picture first
    std::vector<Threshold> thresholds;
    std::vector<std::string> notes;
};

std::string toText(const ComparisonReport& report);
/// Schema 1 (docs/compare.md). An infinite PSNR is null.
nlohmann::ordered_json toJson(const ComparisonReport& report);

}  // namespace lobe::app
