/// Directions where a surface reflects much, for the light integrals that are sampled.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "shading/brdf.hpp"

namespace lobe::reference {

/// For every model alike, knowing no more of it than how sharp it is: a mixture of the cosine and of two
/// half-vector lobes, one as wide as the model's sharpest and one wider, both with GGX's long tails, so that
/// the density falls off slower than any model's lobe. Unbiased whatever the model; how little it varies
/// depends on how well the lobes fit.
class LobeSampler {
public:
    /// `wo`: unit, in the local frame, z > 0.
    LobeSampler(const Brdf& brdf, std::span<const double> values, const glm::dvec3& wo);

    /// A direction in the local frame for three numbers in [0, 1). May lie below the horizon, where it is
    /// worth nothing.
    glm::dvec3 draw(double u, double v, double w) const;
    /// 1/sr.
    double density(const glm::dvec3& wi) const;

private:
    glm::dvec3 wo_;
    double alphas_[2] = {1.0, 1.0};
    double shares_[3] = {1.0, 0.0, 0.0};  ///< of the cosine and of both lobes
};

}  // namespace lobe::reference
