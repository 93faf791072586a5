/// What stability costs: every model's GLSL against its textbook form (bench/textbook), in nanoseconds an
/// evaluation.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gl/context.hpp"

namespace lobe::bench {

/// Of one model with one kind of Fresnel's equations, where it has a choice.
struct ModelTime {
    std::string name;       ///< "ggx, conductor"
    double model = 0.0;     ///< ns an evaluation, less the floor's
    double textbook = 0.0;  ///< ns an evaluation, less the floor's
    double floor = 0.0;     ///< ns: a pass that reads the same inputs and adds them
    double ratio =
        0.0;  ///< median of the rounds' ratios; 0 where the textbook form takes less than can be told
    double astray =
        0.0;  ///< share of evaluations in which the textbook form is off by more than 1 %, or not finite
};

/// All registered models. `rounds` times, model, textbook and floor are drawn in turn; the times are medians.
/// Surfaces vary from evaluation to evaluation as glTF's do, directions over the hemisphere. `done` is called
/// after each. Throws InputError if a model has no textbook form, or one that computes something else.
std::vector<ModelTime> modelTimes(const gl::ContextInfo& info, int rounds,
                                  const std::function<void(const ModelTime&)>& done);

}  // namespace lobe::bench
