#include "plot/geometry.hpp"

#include <cassert>
#include <cmath>

#include "base/error.hpp"
#include "math/sphere.hpp"
#include "plot/model.hpp"

namespace lobe::plot {

glm::dvec3 toLight(double incidence, double azimuth) {
    return fromPolar(glm::radians(-incidence), glm::radians(azimuth));
}

glm::dvec3 toEye(double angle, double azimuth) {
    return fromPolar(glm::radians(angle), glm::radians(azimuth));
}

glm::dvec3 mirrored(const glm::dvec3& w) {
    return {-w.x, -w.y, w.z};
}

std::vector<double> linearSteps(double first, double last, int count) {
    assert(count >= 2);
    std::vector<double> steps;
    steps.reserve(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i)
        steps.push_back(first + (last - first) * i / (count - 1));
    return steps;
}

std::vector<double> geometricSteps(double first, double last, int count) {
    assert(count >= 2 && first > 0.0 && last > 0.0);
    std::vector<double> steps;
    steps.reserve(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i)
        steps.push_back(first * std::pow(last / first, double(i) / (count - 1)));
    steps.back() = last;
    return steps;
}

double rounded(double value, int digits) {
    if (value == 0.0) return 0.0;
    const double power = std::pow(10.0, digits - 1 - std::floor(std::log10(std::abs(value))));
    return std::round(value * power) / power;
}

bool isWide(double low, double high) {
    constexpr double kWide = 50.0;
    return low > 0.0 && high / low >= kWide;
}

void requireIncidence(double incidence) {
    if (!(incidence >= 0.0 && incidence <= 89.9))
        throw UsageError("incidence " + shortNumber(incidence) + "; expected 0..89.9 degrees");
}

}  // namespace lobe::plot
