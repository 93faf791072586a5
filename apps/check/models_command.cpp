// lobe-check models: every registered model's GLSL against its twin.
#include <iomanip>
#include <iostream>
#include <sstream>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/resources.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "gl/context.hpp"
#include "harness/model_survey.hpp"
#include "lobe_paths.hpp"
#include "run_report.hpp"

namespace lobe::app {
namespace {

using harness::ModelSurvey;
using nlohmann::ordered_json;

std::vector<const Brdf*> chosenModels(const std::vector<std::string>& names) {
    std::vector<const Brdf*> models;
    models.reserve(names.size());
    for (const std::string& name : names)
        models.push_back(&requireBrdf(name));
    if (names.empty())
        for (const Brdf& brdf : allBrdfs())
            models.push_back(&brdf);
    return models;
}

ordered_json toJson(const ModelSurvey& survey, const Brdf& brdf) {
    ordered_json entry = {{"name", survey.name},
                          {"title", brdf.title},
                          {"rows", survey.rows},
                          {"stopped_by_time", survey.stoppedByTime},
                          {"values", survey.figures.values},
                          {"worst_units", survey.figures.worstUnits},
                          {"allowed_units", 16.0},
                          {"worst_relative", survey.figures.worstRelative},
                          {"worst_row", survey.figures.worstRow},
                          {"worst_ulp", survey.figures.worstUlp},
                          {"ill_conditioned_share", survey.figures.illConditionedShare},
                          {"reciprocal", brdf.traits.reciprocal},
                          {"asymmetry", survey.asymmetry},
                          {"energy_conserving", brdf.traits.energyConserving},
                          {"albedo", ordered_json::array()},
                          {"failing", survey.failing},
                          {"seconds", survey.seconds}};
    for (const auto& [cosine, value] : survey.albedo)
        entry["albedo"].push_back({{"cosine", cosine}, {"value", value}});
    if (!survey.firstFault.empty()) entry["message"] = survey.firstFault;
    return entry;
}

std::string brief(double value) {
    std::ostringstream text;
    text << std::setprecision(2) << value;
    return text.str();
}

void printHead() {
    std::cout << std::left << std::setw(20) << "model" << std::right << std::setw(9) << "rows" << std::setw(8)
              << "units" << std::setw(10) << "relative" << std::setw(6) << "ulp" << std::setw(9) << "ill"
              << std::setw(12) << "asymmetry" << std::setw(22) << "albedo 0, 60, 84 deg" << std::setw(8)
              << "s"
              << "\n";
}

void print(const ModelSurvey& survey) {
    std::string albedo;
    for (const auto& [cosine, value] : survey.albedo)
        albedo += (albedo.empty() ? "" : ", ") + brief(value);
    std::cout << std::left << std::setw(20) << survey.name << std::right << std::setw(9) << survey.rows
              << std::setw(8) << brief(survey.figures.worstUnits) << std::setw(10)
              << brief(survey.figures.worstRelative) << std::setw(6) << survey.figures.worstUlp
              << std::setw(8) << brief(100.0 * survey.figures.illConditionedShare) << "%" << std::setw(12)
              << brief(survey.asymmetry) << std::setw(22) << albedo << std::setw(8) << brief(survey.seconds)
              << (survey.stoppedByTime ? "  (stopped by the time limit)" : "") << std::endl;
    if (survey.failing > 0)
        std::cout << "  FAILED: " << survey.failing << " rows differ from the twin, first "
                  << survey.firstFault << std::endl;
}

}  // namespace

int modelsCommand(const std::vector<std::string>& arguments) {
    CommandLine line("lobe-check models",
                     "Compare every registered model's GLSL with its double-precision twin.");
    std::vector<std::string> names;
    gl::ContextRequest request;
    harness::SurveySettings settings;
    std::string backend = "auto";
    std::string json;
    double timeLimit = settings.timeLimit.count();
    CLI::App& app = line.app();
    app.add_option("NAME", names, "models; all if none is named");
    app.add_option("--backend", backend, "auto, egl, osmesa or glfw [auto]")->type_name("NAME");
    app.add_option("--device", request.device, "EGL device, as lobe info lists them")->type_name("N");
    app.add_option("--inputs", settings.rows, "rows a model [100000]")
        ->type_name("N")
        ->check(CLI::Range(uint64_t{1}, uint64_t{1} << 32));
    app.add_option("--seed", settings.seed, "of the rows [1]")->type_name("N");
    app.add_option("--time-limit", timeLimit, "a model, in seconds: stops at fewer rows [60]")
        ->type_name("S");
    app.add_option("--json", json, "write JSON; - is standard output")->type_name("FILE");
    if (!line.parse(arguments)) return 0;
    if (!(timeLimit > 0.0)) throw UsageError("--time-limit; expected more than 0 s");
    settings.timeLimit = std::chrono::duration<double>(timeLimit);
    request.backend = gl::parseBackend(backend);
    const std::vector<const Brdf*> models = chosenModels(names);

    const auto context = gl::Context::create(request);
    const gl::ShaderLibrary library(shaderDirectory());
    ordered_json report = {{"schema", 1},
                           {"version", paths::kVersion},
                           {"backend", context->info().backend},
                           {"renderer", context->info().renderer},
                           {"seed", settings.seed},
                           {"models", ordered_json::array()}};
    const bool silent = json == "-";
    if (!silent) {
        std::cout << context->info().backend << ", " << context->info().renderer << "\n";
        printHead();
    }
    bool failed = false;
    for (const Brdf* brdf : models) {
        const ModelSurvey survey = harness::surveyModel(library, *brdf, settings);
        failed |= survey.failing > 0;
        report["models"].push_back(toJson(survey, *brdf));
        if (!silent) print(survey);
    }
    if (!silent)
        std::cout << "units: of 16 x 2^-24 (4 + c) allowed, c the condition number; relative: of the same "
                     "row; ulp: worst "
                     "where c <= 4;\nill: too ill-conditioned to tell; asymmetry: of f(L, V) and f(V, L); "
                     "albedo: for the "
                     "default parameters\n";
    writeReport(json, report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    return static_cast<int>(failed ? ExitCode::checkFailed : ExitCode::ok);
}

}  // namespace lobe::app
