#include "math/sphere.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace lobe {
namespace {

glm::dvec3 fromHeight(double z, double u) {
    const double r = std::sqrt(std::fmax((1.0 - z) * (1.0 + z), 0.0));
    const double azimuth = glm::two_pi<double>() * u;
    return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

}  // namespace

glm::dvec3 fromPolar(double polar, double azimuth) {
    const double s = std::sin(polar);
    return {s * std::cos(azimuth), s * std::sin(azimuth), std::cos(polar)};
}

glm::dmat3 frameAbout(const glm::dvec3& n) {
    const double s = std::copysign(1.0, n.z);
    const double a = -1.0 / (s + n.z);
    const double b = n.x * n.y * a;
    return {{1.0 + s * n.x * n.x * a, s * b, -s * n.x}, {b, s + n.y * n.y * a, -n.y}, n};
}

glm::dvec3 uniformSphere(const glm::dvec2& u) {
    return fromHeight(1.0 - 2.0 * u.x, u.y);
}
glm::dvec3 uniformHemisphere(const glm::dvec2& u) {
    return fromHeight(1.0 - u.x, u.y);
}
glm::dvec3 cosineHemisphere(const glm::dvec2& u) {
    return fromHeight(std::sqrt(1.0 - u.x), u.y);
}

}  // namespace lobe
