#include "command_line.hpp"

#include <algorithm>
#include <iostream>

#include "base/closest_name.hpp"
#include "base/error.hpp"

namespace lobe::app {

CommandLine::CommandLine(const std::string& name, const std::string& description) : app_(description, name) {
    app_.allow_extras();  // unknown options are refused below, with the nearest name
    app_.get_formatter()->column_width(42);
}

std::vector<std::string> CommandLine::optionNames() const {
    std::vector<std::string> names;
    for (const CLI::Option* option : app_.get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    return names;
}

bool CommandLine::parse(std::vector<std::string> arguments) {
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
    try {
        app_.parse(arguments);
    } catch (const CLI::CallForHelp&) {
        std::cout << app_.help();
        return false;
    } catch (const CLI::ConversionError& error) {  // of flags: other options are taken as text
        throw UsageError(std::string(error.what()) + "; expected true or false");
    } catch (const CLI::ParseError& error) {
        throw UsageError(std::string(error.what()) + "; " + app_.get_name() + " --help shows how");
    }
    for (const std::string& extra : app_.remaining()) {
        if (extra == "--") continue;  // what follows are files, whatever they start with
        const std::string name = extra.substr(0, extra.find('='));
        if (extra.starts_with("-") && extra != "-")
            throw UsageError("unknown option " + name + didYouMean(name, optionNames()));
        throw UsageError("unexpected argument '" + extra + "'");
    }
    return true;
}

}  // namespace lobe::app
