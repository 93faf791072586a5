/// Batch files: many shots of many scenes (docs/batch.md).
#pragma once

#include "shots.hpp"

namespace lobe::app {

/// Throws InputError for a file that cannot be read, UsageError for one that says what it must not. A scene
/// that is missing fails when it is its turn, and not the batch.
std::vector<Shot> shotsOfBatch(const std::filesystem::path& file, const SettingSources& sources);

}  // namespace lobe::app
