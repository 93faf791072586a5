/// Renders a list of shots: scenes are loaded ahead on one thread, pictures encoded behind on others, and
/// OpenGL stays on the caller's.
#pragma once

#include <atomic>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "gl/context.hpp"
#include "outcome.hpp"
#include "reporter.hpp"
#include "shots.hpp"

namespace lobe::app {

struct PipelineOptions {
    gl::ContextRequest context;
    bool resume = false;  ///< leave out pictures that are there and were made the same way
    bool timePasses = false;
    /// Seconds that drawing one picture may take. Once they are over the pictures drawn before are written,
    /// and the program ends, with exit code 5 and the summary: a driver that loops can't be stopped.
    std::optional<double> drawLimit;
    const nlohmann::json* reproduced = nullptr;  ///< record that the picture should have again
};

/// Every shot ends in one outcome, in order, to `reporter`. Errors of single shots are outcomes; what
/// concerns all is thrown: ContextError if no context can be made, InputError without the helper programs,
/// OutputError if the reporter cannot report. Stops after the present shot once `interrupted` is set.
void runShots(const std::vector<Shot>& shots, const PipelineOptions& options, Reporter& reporter,
              const std::atomic<bool>& interrupted);

}  // namespace lobe::app
