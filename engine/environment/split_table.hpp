/// What of a constant environment a model's terms reflect, and from where, by angle of view and width: the
/// part of a prefiltered environment that does not depend on the map (Karis, SIGGRAPH 2013; Lagarde and de
/// Rousiers, 2014), from the model's twin.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "environment/zonal_kernel.hpp"
#include "fit/area_table.hpp"

namespace lobe::environment {

/// Angles at equal steps of sqrt(N.V), from 1 / kAngles of the first to 1.
inline constexpr int kAngles = 40;
double cosineOfNode(int node);

struct SplitNode {
    std::array<glm::dvec3, 2> albedo{glm::dvec3(0.0), glm::dvec3(0.0)};  ///< of AreaTerms::terms
    double base = 1.0;  ///< mean of AreaTerms::base over the cosine
    /// Unit, middle of the terms' light: across the normal towards the mirrored direction, and along it.
    glm::dvec2 direction{0.0, 1.0};
    double spread = 0.0;  ///< as ZonalKernel::spread
};

/// Node by node for one set of values.
std::vector<SplitNode> splitNodes(const Brdf& brdf, std::span<const double> values);

/// The model's terms about their middle, the mean of all azimuths, as seen from the normal; from where they
/// reflect most, if they reflect next to nothing there.
ZonalKernel lobeKernel(const Brdf& brdf, std::span<const double> values, const std::vector<SplitNode>& nodes,
                       double scale = 1.0);

}  // namespace lobe::environment
