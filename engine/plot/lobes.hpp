/// Lobes of models in the plane of incidence.
#pragma once

#include <optional>

#include "plot/sampler.hpp"

namespace lobe::plot {

/// What is the radius, for light from a fixed direction.
enum class Quantity {
    fCos,    ///< f_r cos(theta_i): reflected radiance over the irradiance on a surface that faces the light
    f,       ///< f_r
    fCosOut  ///< f_r cos(theta_o): radiant intensity that leaves a piece of surface, over the flux it gets
};

struct LobePoint {
    double angle;  ///< of the eye, degrees from the normal, positive on the mirrored side
    double value;  ///< 1/sr
};

struct Lobe {
    size_t model;      ///< index into Lobes::models
    double incidence;  ///< degrees
    std::vector<LobePoint> points;
    double mirror = 0.0;  ///< reflectance of an ideally mirrored part; 0 for none
};

struct LobesRequest {
    std::vector<Model> models;
    std::vector<double> incidences{0.0, 30.0, 60.0};  ///< degrees
    Quantity quantity = Quantity::fCos;
    Channel channel = Channel::luminance;
    double azimuth = 0.0;  ///< of the plane of incidence against the tangent, degrees
};

/// One lobe a model and incidence, models outermost.
struct Lobes {
    LobesRequest request;
    std::vector<Lobe> lobes;
};

/// Sampled every half degree, and finer until neighbours differ by less than 1 % of the lobe's peak.
Lobes computeLobes(const Sampler& sampler, const LobesRequest& request);

/// Light along `wi` seen at each of the angles, in the plane of incidence.
std::vector<Pair> pairsAt(const glm::dvec3& wi, const std::vector<double>& angles, double azimuth);

/// The lobe of any value that is a function of the eye's angle, sampled in the same way.
std::vector<LobePoint> sampleLobe(
    double mirrorAngle, const std::function<std::vector<double>(const std::vector<double>& angles)>& values);

/// f_r cos(theta_i) as `quantity`.
double asQuantity(Quantity quantity, double fCos, const Pair& pair);

double peakOf(const std::vector<LobePoint>& points);

}  // namespace lobe::plot
