#include "math/cubature.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

namespace lobe {
namespace {

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

struct Cell {
    glm::dvec2 center, half;
    glm::dvec3 integral{0.0};
    double error = 0.0;
    int axis = 0;  ///< along which it is to be halved
    bool operator<(const Cell& other) const { return error < other.error; }
};

constexpr int kPoints = 17;

// Genz and Malik's rule for two dimensions: distances of its points and weights of degree 7 and 5, for a cell
// of volume 1.
const double kLambda2 = std::sqrt(9.0 / 70.0);
const double kLambda4 = std::sqrt(9.0 / 10.0);
const double kLambda5 = std::sqrt(9.0 / 19.0);
constexpr double kWeight1 = (12824.0 - 9120.0 * 2 + 400.0 * 4) / 19683.0;
constexpr double kWeight2 = 980.0 / 6561.0;
constexpr double kWeight3 = (1820.0 - 400.0 * 2) / 19683.0;
constexpr double kWeight4 = 200.0 / 19683.0;
constexpr double kWeight5 = 6859.0 / 19683.0 / 4.0;
constexpr double kLower1 = (729.0 - 950.0 * 2 + 50.0 * 4) / 729.0;
constexpr double kLower2 = 245.0 / 486.0;
constexpr double kLower3 = (265.0 - 100.0 * 2) / 1458.0;
constexpr double kLower4 = 25.0 / 729.0;

void applyRule(const std::function<glm::dvec3(double, double)>& f, Cell& cell) {
    const auto at = [&](double x, double y) {
        return f(cell.center.x + x * cell.half.x, cell.center.y + y * cell.half.y);
    };
    const glm::dvec3 middle = at(0.0, 0.0);
    glm::dvec3 near(0.0), far(0.0), diagonal(0.0), corners(0.0);
    double fourth[2];
    for (int axis : {0, 1}) {
        const auto pair = [&](double lambda) {
            return axis == 0 ? at(-lambda, 0.0) + at(lambda, 0.0) : at(0.0, -lambda) + at(0.0, lambda);
        };
        const glm::dvec3 inner = pair(kLambda2), outer = pair(kLambda4);
        near += inner;
        far += outer;
        const double ratio = (kLambda2 * kLambda2) / (kLambda4 * kLambda4);
        fourth[axis] = largest(inner - 2.0 * middle - ratio * (outer - 2.0 * middle));
    }
    for (int sx : {-1, 1})
        for (int sy : {-1, 1}) {
            diagonal += at(sx * kLambda4, sy * kLambda4);
            corners += at(sx * kLambda5, sy * kLambda5);
        }
    const double volume = 4.0 * cell.half.x * cell.half.y;
    cell.integral = volume * (kWeight1 * middle + kWeight2 * near + kWeight3 * far + kWeight4 * diagonal +
                              kWeight5 * corners);
    const glm::dvec3 lower =
        volume * (kLower1 * middle + kLower2 * near + kLower3 * far + kLower4 * diagonal);
    cell.error = largest(cell.integral - lower);
    // Where both differences are of the same size, the longer side.
    cell.axis =
        fourth[0] == fourth[1] ? (cell.half.x < cell.half.y ? 1 : 0) : (fourth[1] > fourth[0] ? 1 : 0);
}

}  // namespace

CubatureResult integrateSquare(const std::function<glm::dvec3(double, double)>& f,
                               const CubatureOptions& options) {
    std::priority_queue<Cell> cells;
    CubatureResult result;
    const double half = 0.5 / options.cells;
    for (int y = 0; y < options.cells; ++y)
        for (int x = 0; x < options.cells; ++x) {
            Cell cell{{(2 * x + 1) * half, (2 * y + 1) * half}, {half, half}};
            applyRule(f, cell);
            result.integral += cell.integral;
            result.error += cell.error;
            result.evaluations += kPoints;
            cells.push(cell);
        }
    const auto enough = [&] {
        return result.error <=
               std::max(options.absoluteError, options.relativeError * largest(result.integral));
    };
    while (!enough() && result.evaluations + 2 * kPoints <= options.evaluations) {
        const Cell parent = cells.top();
        cells.pop();
        result.integral -= parent.integral;
        result.error -= parent.error;
        for (const double side : {-0.5, 0.5}) {
            Cell child = parent;
            child.half[parent.axis] *= 0.5;
            child.center[parent.axis] += side * parent.half[parent.axis];
            applyRule(f, child);
            result.integral += child.integral;
            result.error += child.error;
            result.evaluations += kPoints;
            cells.push(child);
        }
    }
    result.converged = enough();
    // Once more from the cells: the running sums have rounded at every step.
    glm::dvec3 sum(0.0);
    double error = 0.0;
    for (; !cells.empty(); cells.pop()) {
        sum += cells.top().integral;
        error += cells.top().error;
    }
    result.integral = sum;
    result.error = error;
    return result;
}

}  // namespace lobe
