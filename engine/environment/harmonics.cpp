#include "environment/harmonics.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lobe::environment {
namespace {

constexpr size_t kFunctions = 18;
using Functions = std::array<double, kFunctions>;

/// Bands 0, 1, 2 and 4, orthonormal.
Functions functionsAt(const glm::dvec3& n) {
    const double x = n.x, y = n.y, z = n.z, xx = x * x, yy = y * y, zz = z * z;
    return {0.28209479177387814,
            0.4886025119029199 * y,
            0.4886025119029199 * z,
            0.4886025119029199 * x,
            1.0925484305920792 * x * y,
            1.0925484305920792 * y * z,
            0.31539156525252005 * (3.0 * zz - 1.0),
            1.0925484305920792 * x * z,
            0.5462742152960396 * (xx - yy),
            2.5033429417967046 * x * y * (xx - yy),
            1.7701307697799304 * y * z * (3.0 * xx - yy),
            0.9461746957575601 * x * y * (7.0 * zz - 1.0),
            0.6690465435572892 * y * z * (7.0 * zz - 3.0),
            0.10578554691520431 * (35.0 * zz * zz - 30.0 * zz + 3.0),
            0.6690465435572892 * x * z * (7.0 * zz - 3.0),
            0.47308734787878004 * (xx - yy) * (7.0 * zz - 1.0),
            1.7701307697799304 * x * z * (xx - 3.0 * yy),
            0.6258357354491761 * (xx * (xx - 3.0 * yy) - yy * (3.0 * xx - yy))};
}

constexpr size_t kFirstOfBand4 = 9;

int bandOf(size_t function) {
    return function == 0 ? 0 : function < 4 ? 1 : function < kFirstOfBand4 ? 2 : 4;
}

/// Of the clamped cosine, over pi.
double cosineFactor(int band) {
    switch (band) {
        case 0:
            return 1.0;
        case 1:
            return 2.0 / 3.0;
        case 2:
            return 0.25;
        default:
            return -1.0 / 24.0;
    }
}

std::vector<glm::vec3> windowed(const std::vector<glm::dvec3>& coefficients, double lambda) {
    std::vector<glm::vec3> result;
    for (size_t i = 0; i < coefficients.size(); ++i) {
        const double l = bandOf(i);
        result.emplace_back(coefficients[i] / (1.0 + lambda * l * l * (l + 1.0) * (l + 1.0)));
    }
    return result;
}

/// Over directions 2 degrees apart.
double least(const std::vector<glm::vec3>& coefficients) {
    constexpr int kSide = 64;
    double result = HUGE_VAL;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const glm::dvec3 at = irradianceAt(
                coefficients,
                octahedralDirection({(2.0 * x + 1.0) / kSide - 1.0, (2.0 * y + 1.0) / kSide - 1.0}));
            result = std::min({result, at.r, at.g, at.b});
        }
    return result;
}

}  // namespace

glm::dvec3 irradianceAt(const std::vector<glm::vec3>& coefficients, const glm::dvec3& normal) {
    const Functions functions = functionsAt(normal);
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < coefficients.size(); ++i)
        sum += glm::dvec3(coefficients[i]) * functions[i];
    return sum;
}

std::vector<glm::vec3> irradianceHarmonics(const RadianceTree& tree, int order) {
    std::vector<glm::dvec3> sums(order == 2 ? kFirstOfBand4 : kFunctions, glm::dvec3(0.0));
    for (const RadianceTree::Node& node : tree.finest()) {
        const Functions functions = functionsAt(glm::dvec3(node.direction));
        for (size_t i = 0; i < sums.size(); ++i)
            sums[i] += glm::dvec3(node.energy) * functions[i];
    }
    for (size_t i = 0; i < sums.size(); ++i)
        sums[i] *= cosineFactor(bandOf(i));
    if (least(windowed(sums, 0.0)) >= 0.0) return windowed(sums, 0.0);
    double low = 0.0, high = 1e-3;
    while (least(windowed(sums, high)) < 0.0 && high < 1e6)
        high *= 2.0;
    for (int step = 0; step < 20; ++step) {
        const double middle = 0.5 * (low + high);
        (least(windowed(sums, middle)) < 0.0 ? low : high) = middle;
    }
    return windowed(sums, high);
}

}  // namespace lobe::environment
