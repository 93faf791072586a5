#include "arguments.hpp"

#include "base/error.hpp"

namespace lobe::app {
namespace {

std::string helpText(const Setting& setting) {
    const std::string shown = setting.defaultText();
    return setting.help + (shown.empty() ? "" : " [" + shown + "]") +
           (setting.unit.empty() ? "" : ", " + setting.unit);
}

bool isWholeNumber(const std::string& text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

/// "-r W H" as "-r W,H".
std::vector<std::string> withSizesJoined(const std::vector<std::string>& arguments) {
    std::vector<std::string> result;
    for (size_t i = 0; i < arguments.size(); ++i) {
        result.push_back(arguments[i]);
        const bool isSize = arguments[i] == "-r" || arguments[i] == "--resolution";
        if (isSize && i + 2 < arguments.size() && isWholeNumber(arguments[i + 1]) &&
            isWholeNumber(arguments[i + 2])) {
            result.push_back(arguments[i + 1] + "," + arguments[i + 2]);
            i += 2;
        }
    }
    return result;
}

}  // namespace

Arguments::Arguments(const std::string& command, const std::string& description, const std::string& program)
    : line_(command.empty() ? program : program + " " + command, description) {}

void Arguments::addSettings() {
    for (const Setting& setting : settingTable()) {
        std::string names = setting.flag();
        if (setting.key == "output") names += ",-o";
        if (setting.key == "resolution") names += ",-r";
        const std::string help = helpText(setting);
        app()
            .add_option(names, help)
            ->type_name(setting.valueName())
            ->group(setting.group)
            ->expected(1)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
            ->allow_extra_args(false);
    }
    const std::string setHelp = "set any setting by its key; may be repeated";
    const std::string resetHelp = "reset a setting to its default; may be repeated";
    app()
        .add_option("-D", setHelp)
        ->type_name("KEY=VALUE")
        ->group("Settings")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
    app()
        .add_option("-R", resetHelp)
        ->type_name("KEY")
        ->group("Settings")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
    app()
        .add_option("--config", configFile_, "configuration file, after the system's and the user's")
        ->group("Settings");
    app()
        .add_option("--settings", settingsFile_, "settings file, after all configuration")
        ->group("Settings");
    app()
        .add_flag("--no-config", noConfig_, "read no configuration of the system or the user")
        ->group("Settings");
}

bool Arguments::parse(const std::vector<std::string>& arguments) {
    return line_.parse(withSizesJoined(arguments));
}

std::vector<Assignment> Arguments::assignments() const {
    // parse_order() has an option once for each time it was given; results() has its values in the same
    // order.
    std::map<const CLI::Option*, size_t> used;
    std::vector<Assignment> result;
    for (const CLI::Option* option : line_.app().parse_order()) {
        const size_t index = used[option]++;
        const std::vector<std::string> values = option->results();
        if (option->get_group() == "Settings" || option->check_name("-D")) {
            if (index >= values.size()) continue;
            if (option->check_name("-R")) result.push_back({Assignment::Kind::reset, values[index], {}});
            if (!option->check_name("-D")) continue;
            const size_t equals = values[index].find('=');
            if (equals == std::string::npos) throw UsageError("-D " + values[index] + "; expected KEY=VALUE");
            result.push_back(
                {Assignment::Kind::set, values[index].substr(0, equals), values[index].substr(equals + 1)});
            continue;
        }
        for (const Setting& setting : settingTable()) {
            if (!option->check_lname(setting.flag().substr(2)) || index >= values.size()) continue;
            const bool several = setting.type == SettingType::files || setting.type == SettingType::pairs;
            if (!several)
                result.push_back({Assignment::Kind::set, setting.key, values[index]});
            else if (index == 0)  // the first time stands for all
                result.push_back({Assignment::Kind::set, setting.key, values});
        }
    }
    return result;
}

SettingSources Arguments::sources() const {
    SettingSources sources;
    sources.assignments = assignments();
    for (const Assignment& assignment : sources.assignments)  // first: configurations may name their models
        if (assignment.kind == Assignment::Kind::set && assignment.key == "brdf_file")
            Settings().set(assignment.key, assignment.value, "command line");
    if (!noConfig_) sources.configs = standardConfigs();
    if (!configFile_.empty()) sources.configs.push_back(configFrom(configFile_));
    if (!settingsFile_.empty()) sources.configs.push_back(configFrom(settingsFile_));
    return sources;
}

}  // namespace lobe::app
