#include "plot/lobes.hpp"

#include <algorithm>
#include <cmath>

#include "plot/geometry.hpp"

namespace lobe::plot {
namespace {

/// Just above the horizon, below which every model is 0.
constexpr double kEnd = 89.99;
constexpr double kStep = 0.5;
constexpr double kLargestJump = 0.01;  ///< of the peak
constexpr double kFinest = 1e-5;       ///< degrees: a few roundings of a direction
constexpr int kMostRounds = 16;

std::vector<double> firstAngles(double mirrorAngle) {
    std::vector<double> angles{-kEnd, kEnd, mirrorAngle};
    for (double angle = -90.0 + kStep; angle < 90.0; angle += kStep)
        angles.push_back(angle);
    std::sort(angles.begin(), angles.end());
    angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
    return angles;
}

/// Middles of the intervals that are too coarse, and of their neighbours.
std::vector<double> middles(const std::vector<LobePoint>& points) {
    const double largest = kLargestJump * peakOf(points);
    const auto coarse = [&](size_t i) {
        return i + 1 < points.size() && std::abs(points[i + 1].value - points[i].value) > largest &&
               points[i + 1].angle - points[i].angle > kFinest;
    };
    std::vector<double> angles;
    for (size_t i = 0; i + 1 < points.size(); ++i)
        if (coarse(i) ||
            (points[i + 1].angle - points[i].angle > 0.1 && (coarse(i + 1) || (i > 0 && coarse(i - 1)))))
            angles.push_back(0.5 * (points[i].angle + points[i + 1].angle));
    return angles;
}

}  // namespace

double peakOf(const std::vector<LobePoint>& points) {
    double peak = 0.0;
    for (const LobePoint& point : points)
        peak = std::max(peak, point.value);
    return peak;
}

double asQuantity(Quantity quantity, double fCos, const Pair& pair) {
    switch (quantity) {
        case Quantity::f:
            return fCos / pair.wi.z;
        case Quantity::fCosOut:
            return fCos / pair.wi.z * pair.wo.z;
        case Quantity::fCos:
            break;
    }
    return fCos;
}

std::vector<Pair> pairsAt(const glm::dvec3& wi, const std::vector<double>& angles, double azimuth) {
    std::vector<Pair> pairs;
    pairs.reserve(angles.size());
    for (double angle : angles)
        pairs.push_back({wi, toEye(angle, azimuth)});
    return pairs;
}

std::vector<LobePoint> sampleLobe(
    double mirrorAngle, const std::function<std::vector<double>(const std::vector<double>& angles)>& values) {
    std::vector<LobePoint> points;
    std::vector<double> angles = firstAngles(mirrorAngle);
    for (int round = 0; round < kMostRounds && !angles.empty(); ++round) {
        const std::vector<double> found = values(angles);
        for (size_t i = 0; i < angles.size(); ++i)
            points.push_back({angles[i], found[i]});
        std::sort(points.begin(), points.end(),
                  [](const LobePoint& a, const LobePoint& b) { return a.angle < b.angle; });
        angles = middles(points);
    }
    return points;
}

Lobes computeLobes(const Sampler& sampler, const LobesRequest& request) {
    Lobes result{request, {}};
    for (double incidence : request.incidences)
        requireIncidence(incidence);
    for (size_t m = 0; m < request.models.size(); ++m)
        for (double incidence : request.incidences) {
            const Model& model = request.models[m];
            const glm::dvec3 wi = toLight(incidence, request.azimuth);
            const auto values = [&](const std::vector<double>& angles) {
                const std::vector<Pair> pairs = pairsAt(wi, angles, request.azimuth);
                const std::vector<Sample> samples = sampler.sample(model, pairs);
                std::vector<double> found;
                for (size_t i = 0; i < pairs.size(); ++i)
                    found.push_back(
                        asQuantity(request.quantity, channelOf(samples[i].fCos, request.channel), pairs[i]));
                return found;
            };
            Lobe lobe{m, incidence, sampleLobe(incidence, values)};
            const Pair pair{wi, mirrored(wi)};
            lobe.mirror =
                channelOf(sampler.sample(model, std::span(&pair, 1)).front().mirror, request.channel);
            result.lobes.push_back(std::move(lobe));
        }
    return result;
}

}  // namespace lobe::plot
