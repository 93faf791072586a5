#include "shading/brdf.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/closest_name.hpp"
#include "base/error.hpp"

namespace lobe {

std::vector<Brdf> allBrdfEntries();  // written by CMake from the folder brdf/

namespace {

/// The shortest text that reads back as the same double.
std::string numberText(double value) {
    if (!std::isfinite(value)) return std::isnan(value) ? "NaN" : value > 0.0 ? "infinity" : "-infinity";
    const std::string text = nlohmann::json(value).dump();
    return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

std::string rangeText(const Parameter& parameter) {
    return numberText(parameter.minimum) + ".." + numberText(parameter.maximum);
}

std::string choicesText(const Parameter& parameter) {
    std::string text;
    for (const std::string& choice : parameter.choices)
        text += (text.empty() ? "\"" : " or \"") + choice + "\"";
    return text;
}

bool isValid(const Parameter& parameter, double value) {
    if (!(value >= parameter.minimum && value <= parameter.maximum)) return false;
    const bool whole = parameter.kind == ParameterKind::choice || parameter.kind == ParameterKind::table;
    return !whole || value == std::floor(value);
}

std::vector<Brdf>& loaded() {
    static std::vector<Brdf> brdfs;
    return brdfs;
}

const Brdf* findIn(const std::vector<Brdf>& brdfs, std::string_view name) {
    const auto found =
        std::find_if(brdfs.begin(), brdfs.end(), [&](const Brdf& b) { return b.name == name; });
    return found == brdfs.end() ? nullptr : &*found;
}

}  // namespace

const char* glslType(ParameterKind kind) {
    switch (kind) {
        case ParameterKind::rgb:
            return "vec3";
        case ParameterKind::choice:
        case ParameterKind::table:
            return "int";
        case ParameterKind::scalar:
            break;
    }
    return "float";
}

int Brdf::parameterIndex(std::string_view parameterName) const {
    const auto found = std::find_if(parameters.begin(), parameters.end(),
                                    [&](const Parameter& p) { return p.name == parameterName; });
    return found == parameters.end() ? -1 : static_cast<int>(found - parameters.begin());
}

int Brdf::valueOffset(int parameterIndex) const {
    int offset = 0;
    for (int i = 0; i < parameterIndex; ++i)
        offset += parameters[static_cast<size_t>(i)].components();
    return offset;
}

int Brdf::valueCount() const {
    return valueOffset(static_cast<int>(parameters.size()));
}

ParameterValues Brdf::defaults() const {
    ParameterValues values;
    for (const Parameter& parameter : parameters)
        for (int c = 0; c < parameter.components(); ++c)
            values.push_back(parameter.defaultValue[c]);
    if (table) {
        const TableRows rows = table->examples().front().second;
        values.insert(values.end(), rows.begin(), rows.end());
    }
    return values;
}

const BrdfPreset* Brdf::findPreset(std::string_view presetName) const {
    const auto found = std::find_if(presets.begin(), presets.end(),
                                    [&](const BrdfPreset& preset) { return preset.name == presetName; });
    return found == presets.end() ? nullptr : &*found;
}

int Brdf::tableParameter() const {
    const auto found = std::find_if(parameters.begin(), parameters.end(),
                                    [](const Parameter& p) { return p.kind == ParameterKind::table; });
    return found == parameters.end() ? -1 : static_cast<int>(found - parameters.begin());
}

std::span<const double> Brdf::tableOf(std::span<const double> values) const {
    return values.subspan(static_cast<size_t>(valueCount()));
}

std::string layoutError(const Brdf& brdf, std::span<const double> values) {
    const auto count = static_cast<size_t>(brdf.valueCount());
    const bool fits =
        brdf.table ? values.size() > count && (values.size() - count) % 4 == 0 : values.size() == count;
    if (fits) return {};
    return std::to_string(values.size()) + " values; expected " + std::to_string(count) +
           (brdf.table ? " and a table of rows of 4" : "");
}

const std::vector<Brdf>& allBrdfs() {
    static const std::vector<Brdf> brdfs = [] {
        std::vector<Brdf> entries = allBrdfEntries();
        std::sort(entries.begin(), entries.end(),
                  [](const Brdf& a, const Brdf& b) { return a.name < b.name; });
        return entries;
    }();
    return brdfs;
}

const std::vector<Brdf>& loadedBrdfs() {
    return loaded();
}

void setLoadedBrdfs(std::vector<Brdf> brdfs) {
    for (size_t i = 0; i < brdfs.size(); ++i) {
        if (findIn(allBrdfs(), brdfs[i].name) != nullptr)
            throw UsageError(brdfs[i].file + ": " + brdfs[i].name +
                             " is a model that comes with Lobe; expected another file name");
        for (size_t j = 0; j < i; ++j)
            if (brdfs[j].name == brdfs[i].name)
                throw UsageError(brdfs[i].file + ": a model " + brdfs[i].name + " is loaded from " +
                                 brdfs[j].file + " already; expected another file name");
    }
    loaded() = std::move(brdfs);
}

std::vector<std::string> brdfNames() {
    std::vector<std::string> names;
    for (const std::vector<Brdf>* brdfs : {&allBrdfs(), &loadedBrdfs()})
        for (const Brdf& brdf : *brdfs)
            names.push_back(brdf.name);
    return names;
}

const Brdf* findBrdf(std::string_view name) {
    const Brdf* found = findIn(allBrdfs(), name);
    return found != nullptr ? found : findIn(loadedBrdfs(), name);
}

void requireTwin(const Brdf& brdf) {
    if (!brdf.fCos)
        throw UsageError("model " + brdf.name + " was loaded from " + brdf.file +
                         " and has no double-precision twin; expected a model that comes with Lobe");
}

const Brdf& requireBrdf(std::string_view name) {
    if (const Brdf* brdf = findBrdf(name)) return *brdf;
    const std::vector<std::string> names = brdfNames();
    std::string list;
    for (const std::string& known : names)
        list += (list.empty() ? "" : ", ") + known;
    throw UsageError("unknown reflectance model '" + std::string(name) + "'" + didYouMean(name, names) +
                     "; expected one of " + list);
}

void validateParameters(const Brdf& brdf, std::span<const double> values, const std::string& where) {
    if (const std::string wrong = layoutError(brdf, values); !wrong.empty())
        throw InputError(where + ": " + brdf.name + ": " + wrong);
    size_t offset = 0;
    for (const Parameter& parameter : brdf.parameters) {
        for (int c = 0; c < parameter.components(); ++c, ++offset) {
            if (isValid(parameter, values[offset])) continue;
            std::string message = where + ": " + parameter.name;
            if (parameter.components() == 3) message.append("[").append(std::to_string(c)).append("]");
            message.append(": ").append(numberText(values[offset])).append("; expected ");
            throw InputError(message + (parameter.kind == ParameterKind::choice ? choicesText(parameter)
                                                                                : rangeText(parameter)));
        }
    }
}

std::string glslParameterType(const Brdf& brdf) {
    std::string type;
    bool wordStarts = true;
    for (char c : brdf.name) {
        if (c == '_') {
            wordStarts = true;
            continue;
        }
        type += wordStarts ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
        wordStarts = false;
    }
    return type + "Params";
}

std::string glslParameterStruct(const Brdf& brdf) {
    std::string text = "struct " + glslParameterType(brdf) + " {";
    for (const Parameter& parameter : brdf.parameters)
        text += std::string(" ") + glslType(parameter.kind) + " " + parameter.glslName + ";";
    return text + " };";
}

}  // namespace lobe
