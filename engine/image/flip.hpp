/// FLIP: the difference that people see when two pictures alternate, 0 to 1 for each pixel.
/// Andersson et al., FLIP: A Difference Evaluator for Alternating Images, HPG 2020; Andersson et al.,
/// Visualizing Errors in Rendered High Dynamic Range Images, Eurographics 2021.
#pragma once

#include <array>

#include "image/planes.hpp"

namespace lobe {

/// Linear Rec.709 red, green and blue.
struct RgbPlanes {
    int width = 0, height = 0;
    std::array<Plane, 3> rgb;
};

/// The papers' viewing conditions: 3840 pixels over 0.7 m, seen from 0.7 m; 67.02 pixels a degree.
double defaultPixelsPerDegree();

/// Of display colours, linear, clamped to 0..1; both pictures of one size. Symmetric.
Plane flip(const RgbPlanes& test, const RgbPlanes& truth, double pixelsPerDegree);

/// Exposures in stops, from the one at which the truth's brightest pixel is just not burnt out to the one at
/// which its median is so; where half the truth or more is black, the median of the rest.
struct ExposureRange {
    double start = 0.0, stop = 0.0;
    int count = 2;  ///< at least 2, about a stop apart; 1 where the truth is black all over
};
ExposureRange exposuresOf(const RgbPlanes& truth);

/// Of radiance (finite; negative is taken as 0): each pixel's largest FLIP over the exposures, under the ACES
/// curve of Narkowicz. Not symmetric: the truth sets the exposures.
Plane hdrFlip(const RgbPlanes& test, const RgbPlanes& truth, double pixelsPerDegree);

}  // namespace lobe
