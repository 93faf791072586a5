/// Command lines with settings as options.
#pragma once

#include <string>
#include <vector>

#include "command_line.hpp"
#include "shots.hpp"

namespace lobe::app {

/// One command's options. Add plain options to app(), then addSettings(), then parse().
class Arguments {
public:
    /// Of `program`'s `command`; without one, of the program.
    Arguments(const std::string& command, const std::string& description,
              const std::string& program = "lobe");
    CLI::App& app() { return line_.app(); }

    /// --key for every setting, -D, -R, -r W H, -o, --config, --settings, --no-config.
    void addSettings();

    /// Throws UsageError. Returns false after --help was printed.
    bool parse(const std::vector<std::string>& arguments);

    /// What the settings options said, in their order, and the configuration files to read.
    SettingSources sources() const;

private:
    std::vector<Assignment> assignments() const;

    CommandLine line_;
    std::string configFile_, settingsFile_;
    bool noConfig_ = false;
};

}  // namespace lobe::app
