/// Optical constants by name: complex indices of metals, and reflectances at normal incidence as teaching
/// tables give them.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace lobe::shading {

/// eta + i k at 630, 532 and 465 nm (titanium and platinum: 642, 529 and 464 nm), of metals in air.
struct Metal {
    std::string name;
    glm::dvec3 eta, k;
};

/// Interpolated from measured spectra (Palik, Handbook of Optical Constants of Solids, and others), as
/// published with pbrt and Mitsuba.
const std::vector<Metal>& metals();

/// Throws UsageError "WHERE 'NAME'; expected one of ..." with the nearest name.
const Metal& requireMetal(const std::string& name, const std::string& where);

/// Reflectance at normal incidence, linear RGB.
struct NamedReflectance {
    std::string name;
    glm::dvec3 f0;
};

/// The table of Bala's lecture on shading (Cornell CS 5625, 2013), after Akenine-Moeller et al., Real-Time
/// Rendering.
const std::vector<NamedReflectance>& namedReflectances();

}  // namespace lobe::shading
