#include "reference/lobe_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/sphere.hpp"

namespace lobe::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLeastWidth = 1e-5;

/// GGX's distribution of half vectors times their cosine, 1/sr of half vectors (Walter et al., EGSR 2007).
/// `h` need not be unit: tan^2 comes from its components, without cancellation.
double halfVectorDensity(const glm::dvec3& h, double alpha) {
    const double across = h.x * h.x + h.y * h.y, along = h.z * h.z;
    const double a2 = alpha * alpha, sum = across + along;
    const double d = (across + a2 * along) / sum;
    return a2 * std::sqrt(along / sum) / (kPi * d * d);
}

}  // namespace

LobeSampler::LobeSampler(const Brdf& brdf, std::span<const double> values, const glm::dvec3& wo) : wo_(wo) {
    const double sharpness = brdf.lobeSharpness ? brdf.lobeSharpness(values) : 0.0;
    if (!(sharpness > 0.0)) return;
    // A GGX lobe of width alpha changes by at most 2 / alpha (docs/numerics.md).
    alphas_[0] = std::clamp(2.0 / sharpness, kLeastWidth, 1.0);
    alphas_[1] = std::sqrt(alphas_[0]);
    shares_[0] = 0.3;
    shares_[1] = 0.45;
    shares_[2] = 0.25;
}

glm::dvec3 LobeSampler::draw(double u, double v, double w) const {
    if (w < shares_[0]) return cosineHemisphere({u, v});
    const double alpha = alphas_[w < shares_[0] + shares_[1] ? 0 : 1];
    const double a2 = alpha * alpha;
    const double sin2 = a2 * u / (1.0 + (a2 - 1.0) * u);
    const double phi = 2.0 * kPi * v, s = std::sqrt(sin2);
    const glm::dvec3 h(s * std::cos(phi), s * std::sin(phi), std::sqrt(std::max(0.0, 1.0 - sin2)));
    return glm::normalize(2.0 * glm::dot(wo_, h) * h - wo_);
}

double LobeSampler::density(const glm::dvec3& wi) const {
    double sum = wi.z > 0.0 ? shares_[0] * wi.z / kPi : 0.0;
    glm::dvec3 h = wi + wo_;
    const double length = glm::length(h);
    if (shares_[1] == 0.0 || !(length > 0.0)) return sum;
    if (h.z < 0.0) h = -h;
    const double jacobian = 4.0 * std::abs(glm::dot(wo_, h)) / length;
    if (!(jacobian > 0.0)) return sum;
    for (int i : {0, 1})
        sum += shares_[i + 1] * halfVectorDensity(h, alphas_[i]) / jacobian;
    return sum;
}

}  // namespace lobe::reference
