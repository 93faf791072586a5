#include "measure/choose.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <vector>

#include "base/closest_name.hpp"
#include "base/error.hpp"
#include "measure/errors.hpp"
#include "plan/knobs.hpp"

namespace lobe::measure {
namespace {

using nlohmann::json;

std::string number(double value) {
    std::ostringstream text;
    text.precision(3);
    text << value;
    return text.str();
}

/// One setting with what is to be expected of it.
struct Candidate {
    const json* setting = nullptr;
    double error = 0.0, milliseconds = 0.0;
};

/// The scene's own entries if there are any, else all.
std::vector<const json*> entriesFor(const json& report, const std::string& contentHash) {
    std::vector<const json*> all, own;
    for (const json& scene : report["scenes"]) {
        if (scene["settings"].empty()) continue;
        all.push_back(&scene);
        if (scene.value("content_hash", "") == contentHash) own.push_back(&scene);
    }
    return own.empty() ? all : own;
}

const json* settingWith(const json& scene, const json& knobs) {
    for (const json& setting : scene["settings"])
        if (setting["knobs"] == knobs) return &setting;
    return nullptr;
}

double timeOf(const json& report, const json& setting) {
    const bool real = report.contains("context") && report["context"].value("clock", "") == "timer queries";
    return setting["time"].at(real ? "median_ms" : "wall_ms").get<double>();
}

/// Settings of the first entry that all others have as well, each with its worst error and time.
std::vector<Candidate> candidatesOf(const json& report, const std::vector<const json*>& entries,
                                    double pixels, const Goal& goal) {
    const bool larger = largerIsBetter(goal.metric);
    std::vector<Candidate> candidates;
    for (const json& setting : (*entries.front())["settings"]) {
        Candidate candidate{&setting, larger ? 1e300 : 0.0, 0.0};
        const bool everywhere = std::all_of(entries.begin(), entries.end(), [&](const json* entry) {
            const json* same = settingWith(*entry, setting["knobs"]);
            if (same == nullptr || !same->at("error").contains(goal.metric) ||
                !same->at("error")[goal.metric].is_number())
                return false;
            const double error = same->at("error")[goal.metric].get<double>();
            candidate.error = larger ? std::min(candidate.error, error) : std::max(candidate.error, error);
            const double area = (*entry)["width"].get<double>() * (*entry)["height"].get<double>();
            candidate.milliseconds = std::max(candidate.milliseconds, timeOf(report, *same) * pixels / area);
            return true;
        });
        if (everywhere) candidates.push_back(candidate);
    }
    return candidates;
}

std::string basisOf(const std::vector<const json*>& entries, const std::string& contentHash) {
    if (entries[0]->value("content_hash", "") == contentHash) return "measured on this scene";
    return "the worst of " + std::to_string(entries.size()) +
           (entries.size() == 1 ? " other scene" : " other scenes") + ", no promise for this one";
}

}  // namespace

Chosen choose(const json& report, const std::string& contentHash, double pixels, const Goal& goal) {
    const std::vector<const json*> entries = entriesFor(report, contentHash);
    const std::vector<Candidate> candidates =
        entries.empty() ? std::vector<Candidate>{} : candidatesOf(report, entries, pixels, goal);
    if (candidates.empty())
        throw UsageError("the report has no setting with an error '" + goal.metric + "'" +
                         didYouMean(goal.metric, errorMetricNames()));
    const bool larger = largerIsBetter(goal.metric);
    const auto better = [&](const Candidate& a, const Candidate& b) {
        return larger ? a.error > b.error : a.error < b.error;
    };
    const auto faster = [](const Candidate& a, const Candidate& b) {
        return a.milliseconds < b.milliseconds;
    };
    const auto keepsError = [&](const Candidate& c) {
        return !goal.maxError || (larger ? c.error >= *goal.maxError : c.error <= *goal.maxError);
    };
    const auto keepsBudget = [&](const Candidate& c) {
        return !goal.budget || c.milliseconds <= *goal.budget;
    };
    const Candidate* best = nullptr;
    for (const Candidate& candidate : candidates) {
        if (!keepsError(candidate) || !keepsBudget(candidate)) continue;
        if (best == nullptr || (goal.maxError ? faster(candidate, *best) : better(candidate, *best)))
            best = &candidate;
    }
    if (best == nullptr) {
        const Candidate& least = *std::min_element(candidates.begin(), candidates.end(), better);
        const Candidate& quickest = *std::min_element(candidates.begin(), candidates.end(), faster);
        throw UsageError((goal.maxError ? "--max-error " + number(*goal.maxError) : std::string()) +
                         (goal.maxError && goal.budget ? " with " : "") +
                         (goal.budget ? "--budget " + number(*goal.budget) + "ms" : std::string()) +
                         " can't be kept; the best that can be had is " + goal.metric + " " +
                         number(least.error) + " in " + number(least.milliseconds) + " ms, and " +
                         goal.metric + " " + number(quickest.error) + " in " + number(quickest.milliseconds) +
                         " ms");
    }
    Chosen chosen;
    for (const auto& [name, value] : (*best->setting)["knobs"].items())
        setKnob(chosen.quality, name, value.get<std::string>());
    chosen.label = (*best->setting)["label"].get<std::string>();
    chosen.error = best->error;
    chosen.milliseconds = best->milliseconds;
    chosen.basis = basisOf(entries, contentHash);
    return chosen;
}

double parseDuration(const std::string& option, const std::string& text) {
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    std::string unit(stop, end);
    std::erase(unit, ' ');
    if (error != std::errc() || !std::isfinite(value) || value <= 0.0 ||
        (!unit.empty() && unit != "ms" && unit != "s"))
        throw UsageError(option + " " + text + "; expected a time above 0, as 16ms or 0.5s");
    return unit == "s" ? value * 1e3 : value;
}

}  // namespace lobe::measure
