#include "measure/against.hpp"

#include <cmath>
#include <sstream>

#include "base/error.hpp"

namespace lobe::measure {
namespace {

using nlohmann::json;

std::string number(double value) {
    std::ostringstream text;
    text.precision(4);
    text << value;
    return text.str();
}

const json* sameScene(const json& report, const json& scene) {
    for (const json& other : report["scenes"]) {
        bool same = true;
        for (const char* key : {"scene", "camera", "width", "height"})
            same = same && other.value(key, json()) == scene.value(key, json());
        if (same) return &other;
    }
    return nullptr;
}

/// Knobs that only one version has do not tell settings apart.
bool sameKnobs(const json& a, const json& b) {
    for (const auto& [name, value] : a.items())
        if (b.contains(name) && b[name] != value) return false;
    return true;
}

const json* sameSetting(const json& scene, const json& setting) {
    for (const json& other : scene["settings"])
        if (sameKnobs(other["knobs"], setting["knobs"])) return &other;
    return nullptr;
}

void compareTimes(const std::string& name, const json& now, const json& before, ReportChanges& changes) {
    const double a = now["median_ms"], b = before["median_ms"];
    const std::string line =
        name + ": time " + number(b) + " -> " + number(a) + " ms (" + number(a / b) + " x)";
    if (now["low_ms"] > before["high_ms"] && a > b * (1.0 + kLeastChange))
        changes.regressions.push_back(line);
    if (now["high_ms"] < before["low_ms"] && b > a * (1.0 + kLeastChange))
        changes.improvements.push_back(line);
}

void compareErrors(const std::string& name, const json& now, const json& before, double noise,
                   ReportChanges& changes) {
    const auto bad = [](const json& error) { return error.value("non_finite", 0.0) > 0.0; };
    if (bad(now) && !bad(before))
        changes.regressions.push_back(name + ": " + now["non_finite"].dump() +
                                      " non-finite pixels, were none");
    if (!now["relmse"].is_number() || !before["relmse"].is_number()) return;
    const double a = std::sqrt(now["relmse"].get<double>()), b = std::sqrt(before["relmse"].get<double>());
    const std::string line = name + ": error (root of relmse) " + number(b) + " -> " + number(a) +
                             ", the truths' own " + number(noise);
    if (a > b + noise) changes.regressions.push_back(line);
    if (b > a + noise) changes.improvements.push_back(line);
}

double standardError(const json& scene) {
    return scene.contains("truth") ? scene["truth"].value("standard_error", 0.0) : 0.0;
}

void noteDifference(const json& now, const json& before, const char* object, const char* key,
                    ReportChanges& changes) {
    const json a = now.value(object, json::object()).value(key, json());
    const json b = before.value(object, json::object()).value(key, json());
    if (a != b)
        changes.notes.push_back(std::string(object) + ": " + key + " is " + a.dump() + ", was " + b.dump());
}

}  // namespace

ReportChanges compareReports(const json& now, const json& before) {
    ReportChanges changes;
    if (now.value("version", json()) != before.value("version", json()))
        changes.notes.push_back("version is " + now.value("version", json()).dump() + ", was " +
                                before.value("version", json()).dump());
    for (const char* key : {"renderer", "version", "clock"})
        noteDifference(now, before, "context", key, changes);
    for (const char* key : {"cpu", "cores"})
        noteDifference(now, before, "machine", key, changes);
    for (const json& scene : now["scenes"]) {
        const std::string name = scene["scene"].get<std::string>();
        const json* old = sameScene(before, scene);
        if (old == nullptr) {
            changes.notes.push_back(name + ": is not in the other report with this camera and size");
            continue;
        }
        if (scene.value("content_hash", "") != old->value("content_hash", ""))
            changes.notes.push_back(name + ": the scene's content has changed");
        const double noise = standardError(scene) + standardError(*old);
        size_t missing = 0;
        for (const json& setting : scene["settings"]) {
            const json* other = sameSetting(*old, setting);
            if (other == nullptr) {
                ++missing;
                continue;
            }
            ++changes.compared;
            const std::string label = name + ", " + setting["label"].get<std::string>();
            compareTimes(label, setting["time"], (*other)["time"], changes);
            compareErrors(label, setting["error"], (*other)["error"], noise, changes);
        }
        if (missing > 0)
            changes.notes.push_back(name + ": " + std::to_string(missing) +
                                    " settings are not in the other report");
    }
    if (changes.compared == 0) throw InputError("the reports have no setting of a scene in common");
    return changes;
}

}  // namespace lobe::measure
