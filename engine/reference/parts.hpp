/// Means with their standard error, from independent parts.
#pragma once

#include <array>

#include "reference/direct_light.hpp"

namespace lobe::reference {

/// Parts that share no random number. Eight leave the standard error itself uncertain by about a quarter.
inline constexpr size_t kParts = 8;
using Parts = std::array<glm::dvec3, kParts>;

/// Mean of the parts, and the variance of that mean.
inline Estimate estimateOf(const Parts& parts) {
    Estimate estimate;
    for (const glm::dvec3& part : parts)
        estimate.mean += part / static_cast<double>(kParts);
    for (const glm::dvec3& part : parts)
        estimate.variance +=
            (part - estimate.mean) * (part - estimate.mean) / static_cast<double>(kParts * (kParts - 1));
    return estimate;
}

}  // namespace lobe::reference
