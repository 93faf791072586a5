#include "shading/ward_materials.hpp"

namespace lobe::shading {

const std::vector<WardMaterial>& wardMaterials() {
    static const std::vector<WardMaterial> materials{
        {"rolled brass", 0.10, 0.33, 0.050, 0.16},
        {"rolled aluminium", 0.10, 0.21, 0.04, 0.09},
        {"lightly brushed aluminium", 0.15, 0.19, 0.088, 0.13},
        {"varnished plywood", 0.33, 0.025, 0.04, 0.11},
        {"enamel finished metal", 0.25, 0.047, 0.080, 0.096},
        {"painted cardboard box", 0.19, 0.043, 0.076, 0.085},
        {"white ceramic tile", 0.70, 0.050, 0.071, 0.071},
        {"glossy grey paper", 0.29, 0.083, 0.082, 0.082},
        {"ivory computer plastic", 0.45, 0.043, 0.13, 0.13},
        {"plastic laminate", 0.67, 0.070, 0.092, 0.092},
    };
    return materials;
}

}  // namespace lobe::shading
