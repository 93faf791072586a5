/// Reflectance of a smooth interface against the angle of incidence: exact, and Schlick's approximation.
#pragma once

#include "plot/sampler.hpp"

namespace lobe::plot {

/// An interface for one colour channel.
struct Interface {
    std::string label;  ///< "red", or empty where all channels are alike
    double eta, k;
};

struct FresnelRequest {
    std::string name;                   ///< "gold", "eta 1.5": for titles
    std::vector<Interface> interfaces;  ///< one, or three for red, green and blue
    int angles = 361;                   ///< from 0 to 90 degrees
};

struct FresnelPoint {
    double angle;  ///< degrees
    double exact;  ///< for unpolarised light
    double s, p;   ///< perpendicular and parallel to the plane of incidence; in double
    double schlick;
};

struct FresnelCurve {
    Interface interface;
    double f0;  ///< exact reflectance at normal incidence, from which Schlick's starts
    std::vector<FresnelPoint> points;
    double largestDifference = 0.0;  ///< of Schlick's from the exact one, signed
    double atAngle = 0.0;            ///< degrees
};

struct FresnelCurves {
    FresnelRequest request;
    std::vector<FresnelCurve> curves;
};

/// The index whose reflectance at normal incidence is `f0`, 0 <= f0 < 1.
double indexOf(double f0);

/// Exact and Schlick's from the GLSL (or twin) of `mirror`; throws UsageError for constants out of its range.
FresnelCurves computeFresnel(const Sampler& sampler, const FresnelRequest& request);

}  // namespace lobe::plot
