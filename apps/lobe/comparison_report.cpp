#include "comparison_report.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace lobe::app {
namespace {

using nlohmann::ordered_json;

const std::string& nameOf(Metric metric) {
    return metricNames()[static_cast<size_t>(metric)];
}

std::string titleOf(const ComparedPart& part) {
    return part.name.empty() ? part.kind : part.kind + " " + part.name;
}

std::string nonFiniteText(const std::string& file, const NonFinite& bad) {
    if (bad.pixels == 0) return "";
    return file + ": " + std::to_string(bad.pixels) + " non-finite pixels, the first at " +
           std::to_string(bad.firstX) + "," + std::to_string(bad.firstY) + " in " + bad.firstChannel + '\n';
}

}  // namespace

bool holds(const Threshold& threshold, const ErrorMetrics& whole) {
    const std::optional<double> value = whole[threshold.metric];
    if (!value) return false;
    return threshold.isMinimum ? *value >= threshold.value : *value <= threshold.value;
}

std::string toText(const ComparisonReport& report) {
    std::ostringstream text;
    const ErrorMetrics& whole = report.parts.front().metrics;
    text << nonFiniteText(report.test, whole.testNonFinite)
         << nonFiniteText(report.truth, whole.truthNonFinite);
    if (whole.pixels > 0) {
        text << std::left << std::setw(18) << "" << std::right << std::setw(10) << "pixels";
        for (const Metric metric : report.shown)
            text << "  " << std::setw(std::max(10, static_cast<int>(nameOf(metric).size())))
                 << nameOf(metric);
        text << '\n';
        for (const ComparedPart& part : report.parts) {
            text << std::left << std::setw(18) << titleOf(part) << std::right << std::setw(10)
                 << part.metrics.pixels;
            for (const Metric metric : report.shown) {
                text << "  " << std::setw(std::max(10, static_cast<int>(nameOf(metric).size())));
                if (const std::optional<double> value = part.metrics[metric])
                    text << std::setprecision(4) << *value;
                else
                    text << "-";
            }
            text << '\n';
        }
    }
    for (const Threshold& threshold : report.thresholds)
        text << (holds(threshold, whole) ? "holds: " : "FAILS: ") << nameOf(threshold.metric)
             << (threshold.isMinimum ? " >= " : " <= ") << threshold.value << '\n';
    for (const std::string& note : report.notes)
        text << "note: " << note << '\n';
    return text.str();
}

ordered_json toJson(const ComparisonReport& report) {
    const ErrorMetrics& whole = report.parts.front().metrics;
    ordered_json json = {
        {"schema", 1},
        {"test", report.test},
        {"truth", report.truth},
        {"resolution", {report.width, report.height}},
        {"values", report.display ? "display" : "radiance"},
        {"non_finite_pixels", {{"test", whole.testNonFinite.pixels}, {"truth", whole.truthNonFinite.pixels}}},
        {"parts", ordered_json::array()},
        {"thresholds", ordered_json::array()},
        {"notes", report.notes}};
    for (const ComparedPart& part : report.parts) {
        ordered_json entry = {{"kind", part.kind}};
        if (!part.name.empty()) entry["name"] = part.name;
        entry["pixels"] = part.metrics.pixels;
        entry["metrics"] = ordered_json::object();
        for (const Metric metric : report.shown)
            if (const std::optional<double> value = part.metrics[metric])
                entry["metrics"][nameOf(metric)] = std::isfinite(*value) ? ordered_json(*value) : nullptr;
        json["parts"].push_back(entry);
    }
    for (const Threshold& threshold : report.thresholds)
        json["thresholds"].push_back({{"metric", nameOf(threshold.metric)},
                                      {threshold.isMinimum ? "minimum" : "maximum", threshold.value},
                                      {"holds", holds(threshold, whole)}});
    return json;
}

}  // namespace lobe::app
