/// A lobe in three dimensions.
#pragma once

#include "plot/lobes.hpp"

namespace lobe::plot {

struct SurfaceRequest {
    Model model;
    double incidence = 45.0;  ///< degrees
    Quantity quantity = Quantity::fCos;
    Channel channel = Channel::luminance;
    double azimuth = 0.0;
    int rings = 64;    ///< from the mirrored direction to the horizon
    int sectors = 90;  ///< around it
};

struct SurfacePoint {
    glm::dvec3 direction;  ///< to the eye; x along the tangent
    double value;          ///< 1/sr
};

/// rings[r][s]; the last sector of a ring is its first again.
struct Surface {
    SurfaceRequest request;
    std::vector<std::vector<SurfacePoint>> rings;
};

/// Over the hemisphere, in polar coordinates about the mirrored direction, with rings as close there as the
/// lobe is narrow. Throws UsageError for models that scatter no light.
Surface computeSurface(const Sampler& sampler, const SurfaceRequest& request);

}  // namespace lobe::plot
