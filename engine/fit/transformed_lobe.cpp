#include "fit/transformed_lobe.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "math/quadrature.hpp"

namespace lobe::fit {

View::View(double oneMinusCos) {
    const double cosine = 1.0 - oneMinusCos;
    const double sine = std::sqrt(oneMinusCos * (1.0 + cosine));
    wo = {sine, 0.0, cosine};
    frame =
        glm::dmat3(glm::dvec3(cosine, 0.0, sine), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(-sine, 0.0, cosine));
}

double TransformedLobe::density(const glm::dvec3& w) const {
    const glm::dvec3 v = map(w);
    if (v.z <= 0.0) return 0.0;
    const double length2 = glm::dot(v, v);
    if (k == 1.0) return glm::one_over_pi<double>() * (a - b * d) * c * v.z / (length2 * length2);
    const double tan2 = (v.x * v.x + v.y * v.y) / (v.z * v.z);
    return (k + 1.0) / glm::two_pi<double>() * std::exp(-0.5 * k * std::log1p(tan2)) * (a - b * d) * c /
           (length2 * std::sqrt(length2));
}

std::vector<glm::dvec3> clipped(std::span<const glm::dvec3> polygon, const glm::dvec3& normal) {
    std::vector<glm::dvec3> kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double ha = glm::dot(a, normal), hb = glm::dot(b, normal);
        if (ha >= 0.0) kept.push_back(a);
        if ((ha >= 0.0) != (hb >= 0.0)) kept.push_back(a + (b - a) * (ha / (ha - hb)));
    }
    return kept;
}

double polygonIntegral(const TransformedLobe& lobe, std::span<const glm::dvec3> polygon) {
    std::vector<glm::dvec3> mapped;
    for (const glm::dvec3& w : polygon)
        mapped.push_back(lobe.map(w));
    mapped = clipped(mapped, {0.0, 0.0, 1.0});
    static const QuadratureRule rule = gaussLegendre(16);
    double sum = 0.0;
    for (size_t i = 0; i < mapped.size(); ++i) {
        const glm::dvec3 &a = mapped[i], &b = mapped[(i + 1) % mapped.size()];
        // The plane of origin and edge, z = (x cos + y sin) of azimuth / cotangent of the foot's angle.
        const double c = a.x * b.y - a.y * b.x;
        const double turn = std::atan2(c, a.x * b.x + a.y * b.y);
        const glm::dvec2 e(b.x * a.z - a.x * b.z, b.y * a.z - a.y * b.z);
        if (turn == 0.0) continue;
        const double foot = std::atan2(c >= 0.0 ? -e.x : e.x, c >= 0.0 ? e.y : -e.y);
        const double start = std::atan2(a.y, a.x);
        const double slopeOfFoot = std::abs(c) / glm::length(e);
        constexpr int kPanels = 64;
        std::vector<double> breaks;
        for (int p = 0; p <= kPanels; ++p)
            breaks.push_back(start + turn * p / kPanels);
        sum += integratePanels(
            [&](double azimuth) {
                const double cosine = std::abs(std::cos(azimuth - foot));
                if (!(cosine > 0.0) || !(glm::length(e) > 0.0)) return 1.0;
                const double slope = slopeOfFoot / cosine;
                return -std::expm1(-0.5 * (lobe.k + 1.0) * std::log1p(slope * slope));
            },
            breaks, rule);
    }
    return sum / glm::two_pi<double>();
}

}  // namespace lobe::fit
