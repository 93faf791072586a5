/// What a model says of its lobes, for importance sampling (sampling.hpp does the rest).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace lobe {

enum class LobeShape : uint8_t {
    cosine,             ///< cos(theta_i) / pi
    ggxVisibleNormals,  ///< half vectors of GGX as seen from wo; x, y: widths (Heitz, JCGT 7(4), 2018)
    gaussianSlopes,     ///< half vectors of Beckmann and Ward; x, y: widths m or alpha
    powerNormals,       ///< half vectors, density as cos^e, e = x cos^2(phi_h) + y sin^2(phi_h)
    power,              ///< cos^x about `axis`, which may lie below the horizon
};

struct SamplingLobe {
    LobeShape shape = LobeShape::cosine;
    double weight = 1.0;             ///< about the lobe's albedo at this wo; at least 0, need not sum to 1
    double x = 0.0, y = 0.0;         ///< widths, above 0, or exponents, at least 0
    double rotation = 0.0;           ///< of the x axis from the tangent about the normal, rad
    glm::dvec3 axis{0.0, 0.0, 1.0};  ///< of `power`, unit
};

/// The lobes of a model at one wo, without allocation. Where they are more than fit, the lightest are left
/// out.
class SamplingLobes {
public:
    static constexpr size_t kMost = 16;
    /// Those of weight 0, or of a weight that is not finite, are left out.
    void add(const SamplingLobe& lobe);
    std::span<const SamplingLobe> all() const { return {lobes_.data(), count_}; }

private:
    std::array<SamplingLobe, kMost> lobes_;
    size_t count_ = 0;
};

}  // namespace lobe
