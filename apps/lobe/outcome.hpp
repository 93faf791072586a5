/// What became of a shot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "image/image.hpp"
#include "passes/renderer.hpp"
#include "shots.hpp"

namespace lobe::app {

struct Outcome {
    Shot shot;
    bool skipped = false;  ///< --resume: was there already
    std::optional<ExitCode> error;
    std::string message;  ///< of the error
    std::string camera;
    double loadMs = 0.0, uploadMs = 0.0, renderMs = 0.0, encodeMs = 0.0;
    std::vector<PassTime> passes;
    NonFinite nonFinite;
    std::vector<std::string> warnings;
};

/// One line of JSON, schema 1 (docs/cli.md).
std::string toJson(const Outcome& outcome, const std::string& backend, const std::string& renderer);

/// Largest resident memory of this process so far, MiB.
double peakMemoryMib();

}  // namespace lobe::app
