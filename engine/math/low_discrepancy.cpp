#include "math/low_discrepancy.hpp"

#include <array>

namespace lobe {
namespace {

constexpr uint32_t kDimensions = 4;

/// Columns of a generator matrix, the highest bit first.
using Directions = std::array<uint32_t, 32>;

/// From a primitive polynomial of degree s, its inner coefficients a, and s odd numbers m (Joe and Kuo, SIAM
/// J. Sci. Comput. 30(5), 2008).
constexpr Directions directions(uint32_t s, uint32_t a, const std::array<uint32_t, 3>& m) {
    Directions v{};
    for (uint32_t i = 0; i < 32; ++i) {
        if (i < s) {
            v[i] = m[i] << (31U - i);
            continue;
        }
        v[i] = v[i - s] ^ (v[i - s] >> s);
        for (uint32_t k = 1; k < s; ++k)
            if (((a >> (s - 1U - k)) & 1U) != 0) v[i] ^= v[i - k];
    }
    return v;
}

constexpr Directions vanDerCorput() {
    Directions v{};
    for (uint32_t i = 0; i < 32; ++i)
        v[i] = 1U << (31U - i);
    return v;
}

constexpr std::array<Directions, kDimensions> kSobol{
    vanDerCorput(), directions(1, 0, {1, 0, 0}), directions(2, 1, {1, 3, 0}), directions(3, 1, {1, 3, 1})};

uint32_t sobol(uint32_t index, uint32_t dimension) {
    uint32_t value = 0;
    for (size_t bit = 0; index != 0; index >>= 1U, ++bit)
        if ((index & 1U) != 0) value ^= kSobol[dimension][bit];
    return value;
}

uint32_t reversed(uint32_t x) {
    x = ((x >> 1U) & 0x55555555U) | ((x & 0x55555555U) << 1U);
    x = ((x >> 2U) & 0x33333333U) | ((x & 0x33333333U) << 2U);
    x = ((x >> 4U) & 0x0f0f0f0fU) | ((x & 0x0f0f0f0fU) << 4U);
    x = ((x >> 8U) & 0x00ff00ffU) | ((x & 0x00ff00ffU) << 8U);
    return (x >> 16U) | (x << 16U);
}

/// Flips each bit by a hash of those above it (Laine and Karras, Computer Graphics Forum 30(4), 2011).
uint32_t scrambled(uint32_t x, uint32_t seed) {
    x = reversed(x);
    x += seed;
    x ^= x * 0x6c50b47cU;
    x ^= x * 0xb82f1e52U;
    x ^= x * 0xc7afe638U;
    x ^= x * 0x8d22f6e6U;
    return reversed(x);
}

/// Output function of SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
uint64_t mixed(uint64_t x) {
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31U);
}

}  // namespace

OwenSobol::OwenSobol(const glm::uvec2& pixel, uint64_t seed)
    : key_(mixed(mixed(seed) ^ ((static_cast<uint64_t>(pixel.y) << 32U) | pixel.x))) {}

double OwenSobol::at(uint32_t index, uint32_t dimension) const {
    const auto order = static_cast<uint32_t>(mixed(key_ + 2ULL * (dimension / kDimensions)));
    const auto values = static_cast<uint32_t>(mixed(key_ + 2ULL * dimension + 1ULL));
    return scrambled(sobol(scrambled(index, order), dimension % kDimensions), values) * 0x1p-32;
}

}  // namespace lobe
