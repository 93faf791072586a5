/// Published fits of Lafortune's model (docs/models/lafortune.md).
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace lobe::shading {

struct LafortuneLobe {
    glm::dvec3 cx, cy, cz, n;
};

struct LafortuneFit {
    std::string name;
    std::string source;
    glm::dvec3 diffuse;
    std::vector<LafortuneLobe> lobes;
};

/// Lafortune et al., SIGGRAPH 1997 (blue paint, brushed metal, clay, felt, primer) and Marschner et al., EGSR
/// 1999 (skin), from coefficient files in circulation; Ngan et al., EGSR 2005 (steel). x and y are negative
/// for lobes about the mirrored direction.
const std::vector<LafortuneFit>& lafortuneFits();

}  // namespace lobe::shading
