#include "measure/report_files.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "base/error.hpp"
#include "measure/errors.hpp"
#include "plan/knobs.hpp"

namespace lobe::measure {
namespace {

using nlohmann::json;

/// RFC 4180.
std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text)
        result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + '"';
}

std::string cell(const json& value) {
    if (value.is_null()) return {};
    return value.is_string() ? quoted(value.get<std::string>()) : value.dump();
}

/// Whether a value is there and an array of objects.
bool isList(const json& object, const char* key) {
    return object.contains(key) && object[key].is_array() &&
           std::all_of(object[key].begin(), object[key].end(), [](const json& j) { return j.is_object(); });
}

bool isSetting(const json& setting) {
    const auto has = [&](const char* key) { return setting.contains(key) && setting[key].is_object(); };
    if (!has("knobs") || !has("time") || !has("error") || !setting.contains("label") ||
        !setting["label"].is_string() || !setting["error"].contains("relmse"))
        return false;
    for (const char* key : {"median_ms", "low_ms", "high_ms", "wall_ms"})
        if (!setting["time"].contains(key) || !setting["time"][key].is_number()) return false;
    return std::all_of(setting["knobs"].begin(), setting["knobs"].end(),
                       [](const json& value) { return value.is_string(); });
}

bool isScene(const json& scene) {
    const auto positive = [&](const char* key) {
        return scene.contains(key) && scene[key].is_number() && scene[key].get<double>() > 0.0;
    };
    return scene.contains("scene") && scene["scene"].is_string() && positive("width") && positive("height") &&
           isList(scene, "settings") &&
           std::all_of(scene["settings"].begin(), scene["settings"].end(), isSetting);
}

}  // namespace

std::string reportCsv(const json& report) {
    constexpr const char* kTimes[] = {"median_ms", "low_ms", "high_ms", "minimum_ms", "wall_ms", "cpu_ms"};
    std::string text = "scene,camera,width,height,id,label,preset,front";
    for (const std::string& name : knobNames())
        text += "," + name;
    for (const char* name : kTimes)
        text += std::string(",") + name;
    for (const std::string& name : errorColumns())
        text += "," + name;
    text += "\r\n";
    for (const json& scene : report["scenes"])
        for (const json& setting : scene["settings"]) {
            text += cell(scene["scene"]) + "," + cell(scene["camera"]) + "," + cell(scene["width"]) + "," +
                    cell(scene["height"]);
            for (const char* key : {"id", "label", "preset", "front"})
                text += "," + cell(setting[key]);
            for (const std::string& name : knobNames())
                text += "," + cell(setting["knobs"].value(name, json()));
            for (const char* name : kTimes)
                text += "," + cell(setting["time"].value(name, json()));
            for (const std::string& name : errorColumns())
                text += "," + cell(setting["error"].value(name, json()));
            text += "\r\n";
        }
    return text;
}

json readReport(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::stringstream text;
    if (!stream || !(text << stream.rdbuf()))
        throw InputError(file.string() + ": can't be read; expected a report.json of lobe report");
    json report = json::parse(text.str(), nullptr, false);
    if (!report.is_object() || !report.contains("schema"))
        throw InputError(file.string() + ": is no report; expected a report.json of lobe report");
    if (report["schema"] != kReportSchema)
        throw InputError(file.string() + ": schema " + report["schema"].dump() + "; expected " +
                         std::to_string(kReportSchema));
    const bool good =
        isList(report, "scenes") && std::all_of(report["scenes"].begin(), report["scenes"].end(), isScene);
    if (!good)
        throw InputError(file.string() +
                         ": damaged; expected scenes with settings that have knobs, time, error");
    return report;
}

}  // namespace lobe::measure
