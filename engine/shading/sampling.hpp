/// Importance sampling of reflectance models: directions wi drawn about as f_r cos(theta_i) is distributed
/// for one wo, and the density with which they are drawn.
#pragma once

#include <array>
#include <vector>

#include "shading/brdf.hpp"

namespace lobe {

/// A sum of lobes, ready to draw from. Directions are in the local frame (Directions); wo.z must be above 0.
class SamplingMixture {
public:
    /// Nothing is drawn: empty().
    SamplingMixture() = default;
    /// The lobes' weights are scaled to sum to 1; a cosine lobe gets a tenth, so that the weight f cos / p is
    /// at most 10 pi f (defensive sampling: Hesterberg, Technometrics 37(2), 1995).
    SamplingMixture(const SamplingLobes& lobes, const glm::dvec3& wo);

    /// True for ideal mirrors, whose reflection has no density (Brdf::mirror).
    bool empty() const { return count_ == 0; }

private:
    friend glm::dvec3 sampleDirection(const SamplingMixture&, double, double, double);
    friend double samplingDensity(const SamplingMixture&, const glm::dvec3&);

    struct Entry {
        SamplingLobe lobe;
        double upTo = 1.0;                ///< sum of the weights up to this one
        double factor = 0.0;              ///< weight times what does not depend on wi
        double cosine = 1.0, sine = 0.0;  ///< of the rotation
        glm::dvec3 turned(const glm::dvec3& v) const;
        glm::dvec3 turnedBack(const glm::dvec3& v) const;
    };
    glm::dvec3 drawNormal(const Entry& entry, double u1, double u2) const;
    void add(const SamplingLobe& lobe, double share);

    glm::dvec3 wo_{0.0, 0.0, 1.0};
    std::array<Entry, SamplingLobes::kMost + 1> entries_;
    size_t count_ = 0;
};

/// A unit direction for numbers in [0, 1): u0 picks the lobe. It may lie below the horizon, where models
/// reflect nothing: such a draw counts as 0. The mixture must not be empty.
glm::dvec3 sampleDirection(const SamplingMixture& mixture, double u0, double u1, double u2);

/// Density of sampleDirection at the unit vector wi, in 1/sr. Its integral over the whole sphere is 1. 0 for
/// an empty mixture.
double samplingDensity(const SamplingMixture& mixture, const glm::dvec3& wi);

/// Draws for one model with one set of values. Models that do not declare lobes get a cosine and a GGX lobe
/// whose widths and weights are measured on the twin, in 512 evaluations of fCos. `brdf` must outlive
/// it. Not drawn: the delta of Brdf::mirror.
class BrdfSampler {
public:
    /// Throws UsageError for a model without a twin.
    BrdfSampler(const Brdf& brdf, std::span<const double> values);
    /// For the eye's direction, wo.z > 0. Empty for models that do not scatter (BrdfTraits::scattersLight).
    SamplingMixture at(const glm::dvec3& wo) const;

private:
    struct Fit {
        double alpha, specular, diffuse;
    };
    static constexpr size_t kFits = 8;
    Fit fitAt(const glm::dvec3& wo) const;

    const Brdf* brdf_;
    ParameterValues values_;
    std::array<Fit, kFits> fits_{};  ///< at elevations (i + 1/2) / kFits of a right angle
};

}  // namespace lobe
