/// The subcommands of lobe-bench.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lobe::bench {

/// Adds them all; each runs as soon as it is parsed.
void addCommands(CLI::App& app);

/// Nothing where `file` is empty.
void writeJson(const std::string& file, const nlohmann::json& report);

}  // namespace lobe::bench
