// lobe models: the shading models, their parameters and the published surfaces among them.
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "arguments.hpp"
#include "base/error.hpp"
#include "commands.hpp"
#include "shading/brdf.hpp"

namespace lobe::app {
namespace {

using nlohmann::ordered_json;

const char* nameOf(ParameterKind kind) {
    switch (kind) {
        case ParameterKind::rgb:
            return "rgb";
        case ParameterKind::choice:
            return "choice";
        case ParameterKind::table:
            return "table";
        case ParameterKind::scalar:
            break;
    }
    return "scalar";
}

/// As scenes write it: a number, three of them, or a choice's name.
ordered_json valueOf(const Parameter& parameter, std::span<const double> values) {
    if (parameter.kind == ParameterKind::choice) return parameter.choices[static_cast<size_t>(values[0])];
    if (parameter.kind == ParameterKind::rgb) return {values[0], values[1], values[2]};
    return values[0];
}

ordered_json toJson(const Parameter& parameter) {
    ordered_json entry = {{"name", parameter.name},
                          {"glsl", parameter.glslName},
                          {"kind", nameOf(parameter.kind)},
                          {"description", parameter.description}};
    if (!parameter.group.empty()) entry["group"] = parameter.group;
    if (parameter.kind == ParameterKind::table) return entry;
    const double defaults[3] = {parameter.defaultValue.x, parameter.defaultValue.y, parameter.defaultValue.z};
    entry["default"] = valueOf(parameter, defaults);
    if (parameter.kind == ParameterKind::choice) {
        entry["choices"] = parameter.choices;
        return entry;
    }
    entry["minimum"] = parameter.minimum;
    entry["maximum"] = parameter.maximum;
    entry["unit"] = parameter.unit;
    if (parameter.mayBeTextured) entry["texture"] = parameter.textureIsSrgb ? "sRGB" : "linear";
    return entry;
}

ordered_json toJson(const Brdf& brdf, const BrdfPreset& preset) {
    ordered_json values = ordered_json::object();
    size_t offset = 0;
    for (const Parameter& parameter : brdf.parameters) {
        if (parameter.kind != ParameterKind::table)
            values[parameter.name] = valueOf(parameter, std::span(preset.values).subspan(offset));
        offset += static_cast<size_t>(parameter.components());
    }
    return {{"name", preset.name}, {"source", preset.source}, {"values", values}};
}

ordered_json toJson(const Brdf& brdf) {
    ordered_json entry = {{"name", brdf.name},
                          {"title", brdf.title},
                          {"source", brdf.source},
                          {"reciprocal", brdf.traits.reciprocal},
                          {"energy_conserving", brdf.traits.energyConserving},
                          {"anisotropic", brdf.traits.usesTangent},
                          {"scatters_light", brdf.traits.scattersLight},
                          {"mirror_part", static_cast<bool>(brdf.mirror)},
                          {"parameters", ordered_json::array()},
                          {"presets", ordered_json::array()}};
    for (const Parameter& parameter : brdf.parameters)
        entry["parameters"].push_back(toJson(parameter));
    for (const BrdfPreset& preset : brdf.presets)
        entry["presets"].push_back(toJson(brdf, preset));
    return entry;
}

std::string textOf(const ordered_json& value) {
    if (value.is_string()) return value.get<std::string>();
    std::ostringstream text;
    if (value.is_array()) {
        const bool grey = value[0] == value[1] && value[1] == value[2];
        for (size_t i = 0; i < (grey ? 1 : value.size()); ++i)
            text << (i > 0 ? "," : "") << value[i].get<double>();
    } else {
        text << value.get<double>();
    }
    return text.str();
}

void print(const Brdf& brdf) {
    const ordered_json model = toJson(brdf);
    std::cout << brdf.name << ": " << brdf.title << "\n  " << brdf.source << "\n  "
              << (brdf.traits.reciprocal ? "reciprocal" : "not reciprocal") << "; "
              << (brdf.traits.energyConserving ? "conserves energy" : "may exceed albedo 1")
              << (brdf.traits.usesTangent ? "; anisotropic" : "") << '\n';
    for (const ordered_json& parameter : model["parameters"]) {
        std::string range;
        if (parameter.contains("choices")) {
            for (const ordered_json& choice : parameter["choices"])
                range += (range.empty() ? "" : "|") + choice.get<std::string>();
        } else if (parameter.contains("minimum")) {
            range = textOf(parameter["minimum"]) + ".." + textOf(parameter["maximum"]);
            if (parameter["unit"] != "1") range += " " + parameter["unit"].get<std::string>();
        }
        std::cout << "  " << std::left << std::setw(14) << parameter["name"].get<std::string>() << ' ';
        if (parameter.contains("default"))
            std::cout << range << " [" << textOf(parameter["default"]) << "]  ";
        std::cout << parameter["description"].get<std::string>() << '\n';
    }
    for (const BrdfPreset& preset : brdf.presets)
        std::cout << "  preset \"" << preset.name << "\"  " << preset.source << '\n';
}

}  // namespace

int modelsCommand(const std::vector<std::string>& list) {
    Arguments arguments("models",
                        "List the shading models; of those named, parameters with ranges and defaults, and "
                        "published surfaces.");
    std::vector<std::string> names;
    bool json = false;
    arguments.app().add_option("models", names, "models to describe")->type_name("MODEL...");
    arguments.app().add_flag("--json", json, "for programs");
    if (!arguments.parse(list)) return 0;

    std::vector<const Brdf*> models;
    for (const std::string& name : names)
        models.push_back(&requireBrdf(name));
    if (names.empty())
        for (const Brdf& brdf : allBrdfs())
            models.push_back(&brdf);

    ordered_json all = {{"schema", 1}, {"models", ordered_json::array()}};
    for (const Brdf* brdf : models) {
        if (json)
            all["models"].push_back(toJson(*brdf));
        else if (names.empty())
            std::cout << std::left << std::setw(20) << brdf->name << ' ' << brdf->title << '\n';
        else
            print(*brdf);
    }
    if (json) std::cout << all.dump(2) << '\n';
    return 0;
}

}  // namespace lobe::app
