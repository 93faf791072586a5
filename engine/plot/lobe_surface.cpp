#include "plot/lobe_surface.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/error.hpp"
#include "math/quadrature.hpp"
#include "math/sphere.hpp"
#include "plot/geometry.hpp"

namespace lobe::plot {

Surface computeSurface(const Sampler& sampler, const SurfaceRequest& request) {
    requireIncidence(request.incidence);
    requireScatters(request.model);
    const glm::dvec3 wi = toLight(request.incidence, request.azimuth);
    const double sharpness = request.model.brdf->lobeSharpness(request.model.values);
    const glm::dvec3 axis = sharpness > 1.0 ? mirrored(wi) : glm::dvec3(0.0, 0.0, 1.0);
    const std::vector<double> polar = sharpness > 20.0 ? gradedBreaks(0.1 / sharpness, 1.0, request.rings - 1)
                                                       : linearSteps(0.0, 1.0, request.rings);
    const glm::dmat3 frame = frameAbout(axis);
    std::vector<Pair> pairs;
    for (double share : polar)
        for (int s = 0; s <= request.sectors; ++s) {
            const double around = glm::two_pi<double>() * (s % request.sectors) / request.sectors;
            const double side = (frame * fromPolar(glm::half_pi<double>(), around)).z;
            // A hair above the horizon, below which all is 0.
            const double horizon = std::atan2(axis.z, -side) - 1e-4;
            pairs.push_back({wi, frame * fromPolar(horizon * share, around)});
        }
    const std::vector<Sample> samples = sampler.sample(request.model, pairs);
    Surface result{request, {}};
    for (size_t i = 0; i < pairs.size(); ++i) {
        if (i % static_cast<size_t>(request.sectors + 1) == 0) result.rings.emplace_back();
        result.rings.back().push_back(
            {pairs[i].wo,
             asQuantity(request.quantity, channelOf(samples[i].fCos, request.channel), pairs[i])});
    }
    return result;
}

}  // namespace lobe::plot
