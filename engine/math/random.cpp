#include "math/random.hpp"

#include <bit>
#include <cmath>

namespace lobe {

Pcg32::Pcg32(uint64_t seed, uint64_t stream) : increment_((stream << 1U) | 1U) {
    next();
    state_ += seed;
    next();
}

uint32_t Pcg32::next() {
    const uint64_t old = state_;
    state_ = old * 6364136223846793005ULL + increment_;
    const auto mixed = static_cast<uint32_t>(((old >> 18U) ^ old) >> 27U);
    return std::rotr(mixed, static_cast<int>(old >> 59U));
}

double Pcg32::uniform() {
    const uint64_t high = next() >> 5U;
    const uint64_t low = next() >> 6U;
    return static_cast<double>((high << 26U) | low) * 0x1p-53;
}

double Pcg32::uniform(double low, double high) {
    return low + (high - low) * uniform();
}

double Pcg32::logUniform(double low, double high) {
    return low * std::pow(high / low, uniform());
}

uint32_t Pcg32::below(uint32_t bound) {
    const uint32_t threshold = (0U - bound) % bound;
    uint32_t value = next();
    while (value < threshold)
        value = next();
    return value % bound;
}

double radicalInverse(uint32_t base, uint64_t index) {
    double fraction = 1.0;
    double value = 0.0;
    while (index > 0) {
        fraction /= base;
        value += fraction * static_cast<double>(index % base);
        index /= base;
    }
    return value;
}

glm::dvec2 halton2(uint64_t index) {
    return {radicalInverse(2, index), radicalInverse(3, index)};
}

}  // namespace lobe
