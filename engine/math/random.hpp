/// Numbers that only look random: the same on every machine and in every run.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace lobe {

/// PCG-XSH-RR 64/32 (O'Neill, HMC-CS-2014-0905, 2014).
class Pcg32 {
public:
    explicit Pcg32(uint64_t seed, uint64_t stream = 0);
    uint32_t next();
    double uniform();                            ///< in [0, 1), 53 bits
    double uniform(double low, double high);     ///< in [low, high)
    double logUniform(double low, double high);  ///< log-uniform between positive bounds
    uint32_t below(uint32_t bound);              ///< in [0, bound) without bias

private:
    uint64_t state_ = 0;
    uint64_t increment_;
};

/// Van der Corput's sequence in a prime base: index 0 gives 0.
double radicalInverse(uint32_t base, uint64_t index);

/// Point i of Halton's sequence in bases 2 and 3.
glm::dvec2 halton2(uint64_t index);

}  // namespace lobe
