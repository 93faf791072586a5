/// Where and when a report was made.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "gl/context.hpp"
#include "measure/timing.hpp"

namespace lobe::measure {

/// cpu, cores, memory_bytes, os, load (of the last minute).
nlohmann::json machineJson();

/// backend, renderer, version, driver, clock.
nlohmann::json contextJson(const gl::ContextInfo& info, Clock clock);

/// Now, as 2026-01-31T12:00:00Z.
std::string utcNow();

}  // namespace lobe::measure
