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

/// Numbers in [0, 1) that directions are drawn with, spread evenly; the first ones of a longer list are those
/// of a shorter.
std::vector<glm::dvec3> spreadDraws(size_t count, uint64_t seed = 1);

/// Terms at those of the directions drawn that are above the horizon.
std::vector<TermSample> sampleTerms(const Brdf& brdf, std::span<const double> values, const View& view,
                                    std::span<const glm::dvec3> draws);

}  // namespace lobe::fit
