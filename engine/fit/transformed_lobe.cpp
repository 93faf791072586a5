#include "fit/transformed_lobe.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "math/quadrature.hpp"

namespace lobe::fit {

View::View(double oneMinusCos) {
    const double cosine = 1.0 - oneMinusCos;
    const double sine = std::sqrt(oneMinusCos * (1.0 + cosine));
    wo = {sine, 0.0, cosine};
    frame = glm::dmat3(glm::dvec3(cosine, 0.0, sine), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(-sine, 0.0, cosine));
}

double TransformedLobe::density(const glm::dvec3& w) const {
    const glm::dvec3 v = map(w);
    if (v.z <= 0.0) return 0.0;
    const double length2 = glm::dot(v, v);
    const double tan2 = (v.x * v.x + v.y * v.y) / (v.z * v.z);
    return (k + 1.0) / glm::two_pi<double>() * std::exp(-0.5 * k * std::log1p(tan2)) * (a - b * d) * c /
           (length2 * std::sqrt(length2));
}

}  // namespace lobe::fit
