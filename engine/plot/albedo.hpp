/// Directional albedo against the angle of incidence and a parameter.
#pragma once

#include "plot/sampler.hpp"

namespace lobe::plot {

struct AlbedoRequest {
    Model model;
    std::string over;            ///< a scalar parameter of the model; empty for the model as it is
    std::vector<double> values;  ///< of that parameter; one that is not used if `over` is empty
    std::vector<double> angles;  ///< of incidence, degrees
    Channel channel = Channel::luminance;
    double azimuth = 0.0;
};

/// albedo[v][a] for values[v] and angles[a].
struct Albedo {
    AlbedoRequest request;
    std::vector<std::vector<double>> albedo;
};

/// Share of the light from each angle of incidence that the surface reflects in all, a mirrored part
/// included: the integral of f_r cos(theta_o) over the hemisphere, by Gauss-Legendre quadrature (order 6 in
/// panels graded about the mirrored direction) of the values that the sampler gives.
std::vector<glm::dvec3> directionalAlbedo(const Sampler& sampler, const Model& model,
                                          const std::vector<double>& angles, double azimuth);

Albedo computeAlbedo(const Sampler& sampler, const AlbedoRequest& request);

}  // namespace lobe::plot
