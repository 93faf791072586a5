/// The slice of a model's values over half angle and difference angle, as an image.
#pragma once

#include <array>

#include "plot/sampler.hpp"

namespace lobe::plot {

struct SliceRequest {
    Model model;
    double phiD = 90.0;  ///< degrees: azimuth of the light about the half vector
    int cells = 90;      ///< along each side
};

struct SliceCell {
    double thetaH, thetaD;        ///< degrees, centre of the cell
    glm::dvec3 f;                 ///< f_r, 1/sr
    std::array<uint8_t, 3> tone;  ///< what is shown
};

/// Rows of equal theta_d.
struct Slice {
    SliceRequest request;
    double reference = 0.0;  ///< f_r at which the tone turns from linear to logarithmic, 1/sr
    double brightest = 0.0;  ///< f_r from which on white is shown, 1/sr
    std::vector<SliceCell> cells;
};

/// Tone: ln(1 + f / reference) / ln(1 + brightest / reference), the reference being what a tenth of the slice
/// is below, and the brightest what a hundredth is above, which is shown white. Cells where a direction is
/// below the horizon are 0. Throws UsageError for models that scatter no light.
Slice computeSlice(const Sampler& sampler, const SliceRequest& request);

}  // namespace lobe::plot
