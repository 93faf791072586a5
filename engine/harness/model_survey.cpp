#include "harness/model_survey.hpp"

#include <algorithm>
#include <cmath>

#include "harness/albedo.hpp"

namespace lobe::harness {
namespace {

/// Rows drawn and compared at once: of each of eight kinds, so many.
constexpr int kPerKind = 1024;

/// Values below are at the end of what floats hold, where both sides round differently.
constexpr float kSmallest = 1e-30f;

std::vector<glm::vec3> valuesOfRows(const BrdfEvaluator& evaluator, const std::vector<BrdfRow>& rows) {
    std::vector<glm::vec3> values;
    for (const BrdfResult& result : evaluator.evaluate(rows))
        values.push_back(result.fCos);
    return values;
}

double asymmetryOf(const BrdfEvaluator& evaluator, std::vector<BrdfRow> rows,
                   const std::vector<glm::vec3>& there) {
    for (BrdfRow& row : rows)
        std::swap(row.wi, row.wo);
    const std::vector<glm::vec3> back = valuesOfRows(evaluator, rows);
    double worst = 0.0;
    for (size_t i = 0; i < rows.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            if (there[i][c] < kSmallest || back[i][c] < kSmallest) continue;
            const double a = double(there[i][c]) / double(rows[i].wo.z);  // wi before the exchange
            const double b = double(back[i][c]) / double(rows[i].wi.z);
            worst = std::max(worst, std::abs(a - b) / (a + b));
        }
    return worst;
}

ParameterValues defaultValues(const Brdf& brdf) {
    ParameterValues values = brdf.defaults();
    if (brdf.table) {
        const TableRows table = brdf.table->examples().front().second;
        values.insert(values.end(), table.begin(), table.end());
    }
    return values;
}

}  // namespace

ModelSurvey surveyModel(const gl::ShaderLibrary& library, const Brdf& brdf, const SurveySettings& settings) {
    const auto started = std::chrono::steady_clock::now();
    const auto elapsed = [&] { return std::chrono::steady_clock::now() - started; };
    ModelSurvey survey;
    survey.name = brdf.name;
    ModelCheck check(brdf);
    const BrdfEvaluator evaluator(library, brdf);
    while (survey.rows < settings.rows && !survey.stoppedByTime) {
        std::vector<BrdfRow> rows = brdfRows(brdf, kPerKind, settings.seed + survey.rows);
        // The last table is thinned evenly, so that every kind stays.
        const uint64_t left = settings.rows - survey.rows;
        if (left < rows.size()) {
            std::vector<BrdfRow> thinned;
            for (uint64_t i = 0; i < left; ++i)
                thinned.push_back(std::move(rows[i * rows.size() / left]));
            rows = std::move(thinned);
        }
        const std::vector<glm::vec3> values = valuesOfRows(evaluator, rows);
        check.add(rows, values);
        if (survey.rows == 0) survey.asymmetry = asymmetryOf(evaluator, rows, values);
        survey.rows += rows.size();
        survey.stoppedByTime = survey.rows < settings.rows && elapsed() > settings.timeLimit;
    }
    survey.figures = check.figures();
    survey.failing = check.faults().size();
    if (!check.faults().empty()) survey.firstFault = check.faults().front().message;
    const ParameterValues values = defaultValues(brdf);
    for (const double cosine : {1.0, 0.5, 0.1})
        survey.albedo.emplace_back(cosine, albedo(brdf, values, cosine).value);
    survey.seconds = std::chrono::duration<double>(elapsed()).count();
    return survey;
}

}  // namespace lobe::harness
