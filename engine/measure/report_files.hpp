/// The files of a report besides its page.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace lobe::measure {

inline constexpr int kReportSchema = 1;

/// One line a setting of each scene (docs/report.md).
std::string reportCsv(const nlohmann::json& report);

/// PNG of error against time of all scenes, with their fronts; logarithmic axes. Throws as
/// plot::runGnuplot does.
std::string reportChart(const nlohmann::json& report, const std::string& metric, int width, int height);

/// PNG of what measureCost() gave, a scene a line, with the fitted curves; logarithmic axes. Throws likewise.
std::string costChart(const nlohmann::json& costs, int width, int height);

/// A report read back. Throws InputError for what is none, or of another schema.
nlohmann::json readReport(const std::filesystem::path& file);

}  // namespace lobe::measure
