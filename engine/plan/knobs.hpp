/// The quality knobs as a list: settings, sweeps, reports and documentation follow from it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "plan/quality.hpp"
#include "plan/summary.hpp"

namespace lobe {

/// One thing about quality that can be turned. A new knob is one entry of knobTable() beside its field of
/// Quality.
struct Knob {
    std::string name;   ///< as a setting: "anti_aliasing"
    std::string title;  ///< for charts: "Anti-aliasing"
    std::string help;   ///< one line, for --help and documentation
    /// What sweeps try, from cheap to good; also all that can be set, unless there is a range.
    std::vector<std::string> values;
    std::optional<std::pair<int, int>> range;  ///< every whole number in it can be set
    std::string (*get)(const Quality&);
    void (*set)(Quality&, const std::string& value);  ///< of an allowed value
    /// Why the knob changes nothing in a picture of this scene made with this quality; empty if it may.
    std::string (*withoutEffect)(const SceneSummary&, const Quality&);
};

const std::vector<Knob>& knobTable();
std::vector<std::string> knobNames();
/// Throws UsageError with the nearest name.
const Knob& requireKnob(const std::string& name);

/// Sets a knob by name. Throws UsageError for a name or a value that does not exist.
void setKnob(Quality& quality, const std::string& name, const std::string& value);

/// Every knob's value, in the order of the table.
std::vector<std::pair<std::string, std::string>> knobValues(const Quality& quality);

}  // namespace lobe
