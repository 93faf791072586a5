/// Adaptive integration over the unit square.
#pragma once

#include <functional>
#include <glm/glm.hpp>

namespace lobe {

struct CubatureOptions {
    double relativeError = 1e-9;  ///< of the integral's largest component
    double absoluteError = 0.0;
    int cells = 1;              ///< the square starts as cells x cells
    int evaluations = 1 << 20;  ///< give up beyond
};

struct CubatureResult {
    glm::dvec3 integral{0.0};
    double error = 0.0;  ///< estimate, of the worst component
    int evaluations = 0;
    bool converged = false;
};

/// Integral of three functions at once over [0, 1]^2: cells are halved where the estimated error is largest,
/// along the axis with the larger fourth difference (Genz, Malik, J. Comput. Appl. Math. 6, 1980: degree 7
/// with degree 5 embedded, 17 points). The estimate is the difference of the two rules, so the result of
/// smooth functions is far better than asked for; a peak between all points of the first cells is missed, as
/// by any rule: choose `cells` by what is known of the function.
CubatureResult integrateSquare(const std::function<glm::dvec3(double, double)>& f,
                               const CubatureOptions& options = {});

}  // namespace lobe
