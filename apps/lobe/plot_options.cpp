#include "plot_options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "plot/geometry.hpp"

namespace lobe::app {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    for (size_t start = 0; start <= text.size();) {
        const size_t end = std::min(text.find(separator, start), text.size());
        parts.push_back(text.substr(start, end - start));
        start = end + 1;
    }
    return parts;
}

/// What a range of several decades shows of itself: its upper three, unless the registry says better.
constexpr double kWideRange = 100.0;
constexpr double kShownDecades = 1e-3;

std::pair<double, double> usualRange(const Parameter& parameter) {
    if (parameter.usual) return *parameter.usual;
    const double low = parameter.minimum, high = parameter.maximum;
    if (low > 0.0 && high / low > kWideRange) return {std::max(low, kShownDecades * high), high};
    if (low == 0.0 && high >= kWideRange) return {1.0, std::min(high, 1e4)};
    return {low, high};
}

/// "ward.alpha=0.1" as its model, which may be empty, and the rest.
struct Written {
    std::string model;
    plot::Assignment assignment;
};

Written written(const std::string& text, const std::vector<std::string>& models) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw UsageError("--set " + text + "; expected PARAMETER=VALUE or MODEL.PARAMETER=VALUE");
    Written result{"", {text.substr(0, equals), text.substr(equals + 1)}};
    const size_t dot = result.assignment.key.find('.');
    if (dot == std::string::npos) return result;
    result.model = result.assignment.key.substr(0, dot);
    result.assignment.key = result.assignment.key.substr(dot + 1);
    if (std::find(models.begin(), models.end(), result.model) == models.end())
        throw UsageError("--set " + text + ": '" + result.model + "' is not among --brdf" +
                         didYouMean(result.model, models));
    return result;
}

}  // namespace

std::vector<double> numberList(const std::string& option, const std::string& text) {
    std::vector<double> numbers;
    for (const std::string& part : split(text, ',')) {
        double value = 0.0;
        const char* end = part.data() + part.size();
        const auto [stopped, error] = std::from_chars(part.data(), end, value);
        if (error != std::errc() || stopped != end || !std::isfinite(value))
            throw UsageError(option + ": '" + text + "'; expected numbers separated by commas");
        numbers.push_back(value);
    }
    return numbers;
}

double numberIn(const std::string& option, const std::string& text, double minimum, double maximum) {
    const std::vector<double> numbers = numberList(option, text);
    if (numbers.size() != 1 || !(numbers[0] >= minimum && numbers[0] <= maximum))
        throw UsageError(option + ": '" + text + "'; expected a number from " + plot::shortNumber(minimum) +
                         " to " + plot::shortNumber(maximum));
    return numbers[0];
}

size_t choiceOf(const std::string& option, const std::string& text, const std::vector<std::string>& names,
                size_t otherwise) {
    if (text.empty()) return otherwise;
    const auto found = std::find(names.begin(), names.end(), text);
    if (found != names.end()) return static_cast<size_t>(found - names.begin());
    std::string list;
    for (const std::string& name : names)
        list += (list.empty() ? "" : ", ") + name;
    throw UsageError(option + ": '" + text + "'; expected one of " + list + didYouMean(text, names));
}

plot::Channel channelNamed(const std::string& text) {
    return static_cast<plot::Channel>(choiceOf("--channel", text, {"luminance", "red", "green", "blue"}));
}

std::vector<plot::Model> modelsOf(const std::string& brdfs, const std::vector<std::string>& assignments) {
    if (brdfs.empty()) throw UsageError("--brdf: missing; expected the name of a reflectance model");
    const std::vector<std::string> names = split(brdfs, ',');
    for (const std::string& name : names) {
        requireBrdf(name);
        if (std::count(names.begin(), names.end(), name) > 1)
            throw UsageError("--brdf: " + name + " is there twice; expected each model once");
    }
    std::vector<std::vector<plot::Assignment>> own(names.size());
    for (const std::string& text : assignments) {
        const Written assignment = written(text, names);
        bool taken = false;
        for (size_t i = 0; i < names.size(); ++i) {
            const bool meant = assignment.model.empty()
                                   ? plot::hasParameter(requireBrdf(names[i]), assignment.assignment.key)
                                   : assignment.model == names[i];
            if (meant) own[i].push_back(assignment.assignment);
            taken |= meant;
        }
        if (!taken) plot::refuseParameter(requireBrdf(names[0]), assignment.assignment.key);
    }
    std::vector<plot::Model> models;
    for (size_t i = 0; i < names.size(); ++i)
        models.push_back(plot::makeModel(names[i], own[i]));
    return models;
}

plot::Model modelOf(const std::string& brdf, const std::vector<std::string>& assignments) {
    std::vector<plot::Model> models = modelsOf(brdf, assignments);
    if (models.size() != 1)
        throw UsageError("--brdf: " + std::to_string(models.size()) + " models; expected one");
    return models[0];
}

Sweep sweepOf(const plot::Model& model, const std::string& over, const std::string& range, int steps) {
    Sweep sweep{over.empty() ? plot::widthParameter(*model.brdf) : over, {}};
    if (sweep.over.empty()) {
        if (!range.empty())
            throw UsageError("--range: " + model.brdf->name + " has no parameter that is a single number");
        return {"", {0.0}};
    }
    auto [low, high] = usualRange(plot::scalarParameterOf(*model.brdf, sweep.over));
    if (!range.empty()) {
        const std::vector<double> ends = numberList("--range", range);
        if (ends.size() != 2 || !(ends[0] < ends[1]))
            throw UsageError("--range: '" + range + "'; expected LOW,HIGH with LOW below HIGH");
        low = ends[0];
        high = ends[1];
    }
    sweep.values = plot::isWide(low, high) ? plot::geometricSteps(low, high, steps)
                                           : plot::linearSteps(low, high, steps);
    for (size_t i = 1; i + 1 < sweep.values.size(); ++i)
        sweep.values[i] = plot::rounded(sweep.values[i], 3);  // off by 0.5 % at most, and easier to read
    for (double end : {low, high})
        plot::withParameter(model, sweep.over, end);  // refuses what is out of range before long work
    return sweep;
}

}  // namespace lobe::app
