// Values of settings: from text and JSON to one canonical form.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "model_files.hpp"
#include "settings.hpp"
#include "shading/brdf.hpp"

namespace lobe::app {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const Setting& setting, const json& given, const std::string& where,
                         const std::string& expected) {
    const std::string value = given.is_string() ? given.get<std::string>() : given.dump();
    throw UsageError(where + ": " + setting.key + " '" + value + "'; expected " + expected);
}

std::vector<std::string> split(const std::string& text, const char* separators) {
    std::vector<std::string> parts;
    for (size_t start = 0; start <= text.size();) {
        const size_t end = std::min(text.find_first_of(separators, start), text.size());
        parts.push_back(text.substr(start, end - start));
        start = end + 1;
    }
    return parts;
}

std::optional<double> number(const std::string& text) {
    double value = 0.0;
    const bool plus = text.starts_with("+") && !text.starts_with("+-");
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + (plus ? 1 : 0), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value)) return {};
    return value;
}

json parseNumber(const Setting& setting, const json& given, const std::string& where) {
    const bool whole = setting.type == SettingType::integer;
    const std::string expected =
        std::string(whole ? "a whole number" : "a number") + " from " + setting.allowed();
    std::optional<double> value;
    if (given.is_number()) value = given.get<double>();
    if (given.is_string()) value = number(given.get<std::string>());
    if (!value || *value < setting.minimum || *value > setting.maximum ||
        (whole && *value != std::floor(*value)))
        refuse(setting, given, where, expected);
    return whole ? json(static_cast<int64_t>(*value)) : json(*value);
}

std::vector<double> numbers(const Setting& setting, const json& given, const std::string& where, size_t count,
                            const char* separators, const std::string& expected) {
    std::vector<double> values;
    if (given.is_array()) {
        for (const json& item : given) {
            if (!item.is_number()) refuse(setting, given, where, expected);
            values.push_back(item.get<double>());
        }
    } else if (given.is_string()) {
        for (const std::string& part : split(given.get<std::string>(), separators)) {
            const auto value = number(part);
            if (!value) refuse(setting, given, where, expected);
            values.push_back(*value);
        }
    }
    if (values.size() != count) refuse(setting, given, where, expected);
    return values;
}

json parseResolution(const Setting& setting, const json& given, const std::string& where) {
    const std::string expected = "width and height from 1 to 16384, as 1280,720 or 1280x720";
    const std::vector<double> size = numbers(setting, given, where, 2, ",xX", expected);
    for (const double side : size)
        if (side != std::floor(side) || side < 1 || side > 16384) refuse(setting, given, where, expected);
    return {static_cast<int>(size[0]), static_cast<int>(size[1])};
}

json parseColour(const Setting& setting, const json& given, const std::string& where) {
    const std::string expected = "transparent, #rrggbb, or R,G,B each from 0 to 1";
    if (given.is_string() && given == "transparent") return given;
    if (given.is_string() && given.get<std::string>().starts_with("#")) {
        const std::string text = given.get<std::string>();
        unsigned code = 0;
        const char* end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data() + 1, end, code, 16);
        if (text.size() != 7 || error != std::errc() || stop != end) refuse(setting, given, where, expected);
        return {(code >> 16) / 255.0, ((code >> 8) & 255) / 255.0, (code & 255) / 255.0};
    }
    const std::vector<double> rgb = numbers(setting, given, where, 3, ",", expected);
    for (const double value : rgb)
        if (value < 0.0 || value > 1.0) refuse(setting, given, where, expected);
    return rgb;
}

std::string listText(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

void requireChoice(const Setting& setting, const std::string& value, const json& given,
                   const std::string& where) {
    // Models can be loaded while settings are read.
    const std::vector<std::string> choices = setting.key == "brdf" ? brdfNames() : setting.choices;
    if (std::find(choices.begin(), choices.end(), value) != choices.end()) return;
    refuse(setting, given, where, "one of " + listText(choices) + didYouMean(value, choices));
}

/// Names of files, whose models are registered at once, so that other settings can name them.
json parseFiles(const Setting& setting, const json& given, const std::string& where) {
    json files = given.is_array() ? given : json::array({given});
    if (files.empty()) refuse(setting, given, where, "a file or a list of files");
    for (const json& file : files) {
        if (!file.is_string() || file.get_ref<const std::string&>().empty())
            refuse(setting, given, where, "a file or a list of files");
        loadModelFile(file.get<std::string>());
    }
    return files;
}

/// NAME=VALUE, a list of them, or an object, as an object of texts: "0.2", "0.8,0.2,0.1", "energy".
json parsePairs(const Setting& setting, const json& given, const std::string& where) {
    const std::string expected = "NAME=VALUE, as m=0.2, diffuse=0.8,0.2,0.1 or normalization=energy";
    json pairs = json::object();
    const auto textOf = [&](const json& value) {
        if (value.is_string()) return value.get<std::string>();
        std::string text;
        for (const json& part : value.is_array() ? value : json::array({value})) {
            if (!part.is_number()) refuse(setting, given, where, expected);
            text += (text.empty() ? "" : ",") + part.dump();
        }
        return text;
    };
    if (given.is_object()) {
        for (const auto& [name, value] : given.items())
            pairs[name] = textOf(value);
    } else {
        for (const json& pair : given.is_array() ? given : json::array({given})) {
            const std::string text = pair.is_string() ? pair.get<std::string>() : "";
            const size_t equals = text.find('=');
            if (equals == std::string::npos) refuse(setting, given, where, expected);
            pairs[text.substr(0, equals)] = text.substr(equals + 1);
        }
    }
    for (const auto& [name, value] : pairs.items())
        if (name.empty() || value.get_ref<const std::string&>().empty())
            refuse(setting, given, where, expected);
    if (pairs.empty()) refuse(setting, given, where, expected);
    return pairs;
}

}  // namespace

std::vector<ParameterOverride> parametersOf(const Settings& settings) {
    std::vector<ParameterOverride> changes;
    const json& pairs = settings.get("brdf_set");
    if (pairs.is_null()) return changes;
    for (const auto& [name, value] : pairs.items()) {
        ParameterOverride change{name, value.get<std::string>(), {}};
        for (const std::string& part : split(change.text, ",")) {
            const auto parsed = number(part);
            if (!parsed) {
                change.numbers.clear();
                break;
            }
            change.numbers.push_back(*parsed);
        }
        changes.push_back(std::move(change));
    }
    return changes;
}

json parseSetting(const Setting& setting, const json& given, const std::string& where) {
    if (given.is_null()) return setting.defaultValue;
    switch (setting.type) {
        case SettingType::text:
            if (given.is_number_integer()) return std::to_string(given.get<int64_t>());  // a camera's index
            if (!given.is_string() || given.get<std::string>().empty())
                refuse(setting, given, where, "a name");
            return given;
        case SettingType::integer:
        case SettingType::real:
            return parseNumber(setting, given, where);
        case SettingType::choice: {
            const std::string value = given.is_string() ? given.get<std::string>() : given.dump();
            requireChoice(setting, value, given, where);
            return value;
        }
        case SettingType::vector:
            return numbers(setting, given, where, 3, ",", "three numbers, as 1,2.5,-3");
        case SettingType::colour:
            return parseColour(setting, given, where);
        case SettingType::resolution:
            return parseResolution(setting, given, where);
        case SettingType::files:
            return parseFiles(setting, given, where);
        case SettingType::pairs:
            return parsePairs(setting, given, where);
        case SettingType::list:
            break;
    }
    std::set<std::string> names;
    if (given.is_array()) {
        for (const json& item : given)
            names.insert(item.is_string() ? item.get<std::string>() : item.dump());
    } else if (given.is_string()) {
        for (const std::string& part : split(given.get<std::string>(), ","))
            names.insert(part);
    }
    if (names.empty()) refuse(setting, given, where, "names from " + listText(setting.choices));
    for (const std::string& name : names)
        requireChoice(setting, name, given, where);
    // In the table's order, each once: a list is a set.
    json result = json::array();
    for (const std::string& choice : setting.choices)
        if (names.contains(choice)) result.push_back(choice);
    return result;
}

}  // namespace lobe::app
