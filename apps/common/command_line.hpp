/// Command lines through CLI11, with the nearest name for an unknown option.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace lobe::app {

/// One command's options. Add them to app(), then parse().
class CommandLine {
public:
    /// `name` as it is typed: "lobe render".
    CommandLine(const std::string& name, const std::string& description);
    CLI::App& app() { return app_; }
    const CLI::App& app() const { return app_; }

    /// Throws UsageError. Returns false after --help was printed.
    bool parse(std::vector<std::string> arguments);

private:
    std::vector<std::string> optionNames() const;
    CLI::App app_;
};

}  // namespace lobe::app
