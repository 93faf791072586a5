/// All that is measured of a model: error against its twin, reciprocity, albedo.
#pragma once

#include <chrono>
#include <functional>

#include "harness/model_check.hpp"

namespace lobe::harness {

struct SurveySettings {
    uint64_t rows = 100'000;
    uint64_t seed = 1;
    std::chrono::duration<double> timeLimit{60.0};  ///< a model; fewer rows are used where it is not enough
};

struct ModelSurvey {
    std::string name;
    uint64_t rows = 0;  ///< that were compared
    bool stoppedByTime = false;
    ModelFigures figures;
    size_t failing = 0;
    std::string firstFault;  ///< empty if none
    /// Largest |f(L, V) - f(V, L)| / (f(L, V) + f(V, L)) of the GLSL, any channel.
    double asymmetry = 0.0;
    /// Directional albedo of the twin for the default parameters, for cosines from 1 to 0.1.
    std::vector<std::pair<double, double>> albedo;
    double seconds = 0.0;
};

/// The context must be current. Throws UsageError for a model without a twin.
ModelSurvey surveyModel(const gl::ShaderLibrary& library, const Brdf& brdf, const SurveySettings& settings);

}  // namespace lobe::harness
