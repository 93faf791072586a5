/// Sobol points under random scrambling: well spread in every pixel, different from pixel to pixel.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace lobe {

/// Sobol's sequence, scrambled after Owen by hashing (B. Burley, Practical hash-based Owen scrambling, JCGT
/// 9(4), 2020). The same everywhere and in every run for one pixel, seed, index and dimension. Dimensions 4 i
/// to 4 i + 3 are one sequence in four dimensions, shuffled independently of other such groups: stratify
/// together what belongs together. In the first two of a group, each elementary interval of area 2^-k holds
/// one of the first 2^k points.
class OwenSobol {
public:
    /// Other seeds are other randomisations, as if independent: their means estimate the error.
    OwenSobol(const glm::uvec2& pixel, uint64_t seed);
    /// In [0, 1), a multiple of 2^-32.
    double at(uint32_t index, uint32_t dimension) const;

private:
    uint64_t key_;
};

}  // namespace lobe
