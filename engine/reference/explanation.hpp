/// Why a pixel has the radiance that it has.
#pragma once

#include <string>
#include <vector>

#include "reference/pixel.hpp"

namespace lobe::reference {

/// One light on one surface.
struct LightShare {
    std::string name;
    Source source = Source::directional;
    /// In the surface's local frame, unit: to the light, of bodies to their centre; zero for the environment,
    /// which has no such direction.
    glm::dvec3 wi{0.0};
    double distance = 0.0;       ///< metres; 0 where it is endless
    glm::dvec3 irradiance{0.0};  ///< on a facing surface, unshadowed; punctual lights only
    glm::dvec3 brdf{0.0};        ///< f_r in that direction, 1/sr
    std::vector<BrdfFactor> factors;
    double visible = 0.0;      ///< share of the unshadowed light that arrives
    glm::dvec3 radiance{0.0};  ///< to the eye, shadowed, before fog and coverage
    glm::dvec3 error{0.0};     ///< its standard error
};

/// One surface that the pixel sees.
struct SurfaceShare {
    SurfacePoint point;
    glm::dvec3 wo{0.0};  ///< to the eye, in the local frame
    /// Of its radiance in the pixel's, mean of the channels: its coverage times what is left in front of it.
    double weight = 0.0;
    glm::dvec3 ambient{0.0};  ///< reflected ambient radiance
    std::vector<LightShare> lights;
};

struct Explanation {
    std::vector<SurfaceShare> surfaces;  ///< front to back; empty: background
    PixelTruth truth;
};

/// Of the ray through the centre of pixel (x, y), row 0 at the top.
Explanation explain(const PixelIntegrator& integrator, const Scene& scene, int x, int y, const Effort& effort,
                    bool shadows);

}  // namespace lobe::reference
