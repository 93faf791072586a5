#include "plot/model.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "shading/fresnel.hpp"
#include "shading/metals.hpp"

namespace lobe::plot {
namespace {

constexpr const char* kAlpha = "alpha";
constexpr const char* kMetal = "metal";
constexpr const char* kFresnel = "fresnel";

bool isPairOfAlphas(const Brdf& brdf, const std::string& key) {
    return key == kAlpha && brdf.parameterIndex(kAlpha) < 0 && brdf.parameterIndex("alphaX") >= 0 &&
           brdf.parameterIndex("alphaY") >= 0;
}

bool isMetal(const Brdf& brdf, const std::string& key) {
    return key == kMetal && brdf.parameterIndex(kFresnel) >= 0 && brdf.parameterIndex("k") >= 0;
}

[[noreturn]] void refuse(const Brdf& brdf, const Assignment& assignment, const std::string& expected) {
    throw UsageError(brdf.name + ": " + assignment.key + ": '" + assignment.text + "'; expected " + expected);
}

/// Numbers separated by commas; empty if any is none.
std::vector<double> numbersOf(const std::string& text) {
    std::vector<double> numbers;
    for (size_t start = 0; start <= text.size();) {
        const size_t comma = std::min(text.find(',', start), text.size());
        double value = 0.0;
        const char* end = text.data() + comma;
        const auto [stopped, error] = std::from_chars(text.data() + start, end, value);
        if (error != std::errc() || stopped != end) return {};
        numbers.push_back(value);
        start = comma + 1;
    }
    return numbers;
}

double* placeOf(Model& model, const std::string& name) {
    return model.values.data() + model.brdf->valueOffset(model.brdf->parameterIndex(name));
}

void setMetal(Model& model, const Assignment& assignment) {
    const shading::Metal& metal =
        shading::requireMetal(assignment.text, model.brdf->name + ": " + assignment.key + ":");
    shading::setMetal(*model.brdf, model.values, metal);
    model.metal = metal.name;
}

std::vector<std::byte> bytesOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw InputError(path + ": can't be read");
    const std::vector<char> text{std::istreambuf_iterator<char>(file), {}};
    if (file.bad()) throw InputError(path + ": can't be read");
    std::vector<std::byte> bytes(text.size());
    std::transform(text.begin(), text.end(), bytes.begin(), [](char c) { return static_cast<std::byte>(c); });
    return bytes;
}

/// From a file where the model reads files, else one of the tables that come with Lobe.
void setTable(Model& model, const Assignment& assignment) {
    const TableFormat& format = *model.brdf->table;
    TableRows rows;
    std::vector<std::string> names;
    if (format.fromFile) {
        try {
            rows = format.fromFile(bytesOf(assignment.text));
        } catch (const InputError& error) {
            const std::string what = error.what();
            throw InputError(what.starts_with(assignment.text) ? what : assignment.text + ": " + what);
        }
    } else {
        for (auto& [name, example] : format.examples()) {
            names.push_back(name);
            if (name == assignment.text) rows = std::move(example);
        }
    }
    if (rows.empty())
        refuse(*model.brdf, assignment, "one of " + listed(names) + didYouMean(assignment.text, names));
    model.values.resize(static_cast<size_t>(model.brdf->valueCount()));
    model.values.insert(model.values.end(), rows.begin(), rows.end());
    model.table = assignment.text.substr(assignment.text.rfind('/') + 1);
}

void setValue(Model& model, const Parameter& parameter, const Assignment& assignment) {
    double* place = placeOf(model, parameter.name);
    if (parameter.group == kFresnel) model.metal.clear();
    if (parameter.kind == ParameterKind::table) return setTable(model, assignment);
    if (parameter.kind == ParameterKind::choice) {
        const auto& choices = parameter.choices;
        const auto found = std::find(choices.begin(), choices.end(), assignment.text);
        if (found == choices.end())
            refuse(*model.brdf, assignment,
                   "one of " + listed(choices) + didYouMean(assignment.text, choices));
        *place = static_cast<double>(found - choices.begin());
        return;
    }
    const std::vector<double> numbers = numbersOf(assignment.text);
    const auto components = static_cast<size_t>(parameter.components());
    if (numbers.size() != 1 && numbers.size() != components)
        refuse(*model.brdf, assignment,
               components == 1 ? "a number" : "a number, or three as red,green,blue");
    for (size_t c = 0; c < components; ++c)
        place[c] = numbers[numbers.size() == 1 ? 0 : c];
}

void validate(const Model& model) {
    try {
        validateParameters(*model.brdf, model.values, model.brdf->name);
    } catch (const InputError& error) {
        throw UsageError(error.what());  // the values come from the command line
    }
}

void roundToFloats(ParameterValues& values) {
    for (double& value : values)
        value = double(static_cast<float>(value));
}

/// The equations that read what was set.
void useFresnel(Model& model, const std::vector<Assignment>& assignments) {
    const int type = model.brdf->parameterIndex(kFresnel);
    if (type < 0 || model.brdf->parameters[static_cast<size_t>(type)].group != kFresnel) return;
    std::vector<std::string> named;
    std::string choice;
    for (const Assignment& assignment : assignments) {
        named.push_back(assignment.key);
        if (assignment.key == kFresnel) choice = assignment.text;
    }
    double* place = placeOf(model, kFresnel);
    const auto present = static_cast<shading::FresnelType>(static_cast<int>(*place));
    *place = static_cast<double>(shading::fresnelTypeFor(present, named, choice, model.brdf->name));
}

/// False for optical constants that the chosen kind of Fresnel term does not read.
bool counts(const Model& model, const Parameter& parameter) {
    const int type = model.brdf->parameterIndex(kFresnel);
    if (type < 0 || parameter.group != kFresnel) return true;
    const std::string& chosen =
        model.brdf->parameters[static_cast<size_t>(type)]
            .choices[static_cast<size_t>(model.values[static_cast<size_t>(model.brdf->valueOffset(type))])];
    if (parameter.name == "f0") return chosen == "schlick";
    if (parameter.name == "eta") return chosen != "schlick";
    return parameter.name != "k" || chosen == "conductor";
}

std::string valueText(const Model& model, size_t index) {
    const Parameter& parameter = model.brdf->parameters[index];
    const double* value =
        model.values.data() + static_cast<size_t>(model.brdf->valueOffset(static_cast<int>(index)));
    const std::string unit = parameter.unit == "1" ? "" : " " + parameter.unit;
    switch (parameter.kind) {
        case ParameterKind::table:
            return model.table;
        case ParameterKind::choice:
            return parameter.choices[static_cast<size_t>(*value)];
        case ParameterKind::scalar:
            break;
        case ParameterKind::rgb:
            if (value[0] == value[1] && value[1] == value[2]) break;
            return "(" + shortNumber(value[0]) + ", " + shortNumber(value[1]) + ", " + shortNumber(value[2]) +
                   ")" + unit;
    }
    return shortNumber(*value) + unit;
}

}  // namespace

Model makeModel(const std::string& name, const std::vector<Assignment>& assignments) {
    const Brdf& brdf = requireBrdf(name);
    Model model{&brdf, brdf.defaults(), brdf.table ? brdf.table->examples().front().first : ""};
    for (const Assignment& assignment : assignments) {
        const int index = brdf.parameterIndex(assignment.key);
        if (index >= 0) {
            setValue(model, brdf.parameters[static_cast<size_t>(index)], assignment);
        } else if (isMetal(brdf, assignment.key)) {
            setMetal(model, assignment);
        } else if (isPairOfAlphas(brdf, assignment.key)) {
            for (const char* alpha : {"alphaX", "alphaY"})
                setValue(model, brdf.parameters[static_cast<size_t>(brdf.parameterIndex(alpha))], assignment);
        } else {
            refuseParameter(brdf, assignment.key);
        }
    }
    useFresnel(model, assignments);
    validate(model);
    roundToFloats(model.values);
    return model;
}

Model withParameter(Model model, const std::string& key, double value) {
    scalarParameterOf(*model.brdf, key);
    const bool pair = isPairOfAlphas(*model.brdf, key);
    for (const std::string& name :
         pair ? std::vector<std::string>{"alphaX", "alphaY"} : std::vector<std::string>{key})
        *placeOf(model, name) = value;
    validate(model);
    roundToFloats(model.values);
    return model;
}

bool hasParameter(const Brdf& brdf, const std::string& key) {
    return brdf.parameterIndex(key) >= 0 || isPairOfAlphas(brdf, key) || isMetal(brdf, key);
}

void refuseParameter(const Brdf& brdf, const std::string& key) {
    std::vector<std::string> names;
    for (const Parameter& parameter : brdf.parameters)
        names.push_back(parameter.name);
    for (const char* synonym : {kAlpha, kMetal})
        if (brdf.parameterIndex(synonym) < 0 && hasParameter(brdf, synonym)) names.emplace_back(synonym);
    throw UsageError(brdf.name + ": unknown parameter '" + key + "'" + didYouMean(key, names) +
                     "; expected one of " + listed(names));
}

const Parameter& scalarParameterOf(const Brdf& brdf, const std::string& key) {
    const int index = brdf.parameterIndex(isPairOfAlphas(brdf, key) ? "alphaX" : key);
    if (index < 0) refuseParameter(brdf, key);
    const Parameter& parameter = brdf.parameters[static_cast<size_t>(index)];
    if (parameter.kind != ParameterKind::scalar)
        throw UsageError(brdf.name + ": " + key + " is not a single number; expected a parameter that is");
    return parameter;
}

void requireScatters(const Model& model) {
    if (!model.brdf->traits.scattersLight)
        throw UsageError(model.brdf->name +
                         ": scatters no light, only mirrors it; expected a model with a lobe");
}

std::string widthParameter(const Brdf& brdf) {
    std::string first;
    for (const Parameter& parameter : brdf.parameters) {
        if (parameter.kind != ParameterKind::scalar) continue;
        if (first.empty()) first = parameter.name;
        ParameterValues values = brdf.defaults();
        double& value = values[static_cast<size_t>(brdf.valueOffset(brdf.parameterIndex(parameter.name)))];
        const double before = brdf.lobeSharpness(values);
        value = 0.5 * (value + parameter.minimum);
        if (brdf.lobeSharpness(values) == before) continue;
        return parameter.name == "alphaX" && isPairOfAlphas(brdf, kAlpha) ? kAlpha : parameter.name;
    }
    return first;
}

std::string describe(const Model& model) {
    std::string text;
    const auto add = [&](const std::string& name, const std::string& value) {
        text += (text.empty() ? "" : ", ") + name + " " + value;
    };
    for (size_t i = 0; i < model.brdf->parameters.size(); ++i) {
        const Parameter& parameter = model.brdf->parameters[i];
        if (model.metal.empty() || parameter.group != kFresnel) {
            if (counts(model, parameter)) add(parameter.name, valueText(model, i));
        } else if (parameter.name == kFresnel) {
            add(kMetal, model.metal);
        }
    }
    return model.brdf->title + ": " + text;
}

std::string shortNumber(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), static_cast<float>(value));
    return {text.data(), end.ptr};
}

}  // namespace lobe::plot
