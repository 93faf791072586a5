/// Command lines through CLI11, with settings as options and the nearest name for unknown ones.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "shots.hpp"

namespace lobe::app {

/// One command's options. Add plain options to app(), then addSettings(), then parse().
class Arguments {
public:
    Arguments(const std::string& command, const std::string& description);
    CLI::App& app() { return app_; }

    /// --key for every setting, -D, -R, -r W H, -o, --config, --settings, --no-config.
    void addSettings();

    /// Throws UsageError. Returns false after --help was printed.
    bool parse(const std::vector<std::string>& arguments);

    /// What the settings options said, in their order, and the configuration files to read.
    SettingSources sources() const;

private:
    std::vector<std::string> optionNames() const;
    std::vector<Assignment> assignments() const;

    CLI::App app_;
    std::string configFile_, settingsFile_;
    bool noConfig_ = false;
};

}  // namespace lobe::app
