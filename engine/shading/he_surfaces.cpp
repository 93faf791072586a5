#include "shading/he_surfaces.hpp"

namespace lobe::shading {
namespace {

constexpr const char* kNgan =
    "fit to MERL data: A. Ngan, F. Durand and W. Matusik, Experimental analysis of BRDF models, EGSR 2005; "
    "without its diffuse part and colour scale";
constexpr const char* kHe =
    "X. D. He et al., A comprehensive physical model for light reflection, SIGGRAPH 1991; values not checked "
    "against the paper";

/// Lengths of the fit are in wavelengths.
HeSurface fitted(const char* name, double sigma, double tau, double eta) {
    constexpr double kWavelength = 1e-6;
    return {name, kNgan, sigma * kWavelength, tau * kWavelength, kWavelength, eta, ""};
}

}  // namespace

const std::vector<HeSurface>& heSurfaces() {
    static const std::vector<HeSurface> surfaces{
        fitted("steel", 0.178, 43.8, 3.03),
        fitted("ss440", 0.12, 30.7, 2.44),
        fitted("chrome", 0.205, 37.6, 8.95),
        fitted("gray plastic", 0.467, 28.3, 1.62),
        fitted("nylon", 0.842, 24.0, 1.45),
        fitted("gold paint", 3.13, 27.9, 2.88),
        {"rough aluminium", kHe, 0.28e-6, 1.77e-6, 0.0, 0.0, "aluminium"},
    };
    return surfaces;
}

}  // namespace lobe::shading
