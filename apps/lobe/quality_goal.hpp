/// Quality chosen by what it gives (--max-error) or costs (--budget), in place of knobs.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "gl/context.hpp"
#include "measure/choose.hpp"
#include "shots.hpp"

namespace CLI {
class App;
}

namespace lobe::app {

struct QualityGoal {
    double maxError = 0.0;  ///< 0: not set
    std::string metric = "relmse", budget, report;

    void addOptions(CLI::App& app);
    bool isSet() const { return maxError > 0.0 || !budget.empty(); }
    measure::Goal goal() const;
};

/// Throws UsageError if the command line sets a quality knob; `why` says what chooses it instead.
void requireNoKnobs(const SettingSources& sources, const std::string& why);

/// Sets the knobs of each shot as the goal asks: from the report if one is given, else after a quick
/// calibration on a small picture of the shot's scene. Says on standard error what was chosen and what to
/// expect, unless `quiet`. Throws UsageError for a goal out of reach. Stops early once `interrupted`.
void applyGoal(std::vector<Shot>& shots, const QualityGoal& goal, const gl::ContextRequest& request,
               bool quiet, const std::atomic<bool>& interrupted);

}  // namespace lobe::app
