/// Surfaces for He's model by name (docs/models/he.md).
#pragma once

#include <string>
#include <vector>

namespace lobe::shading {

/// Only ratios of the lengths count.
struct HeSurface {
    std::string name;
    std::string source;
    double sigma, tau;  ///< in m
    double wavelength;  ///< of all bands, in m; 0 for those of red, green and blue
    double eta;         ///< of all bands; 0 where `metal` says it
    std::string metal;  ///< a name in metals()
};

const std::vector<HeSurface>& heSurfaces();

}  // namespace lobe::shading
