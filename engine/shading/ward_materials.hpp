/// Ward's measured materials (docs/models/ward_anisotropic.md).
#pragma once

#include <string>
#include <vector>

namespace lobe::shading {

struct WardMaterial {
    std::string name;
    double diffuse, specular, alphaX, alphaY;
};

inline constexpr const char* kWardMaterialSource =
    "G. J. Ward, Measuring and modeling anisotropic reflection, SIGGRAPH 1992, table 1";

/// The ten materials of the table; those with equal widths are the isotropic ones.
const std::vector<WardMaterial>& wardMaterials();

}  // namespace lobe::shading
