#include "reference/fog.hpp"

#include <algorithm>
#include <cmath>

namespace lobe::reference {

glm::dvec3 fogTransmittance(const Fog& fog, double start, double rise, double length) {
    if (length == 0.0) return glm::dvec3(1.0);
    const double slope = fog.heightFalloff * std::abs(rise);
    // Metres at the lower end's density that count as much as the whole way.
    const double effective = slope > 0.0 ? -std::expm1(-slope * length) / slope : length;
    const double lower = rise < 0.0 && fog.heightFalloff > 0.0 ? start + rise * length : start;
    const double density = std::exp(-fog.heightFalloff * (lower - fog.height));
    glm::dvec3 transmittance;
    for (int c = 0; c < 3; ++c) {
        // A density of nothing over an endless way is nothing; an endless one of no extinction too.
        const double depth =
            fog.extinction[c] == 0.0 || density == 0.0 ? 0.0 : fog.extinction[c] * density * effective;
        transmittance[c] = std::exp(-depth);
    }
    return transmittance;
}

}  // namespace lobe::reference
