#include "shading/colour_matching.hpp"

#include <cmath>

namespace lobe::shading {
namespace {

/// A Gaussian of different width left and right of its peak.
double hill(double wavelength, double height, double peak, double left, double right) {
    const double t = (wavelength - peak) * (wavelength < peak ? left : right);
    return height * std::exp(-0.5 * t * t);
}

}  // namespace

glm::dvec3 colourMatching(double l) {
    return {hill(l, 0.362, 442.0, 0.0624, 0.0374) + hill(l, 1.056, 599.8, 0.0264, 0.0323) +
                hill(l, -0.065, 501.1, 0.0490, 0.0382),
            hill(l, 0.821, 568.8, 0.0213, 0.0247) + hill(l, 0.286, 530.9, 0.0613, 0.0322),
            hill(l, 1.217, 437.0, 0.0845, 0.0278) + hill(l, 0.681, 459.0, 0.0385, 0.0725)};
}

glm::dvec3 linearSrgb(const glm::dvec3& xyz) {
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

}  // namespace lobe::shading
