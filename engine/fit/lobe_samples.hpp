/// A model's terms at directions drawn as its lobe is distributed.
#pragma once

#include <vector>

#include "fit/transformed_lobe.hpp"
#include "shading/brdf.hpp"

namespace lobe::fit {

struct TermSample {
    glm::dvec3 w;    ///< in the view's frame
    double cosine;   ///< N.L
    double density;  ///< 1/sr
    AreaTerms terms;
};

/// Terms at the directions above the horizon among `drawn` ones, spread evenly and alike for all views.
std::vector<TermSample> sampleTerms(const Brdf& brdf, std::span<const double> values, const View& view,
                                    size_t drawn, uint64_t seed = 1);

}  // namespace lobe::fit
