#include "arguments.hpp"

#include <iostream>

#include "base/closest_name.hpp"
#include "base/error.hpp"

namespace lobe::app {
namespace {

std::string helpText(const Setting& setting) {
    std::string text = setting.help;
    if (!setting.defaultValue.is_null()) {
        const auto& value = setting.defaultValue;
        std::string shown = value.is_string() ? value.get<std::string>() : value.dump();
        std::erase_if(shown, [](char c) { return c == '[' || c == ']' || c == '"'; });
        text += " [" + shown + "]";
    }
    return text;
}

}  // namespace

Arguments::Arguments(const std::string& command, const std::string& description) : app_(description, "lobe " + command) {
    app_.allow_extras();  // unknown options are refused below, with the nearest name
    app_.get_formatter()->column_width(42);
}

void Arguments::addSettings() {
    for (const Setting& setting : settingTable()) {
        std::string names = setting.flag();
        if (setting.key == "output") names += ",-o";
        const std::string help = helpText(setting);
        app_.add_option(names, help)
            ->type_name(setting.valueName())
            ->group(setting.group)
            ->expected(1)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
            ->allow_extra_args(false);
    }
    const std::string sizeHelp = "picture size as two numbers";
    const std::string setHelp = "set any setting by its key; may be repeated";
    const std::string resetHelp = "reset a setting to its default; may be repeated";
    app_.add_option("-r", sizeHelp)->type_name("W H")->expected(2)->group("Output");
    app_.add_option("-D", setHelp)
        ->type_name("KEY=VALUE")
        ->group("Settings")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
    app_.add_option("-R", resetHelp)
        ->type_name("KEY")
        ->group("Settings")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
    app_.add_option("--config", configFile_, "configuration file, after the system's and the user's")->group("Settings");
    app_.add_option("--settings", settingsFile_, "settings file, after all configuration")->group("Settings");
    app_.add_flag("--no-config", noConfig_, "read no configuration of the system or the user")->group("Settings");
}

std::vector<std::string> Arguments::optionNames() const {
    std::vector<std::string> names;
    for (const CLI::Option* option : app_.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

bool Arguments::parse(const std::vector<std::string>& arguments) {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    try {
        app_.parse(reversed);
    } catch (const CLI::CallForHelp&) {
        std::cout << app_.help();
        return false;
    } catch (const CLI::ParseError& error) {
        throw UsageError(std::string(error.what()) + "; lobe --help shows how");
    }
    for (const std::string& extra : app_.remaining()) {
        const std::string name = extra.substr(0, extra.find('='));
        if (extra.starts_with("-") && extra != "-") throw UsageError("unknown option " + name + didYouMean(name, optionNames()));
        throw UsageError("unexpected argument '" + extra + "'");
    }
    return true;
}

std::vector<Assignment> Arguments::assignments() const {
    // parse_order() has an option once for each time it was given; results() has its values in the same order.
    std::map<const CLI::Option*, size_t> used;
    std::vector<Assignment> result;
    for (const CLI::Option* option : app_.parse_order()) {
        const size_t index = used[option]++;
        const std::vector<std::string> values = option->results();
        if (option->check_name("-r")) {
            if (2 * index + 1 < values.size())
                result.push_back({Assignment::Kind::set, "resolution", values[2 * index] + "," + values[2 * index + 1]});
            continue;
        }
        if (option->get_group() == "Settings" || option->check_name("-D")) {
            if (index >= values.size()) continue;
            if (option->check_name("-R")) result.push_back({Assignment::Kind::reset, values[index], {}});
            if (!option->check_name("-D")) continue;
            const size_t equals = values[index].find('=');
            if (equals == std::string::npos) throw UsageError("-D " + values[index] + "; expected KEY=VALUE");
            result.push_back({Assignment::Kind::set, values[index].substr(0, equals), values[index].substr(equals + 1)});
            continue;
        }
        for (const Setting& setting : settingTable())
            if (option->check_lname(setting.flag().substr(2)) && index < values.size())
                result.push_back({Assignment::Kind::set, setting.key, values[index]});
    }
    return result;
}

SettingSources Arguments::sources() const {
    SettingSources sources;
    if (!noConfig_) sources.configs = standardConfigs();
    if (!configFile_.empty()) sources.configs.emplace_back(readJsonFile(configFile_), configFile_);
    if (!settingsFile_.empty()) sources.configs.emplace_back(readJsonFile(settingsFile_), settingsFile_);
    sources.assignments = assignments();
    return sources;
}

}  // namespace lobe::app
