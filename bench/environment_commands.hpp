#pragma once

#include <CLI/CLI.hpp>

namespace lobe::bench {

/// `lobe-bench environment`: what environments cost, and how far off each method is.
void addEnvironmentCommand(CLI::App& app);

}  // namespace lobe::bench
