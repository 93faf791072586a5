/// Two reports held against each other: two versions, two drivers.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace lobe::measure {

/// Lines for people.
struct ReportChanges {
    std::vector<std::string> regressions, improvements;
    std::vector<std::string> notes;  ///< what could not be compared, and what differs besides
    size_t compared = 0;             ///< settings
};

/// Below this change of time nothing is said: where code happens to lie in memory changes as much
/// (Mytkowicz et al., ASPLOS 2009).
inline constexpr double kLeastChange = 0.05;

/// Scenes of equal name, camera and size, and their settings with equal knobs. A time has changed if the
/// intervals of the medians do not touch, and by kLeastChange at least; an error (root of relmse) if it did
/// by more than the standard errors of both truths together, which bounds what they can cause (triangle
/// inequality). Non-finite pixels where there were none are a regression. Throws InputError if nothing can be
/// compared.
ReportChanges compareReports(const nlohmann::json& now, const nlohmann::json& before);

}  // namespace lobe::measure
