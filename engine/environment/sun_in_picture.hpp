/// The sun in a picture of an environment: found, and taken out as a light of its own.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

#include "environment/environment_map.hpp"

namespace lobe::environment {

/// The brightest spot of a map, in its own axes and without its scale.
struct Spot {
    glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit, the middle of its light
    /// Of what it has above its surroundings, W/m^2 on a surface that faces it.
    glm::dvec3 irradiance{0.0};
    double radius = 0.0;                      ///< rad, of the circle about `direction` that holds it
    double core = 0.0;                        ///< rad, of the one that holds nine tenths of its light
    double share = 0.0;                       ///< of the light of all directions
    double contrast = 0.0;                    ///< brightest texel over its surroundings
    glm::dvec3 surroundings{0.0};             ///< mean radiance around it
    std::vector<std::pair<int, int>> texels;  ///< x, y
};

/// The spot about the brightest texel: those connected with it that are more than kSpotContrast times as
/// bright as the ring of 4 to 8 degrees around it. Without texels where nothing stands out.
Spot brightestSpot(const EnvironmentMap& map);

inline constexpr double kSpotContrast = 4.0;
/// The core of a sun is no wider than this (rad, 3 degrees: blurred by lens and map), at least so many times
/// as bright as what is around it, and gives at least this share of all light; then directions drawn by the
/// lobe that hit it are too rare and too bright, and the shadow that it casts is missed where the map is
/// prefiltered.
inline constexpr double kWidestSun = 0.0524, kLeastContrast = 100.0, kLeastShare = 0.1;

/// Why the spot is not a sun that has to be taken out, in words; empty: it is one.
std::string whyNoSun(const Spot& spot);

/// The map's picture, 32-bit floats, with the spot as bright as its surroundings at most.
Bitmap withoutSpot(const EnvironmentMap& map, const Spot& spot);

/// Solid angle over which a texel of row y weighs in the integral of the map, that is bilinear between
/// texels, sr.
double solidAngleOf(const EnvironmentMap& map, int y);

}  // namespace lobe::environment
