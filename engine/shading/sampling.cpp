#include "shading/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "math/sphere.hpp"
#include "shading/phong_family.hpp"

namespace lobe {
namespace {

const double kPi = glm::pi<double>();
constexpr double kDefensiveShare = 0.1;

double square(double x) {
    return x * x;
}

/// z = cos = (1 - u1)^(1 / (n + 1)) about +Z; the sine without 1 - cos^2.
glm::dvec3 drawPower(double n, double u1, double cosPhi, double sinPhi) {
    const double logCosine = std::log1p(-u1) / (n + 1.0);
    const double sine = std::sqrt(-std::expm1(2.0 * logCosine));
    return {sine * cosPhi, sine * sinPhi, std::exp(logCosine)};
}

/// Heitz, JCGT 7(4), 2018.
glm::dvec3 drawVisible(const glm::dvec3& wo, double ax, double ay, double u1, double u2) {
    const glm::dvec3 v = glm::normalize(glm::dvec3(ax * wo.x, ay * wo.y, wo.z));
    const double across = std::hypot(v.x, v.y);
    const glm::dvec3 t1 =
        across > 0.0 ? glm::dvec3(-v.y / across, v.x / across, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 t2 = glm::cross(v, t1);
    const double r = std::sqrt(u1);
    const double phi = 2.0 * kPi * u2;
    const double a = r * std::cos(phi);
    const double s = 0.5 * (1.0 + v.z);
    const double b = (1.0 - s) * std::sqrt(std::max(0.0, 1.0 - a * a)) + s * r * std::sin(phi);
    const glm::dvec3 h = a * t1 + b * t2 + std::sqrt(std::max(0.0, 1.0 - a * a - b * b)) * v;
    return glm::normalize(glm::dvec3(ax * h.x, ay * h.y, std::max(0.0, h.z)));
}

/// exp(-tan^2) / cos^3 of the half vector.
double gaussian(const glm::dvec3& h, double ax, double ay) {
    const double exponent = (square(h.x / ax) + square(h.y / ay)) / square(h.z);
    // Beyond, exp() is 0 in double, and so may be cos^3.
    return exponent < 740.0 ? std::exp(-exponent) / (h.z * h.z * h.z) : 0.0;
}

double powerOfNormal(const glm::dvec3& h, double nu, double nv) {
    const double sine2 = h.x * h.x + h.y * h.y;
    const double exponent = sine2 > 0.0 ? (nu * h.x * h.x + nv * h.y * h.y) / sine2 : nu;
    return shading::cosinePower(h.z, std::sqrt(sine2), exponent);
}

}  // namespace

void SamplingLobes::add(const SamplingLobe& lobe) {
    if (!(lobe.weight > 0.0 && std::isfinite(lobe.weight))) return;
    if (count_ < kMost) {
        lobes_[count_++] = lobe;
        return;
    }
    SamplingLobe& lightest =
        *std::min_element(lobes_.begin(), lobes_.end(),
                          [](const SamplingLobe& a, const SamplingLobe& b) { return a.weight < b.weight; });
    if (lightest.weight < lobe.weight) lightest = lobe;
}

glm::dvec3 SamplingMixture::Entry::turned(const glm::dvec3& v) const {
    return {cosine * v.x + sine * v.y, cosine * v.y - sine * v.x, v.z};
}

glm::dvec3 SamplingMixture::Entry::turnedBack(const glm::dvec3& v) const {
    return {cosine * v.x - sine * v.y, cosine * v.y + sine * v.x, v.z};
}

SamplingMixture::SamplingMixture(const SamplingLobes& lobes, const glm::dvec3& wo) : wo_(wo) {
    double largest = 0.0;
    for (const SamplingLobe& lobe : lobes.all())
        largest = std::max(largest, lobe.weight);
    double sum = 0.0;
    for (const SamplingLobe& lobe : lobes.all())
        sum += lobe.weight / largest;
    add({}, sum > 0.0 ? kDefensiveShare : 1.0);
    for (const SamplingLobe& lobe : lobes.all())
        add(lobe, (1.0 - kDefensiveShare) * (lobe.weight / largest) / sum);
}

void SamplingMixture::add(const SamplingLobe& lobe, double share) {
    Entry& entry = entries_[count_];
    entry.lobe = lobe;
    entry.upTo = (count_ > 0 ? entries_[count_ - 1].upTo : 0.0) + share;
    entry.cosine = std::cos(lobe.rotation);
    entry.sine = std::sin(lobe.rotation);
    ++count_;
    switch (lobe.shape) {
        case LobeShape::cosine:
            entry.factor = share / kPi;
            break;
        case LobeShape::ggxVisibleNormals: {
            // D G1 / (4 N.V); G1 / N.V without a division by N.V.
            const glm::dvec3 v = entry.turned(wo_);
            const double stretched = std::sqrt(square(lobe.x * v.x) + square(lobe.y * v.y) + square(v.z));
            entry.factor = share / (2.0 * (v.z + stretched)) / (kPi * lobe.x * lobe.y);
            break;
        }
        case LobeShape::gaussianSlopes:
            entry.factor = share / (4.0 * kPi * lobe.x * lobe.y);
            break;
        case LobeShape::powerNormals:
            entry.factor = share * std::sqrt((lobe.x + 1.0) * (lobe.y + 1.0)) / (8.0 * kPi);
            break;
        case LobeShape::power:
            entry.factor = share * (lobe.x + 1.0) / (2.0 * kPi);
            break;
    }
}

glm::dvec3 SamplingMixture::drawNormal(const Entry& entry, double u1, double u2) const {
    const SamplingLobe& lobe = entry.lobe;
    const double c = std::cos(2.0 * kPi * u2);
    const double s = std::sin(2.0 * kPi * u2);
    if (lobe.shape == LobeShape::ggxVisibleNormals)
        return entry.turnedBack(drawVisible(entry.turned(wo_), lobe.x, lobe.y, u1, u2));
    if (lobe.shape == LobeShape::gaussianSlopes) {
        const double slope = std::sqrt(-std::log1p(-u1));
        return entry.turnedBack(glm::normalize(glm::dvec3(lobe.x * slope * c, lobe.y * slope * s, 1.0)));
    }
    const double x = std::sqrt(lobe.y + 1.0) * c;
    const double y = std::sqrt(lobe.x + 1.0) * s;
    const double length = std::hypot(x, y);
    const double exponent = (lobe.x * x * x + lobe.y * y * y) / (length * length);
    return entry.turnedBack(drawPower(exponent, u1, x / length, y / length));
}

glm::dvec3 sampleDirection(const SamplingMixture& mixture, double u0, double u1, double u2) {
    size_t i = 0;
    while (i + 1 < mixture.count_ && u0 >= mixture.entries_[i].upTo)
        ++i;
    const SamplingMixture::Entry& entry = mixture.entries_[i];
    if (entry.lobe.shape == LobeShape::cosine) {
        const double r = std::sqrt(u1);
        return {r * std::cos(2.0 * kPi * u2), r * std::sin(2.0 * kPi * u2), std::sqrt(1.0 - u1)};
    }
    if (entry.lobe.shape == LobeShape::power)
        return frameAbout(entry.lobe.axis) *
               drawPower(entry.lobe.x, u1, std::cos(2.0 * kPi * u2), std::sin(2.0 * kPi * u2));
    const glm::dvec3 h = mixture.drawNormal(entry, u1, u2);
    return glm::normalize(2.0 * glm::dot(mixture.wo_, h) * h - mixture.wo_);
}

double samplingDensity(const SamplingMixture& mixture, const glm::dvec3& wi) {
    if (mixture.empty()) return 0.0;
    // A normal that faces away from wo mirrors it to below the horizon: there, it is minus the half vector.
    const glm::dvec3 sum = wi + mixture.wo_;
    const double length = glm::length(sum);
    const glm::dvec3 half = length > 0.0 ? sum / length : glm::dvec3(0.0);
    const glm::dvec3 normal = half.z < 0.0 ? -half : half;
    const double vh = 0.5 * length;
    double density = 0.0;
    for (size_t i = 0; i < mixture.count_; ++i) {
        const SamplingMixture::Entry& entry = mixture.entries_[i];
        const SamplingLobe& lobe = entry.lobe;
        if (lobe.shape == LobeShape::cosine) {
            density += entry.factor * std::max(wi.z, 0.0);
        } else if (lobe.shape == LobeShape::power) {
            density += entry.factor *
                       shading::cosinePower(glm::dot(lobe.axis, wi), glm::length(glm::cross(lobe.axis, wi)),
                                            lobe.x) *
                       (glm::dot(lobe.axis, wi) > 0.0 ? 1.0 : 0.0);
        } else if (lobe.shape == LobeShape::ggxVisibleNormals) {
            const glm::dvec3 h = entry.turned(half);
            if (half.z > 0.0)
                density += entry.factor / square(square(h.x / lobe.x) + square(h.y / lobe.y) + square(h.z));
        } else if (normal.z > 0.0) {
            const glm::dvec3 h = entry.turned(normal);
            density += entry.factor / vh *
                       (lobe.shape == LobeShape::gaussianSlopes ? gaussian(h, lobe.x, lobe.y)
                                                                : powerOfNormal(h, lobe.x, lobe.y));
        }
    }
    return density;
}

}  // namespace lobe
