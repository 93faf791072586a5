// The sun through the atmosphere: Preetham, Shirley and Smits, SIGGRAPH 1999, appendix 1 and table 2.
#include <array>
#include <cmath>
#include <numbers>

#include "scene/sky.hpp"
#include "shading/colour_matching.hpp"

namespace lobe {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kShortest = 380.0, kStep = 10.0;  ///< nm
constexpr size_t kCount = 38;                      ///< to 750 nm
using Spectrum = std::array<double, kCount>;

/// Of the sun outside the atmosphere, 100 W/(m^2 sr nm).
constexpr Spectrum kSun = {165.5, 162.3, 211.2, 258.8, 258.2, 242.3, 267.6, 296.6, 305.4, 300.6,
                           306.6, 288.3, 287.1, 278.2, 271.0, 272.3, 263.6, 255.0, 250.6, 253.1,
                           253.5, 251.3, 246.3, 241.7, 236.8, 232.1, 228.2, 223.4, 219.7, 215.3,
                           211.0, 207.3, 202.4, 198.7, 194.3, 190.7, 186.3, 182.6};
constexpr double kSunSolidAngle = 6.7443e-5;  ///< sr, that its radiance is given for

/// Absorption of ozone, 1/cm.
constexpr Spectrum kOzone = {0.0,   0.0,   0.0,   0.0,   0.0,   0.0,   0.0,   0.003, 0.006, 0.009,
                             0.014, 0.021, 0.030, 0.040, 0.048, 0.063, 0.075, 0.085, 0.103, 0.120,
                             0.120, 0.115, 0.125, 0.120, 0.105, 0.090, 0.079, 0.067, 0.057, 0.048,
                             0.036, 0.028, 0.023, 0.018, 0.014, 0.011, 0.010, 0.009};
constexpr double kOzoneAmount = 0.35;  ///< cm at standard temperature and pressure

/// Absorption of water vapour from 690 nm on.
constexpr std::array kVapour = {0.016, 0.024, 0.0125, 1.0, 0.87, 0.061, 0.001};
constexpr size_t kFirstVapour = kCount - kVapour.size();
constexpr double kVapourAmount = 2.0;  ///< cm of precipitable water

}  // namespace

glm::dvec3 sunIrradiance(double turbidity, double elevation) {
    const double zenith = kPi / 2.0 - elevation;
    const double mass = 1.0 / (std::cos(zenith) + 0.15 * std::pow(93.885 - zenith * 180.0 / kPi, -1.253));
    const double aerosol = 0.04608 * turbidity - 0.04586;
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < kCount; ++i) {
        const double wavelength = kShortest + kStep * static_cast<double>(i), micrometres = wavelength * 1e-3;
        double depth = 0.008735 * std::pow(micrometres, -4.08) + aerosol * std::pow(micrometres, -1.3) +
                       kOzone[i] * kOzoneAmount;
        depth *= mass;
        if (i >= kFirstVapour) {
            const double water = kVapour[i - kFirstVapour] * kVapourAmount * mass;
            depth += 0.2385 * water / std::pow(1.0 + 20.07 * water, 0.45);
        }
        sum += shading::colourMatching(wavelength) * (100.0 * kSun[i] * std::exp(-depth) * kStep);
    }
    constexpr double kMostEfficacy = 683.0;  ///< lm/W, of the definition of the lumen
    return insideGamut(shading::linearSrgb(sum) * (kSunSolidAngle * kMostEfficacy / kLumensPerWatt));
}

}  // namespace lobe
