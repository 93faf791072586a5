/// What a model says of itself so that lights with a body can be integrated in closed form
/// (fit/area_table.hpp).
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lobe {

struct Directions;

/// Factors of the parts of f cos(theta_i), from colours alone:
///   f cos = lambert base cos(theta_i) / pi + the sum of weight i times term i
struct AreaWeights {
    glm::dvec3 lambert{0.0};
    std::array<glm::dvec3, 2> terms{glm::dvec3(0.0), glm::dvec3(0.0)};
};

/// The parts themselves at one pair of directions above the surface, with cos(theta_i) and at least 0. `base`
/// is 1 for Lambert's own; where it varies, it varies slowly, and its mean over wi stands for it.
struct AreaTerms {
    double base = 1.0;
    std::array<glm::dvec3, 2> terms{glm::dvec3(0.0), glm::dvec3(0.0)};
};

/// Absent from models that nothing is fitted for: their lights with a body are sampled.
struct AreaModel {
    /// The lobe falls off as a power of the angle, as GGX's does, and not faster: cosines fit it.
    bool powerTail = false;
    /// Number of terms that colours weigh differently, 0 for Lambert, at most 2.
    int terms = 1;
    /// `base` is not 1 everywhere.
    bool baseVaries = false;
    /// Parameters that only `weights` reads; textures may vary them.
    std::vector<std::string> colors;
    /// The scalar parameter that sets the lobe's width, which a texture may vary too; empty for none.
    std::string width;
    /// Of that parameter, above 0, what tables span; values beyond are taken as its ends.
    std::pair<double, double> widths{1e-3, 1.0};

    /// The twin of NAME_area in GLSL.
    std::function<AreaWeights(std::span<const double>)> weights;
    std::function<AreaTerms(const Directions&, std::span<const double>)> parts;
    /// Why nothing is fitted for these values; empty, or absent, if something is.
    std::function<std::string(std::span<const double>)> refuses;
};

}  // namespace lobe
