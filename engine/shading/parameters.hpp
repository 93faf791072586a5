/// Parameters that several models share, and how the entries of the registry spell theirs.
#pragma once

#include <string>
#include <vector>

#include "shading/brdf.hpp"

namespace lobe::shading {

Parameter rgbParameter(std::string name, const glm::dvec3& defaultValue, std::string description);
Parameter scalarParameter(std::string name, double defaultValue, double minimum, double maximum,
                          std::string description);
/// The first choice is the default.
Parameter choiceParameter(std::string name, std::vector<std::string> choices, std::string description);
/// An rgb parameter whose texture is sRGB encoded.
Parameter colorParameter(std::string name, const glm::dvec3& defaultValue, std::string description);

/// Place of the model's table; `name` is that of the scene format's property: "lobes", "file".
Parameter tableParameter(std::string name, std::string description);

/// Three values from `offset` on.
glm::dvec3 rgbAt(std::span<const double> values, size_t offset);

/// Mean of the channels.
inline double meanOf(const glm::dvec3& rgb) {
    return (rgb.r + rgb.g + rgb.b) / 3.0;
}

/// A cosine lobe for the base and one more, whose weights are their albedos, for Brdf::samplingLobes.
SamplingLobes baseAndLobe(double base, const SamplingLobe& lobe);

/// Whether both directions leave the upper side; every model is 0 elsewhere.
inline bool aboveSurface(const Directions& d) {
    return d.wi.z > 0.0 && d.wo.z > 0.0;
}

/// Normal reflectance that glTF gives to all dielectrics (index 1.5).
inline constexpr double kDielectricF0 = 0.04;

}  // namespace lobe::shading
