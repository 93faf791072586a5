#include "image/flip.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <mutex>
#include <numbers>
#include <thread>

#include "base/thread_team.hpp"

namespace lobe {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kColorExponent = 0.7, kColorShare = 0.4, kColorTarget = 0.95;  // q_c, p_c, p_t
constexpr double kFeatureExponent = 0.5, kFeatureDegrees = 0.082;               // q_f, w

/// Linear Rec.709 to XYZ and back, white at D65 as (1, 1, 1).
const glm::dmat3 kToXyz =
    glm::transpose(glm::dmat3(10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794,
                              2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897,
                              1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382));
const glm::dmat3 kFromXyz = glm::inverse(kToXyz);
const glm::dvec3 kWhite = kToXyz * glm::dvec3(1.0);

/// The opponent space in which contrast sensitivity was measured: linear in XYZ.
glm::dvec3 toYCxCz(const glm::dvec3& rgb) {
    const glm::dvec3 xyz = kToXyz * rgb / kWhite;
    return {116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z)};
}

glm::dvec3 fromYCxCz(const glm::dvec3& color) {
    const double y = (color.x + 16.0) / 116.0;
    return kFromXyz * (glm::dvec3(y + color.y / 500.0, y, y - color.z / 200.0) * kWhite);
}

double labCurve(double share) {
    constexpr double kDelta = 6.0 / 29.0;
    return share > kDelta * kDelta * kDelta ? std::cbrt(share) : share / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
}

/// CIELAB with Hunt's effect: chroma counts in proportion to lightness.
glm::dvec3 toHuntLab(const glm::dvec3& rgb) {
    const glm::dvec3 xyz = kToXyz * rgb / kWhite;
    const double x = labCurve(xyz.x), y = labCurve(xyz.y), z = labCurve(xyz.z);
    const double lightness = 116.0 * y - 16.0;
    return {lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z)};
}

double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

/// One Gaussian of a contrast sensitivity function, a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees. The
/// kernel is the square root of its height, to be applied along x and along y.
Kernel sensitivity(double a, double b, int radius, double pixelsPerDegree) {
    Kernel kernel;
    const double height = std::sqrt(a * std::sqrt(kPi / b));
    for (int i = -radius; i <= radius; ++i) {
        const double x = i / pixelsPerDegree;
        kernel.push_back(height * std::exp(-kPi * kPi * x * x / b));
    }
    return kernel;
}

double sum(const Kernel& kernel) {
    double total = 0.0;
    for (const double weight : kernel)
        total += weight;
    return total;
}

Kernel scaled(Kernel kernel, double factor) {
    for (double& weight : kernel)
        weight *= factor;
    return kernel;
}

std::array<Plane, 3> opponents(const RgbPlanes& picture) {
    std::array<Plane, 3> result;
    const size_t count = picture.rgb[0].size();
    for (Plane& plane : result)
        plane.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec3 rgb(picture.rgb[0][i], picture.rgb[1][i], picture.rgb[2][i]);
        const glm::dvec3 color = toYCxCz(glm::clamp(rgb, 0.0, 1.0));
        for (int c = 0; c < 3; ++c)
            result[static_cast<size_t>(c)][i] = color[c];
    }
    return result;
}

/// What the eye resolves of each of the three: Gaussians of Table 1, blue-yellow a sum of two.
void blur(std::array<Plane, 3>& planes, int width, int height, double pixelsPerDegree) {
    constexpr double kWidest = 0.04;
    const int radius =
        static_cast<int>(std::ceil(3.0 * std::sqrt(kWidest / (2.0 * kPi * kPi)) * pixelsPerDegree));
    const auto one = [&](Plane& plane, double b) {
        const Kernel kernel = sensitivity(1.0, b, radius, pixelsPerDegree);
        const Kernel unit = scaled(kernel, 1.0 / sum(kernel));
        plane = filtered(plane, width, height, unit, unit);
    };
    one(planes[0], 0.0047);
    one(planes[1], 0.0053);
    const Kernel wide = sensitivity(34.1, 0.04, radius, pixelsPerDegree);
    const Kernel narrow = sensitivity(13.5, 0.025, radius, pixelsPerDegree);
    const double share = 1.0 / std::sqrt(sum(wide) * sum(wide) + sum(narrow) * sum(narrow));
    Plane a = filtered(planes[2], width, height, scaled(wide, share), scaled(wide, share));
    const Plane b = filtered(planes[2], width, height, scaled(narrow, share), scaled(narrow, share));
    for (size_t i = 0; i < a.size(); ++i)
        a[i] += b[i];
    planes[2] = std::move(a);
}

/// Positive weights made to sum to 1, negative ones to -1.
Kernel balanced(Kernel kernel) {
    double positive = 0.0, negative = 0.0;
    for (const double weight : kernel)
        (weight > 0.0 ? positive : negative) += weight;
    for (double& weight : kernel)
        weight /= weight > 0.0 ? positive : -negative;
    return kernel;
}

struct Features {
    Plane edges, points;
};

Features features(const Plane& luma, int width, int height, double pixelsPerDegree) {
    const double deviation = 0.5 * kFeatureDegrees * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3.0 * deviation));
    Kernel gauss, first, second;
    for (int i = -radius; i <= radius; ++i) {
        const double value = std::exp(-0.5 * i * i / (deviation * deviation));
        gauss.push_back(value);
        first.push_back(-i * value);
        second.push_back((i * i / (deviation * deviation) - 1.0) * value);
    }
    gauss = scaled(gauss, 1.0 / sum(gauss));
    first = balanced(first);
    second = balanced(second);
    const auto lengths = [&](const Kernel& kernel) {
        Plane x = filtered(luma, width, height, kernel, gauss);
        const Plane y = filtered(luma, width, height, gauss, kernel);
        for (size_t i = 0; i < x.size(); ++i)
            x[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
        return x;
    };
    return {lengths(first), lengths(second)};
}

double colorDifference(const glm::dvec3& test, const glm::dvec3& truth) {
    static const double largest =
        std::pow(hyab(toHuntLab({0.0, 1.0, 0.0}), toHuntLab({0.0, 0.0, 1.0})), kColorExponent);
    const auto seen = [](const glm::dvec3& color) {
        return toHuntLab(glm::clamp(fromYCxCz(color), 0.0, 1.0));
    };
    const double difference = std::pow(hyab(seen(test), seen(truth)), kColorExponent);
    const double knee = kColorShare * largest;
    if (difference < knee) return difference * kColorTarget / knee;
    return kColorTarget + (difference - knee) / (largest - knee) * (1.0 - kColorTarget);
}

/// Narkowicz's fit of the ACES curve, with the factor 0.6 of the exposure, as in the paper.
constexpr double kSquare = 0.6 * 0.6 * 2.51, kLinear = 0.6 * 0.03;
constexpr double kBelowSquare = 0.6 * 0.6 * 2.43, kBelowLinear = 0.6 * 0.59, kBelow = 0.14;

double aces(double x) {
    if (!(x > 0.0)) return 0.0;
    return std::min(1.0, x * (kSquare * x + kLinear) / (x * (kBelowSquare * x + kBelowLinear) + kBelow));
}

RgbPlanes exposed(const RgbPlanes& picture, double stops) {
    RgbPlanes result = picture;
    const double factor = std::exp2(stops);
    for (Plane& plane : result.rgb)
        for (double& value : plane)
            value = aces(factor * value);
    return result;
}

}  // namespace

double defaultPixelsPerDegree() {
    constexpr double kDistance = 0.7, kPixels = 3840.0, kWidth = 0.7;
    return kDistance * (kPixels / kWidth) * (kPi / 180.0);
}

Plane flip(const RgbPlanes& test, const RgbPlanes& truth, double pixelsPerDegree) {
    const int width = truth.width, height = truth.height;
    std::array<Plane, 3> a = opponents(test), b = opponents(truth);
    const auto featuresOf = [&](Plane luma) {
        for (double& value : luma)
            value = (value + 16.0) / 116.0;
        return features(luma, width, height, pixelsPerDegree);
    };
    const Features testFeatures = featuresOf(a[0]), truthFeatures = featuresOf(b[0]);
    blur(a, width, height, pixelsPerDegree);
    blur(b, width, height, pixelsPerDegree);
    Plane result(a[0].size());
    for (size_t i = 0; i < result.size(); ++i) {
        const double edge = std::abs(testFeatures.edges[i] - truthFeatures.edges[i]);
        const double point = std::abs(testFeatures.points[i] - truthFeatures.points[i]);
        const double feature = std::pow(std::max(edge, point) / std::numbers::sqrt2, kFeatureExponent);
        const double color = colorDifference({a[0][i], a[1][i], a[2][i]}, {b[0][i], b[1][i], b[2][i]});
        result[i] = std::pow(color, 1.0 - feature);
    }
    return result;
}

ExposureRange exposuresOf(const RgbPlanes& truth) {
    constexpr double kBright = 0.85;  // of the curve's range
    const double a = kSquare - kBright * kBelowSquare, b = kLinear - kBright * kBelowLinear;
    const double c = -kBright * kBelow;
    const double bright = (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
    Plane luminance(truth.rgb[0].size());
    for (size_t i = 0; i < luminance.size(); ++i)
        luminance[i] = 0.2126 * truth.rgb[0][i] + 0.7152 * truth.rgb[1][i] + 0.0722 * truth.rgb[2][i];
    std::sort(luminance.begin(), luminance.end());
    const auto lit = std::upper_bound(luminance.begin(), luminance.end(), 0.0);
    // Nothing to expose for: a radiance of 1 is as good as any.
    if (lit == luminance.end()) return {std::log2(bright), std::log2(bright), 1};
    // Where half the picture is black its median would ask for an infinite exposure. Of an even number the
    // upper of the middle two, as the published implementation has it.
    const auto middle = luminance.begin() + static_cast<std::ptrdiff_t>(luminance.size() / 2);
    const double median = *middle > 0.0 ? *middle : *(lit + (luminance.end() - lit) / 2);
    ExposureRange range;
    range.start = std::log2(bright / luminance.back());
    range.stop = std::log2(bright / median);
    range.count = std::max(2, static_cast<int>(std::ceil(range.stop - range.start)));
    return range;
}

Plane hdrFlip(const RgbPlanes& test, const RgbPlanes& truth, double pixelsPerDegree) {
    const ExposureRange range = exposuresOf(truth);
    Plane worst(truth.rgb[0].size(), 0.0);
    std::mutex mutex;
    // Each exposure takes some twenty planes of memory: few at a time, whatever the number of cores.
    constexpr unsigned kAtOnce = 4;
    ThreadTeam team(std::clamp(std::thread::hardware_concurrency(), 1U, kAtOnce));
    team.each(static_cast<size_t>(range.count), [&](size_t i) {
        const double stops =
            range.start + static_cast<double>(i) * (range.stop - range.start) / std::max(1, range.count - 1);
        const Plane one = flip(exposed(test, stops), exposed(truth, stops), pixelsPerDegree);
        const std::lock_guard lock(mutex);
        for (size_t p = 0; p < worst.size(); ++p)
            worst[p] = std::max(worst[p], one[p]);
    });
    return worst;
}

}  // namespace lobe
