#include "image/ssim.hpp"

#include <cmath>

namespace lobe {
namespace {

constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;

Kernel window() {
    constexpr int kRadius = 5;
    constexpr double kDeviation = 1.5;
    Kernel kernel;
    double total = 0.0;
    for (int i = -kRadius; i <= kRadius; ++i) {
        kernel.push_back(std::exp(-0.5 * i * i / (kDeviation * kDeviation)));
        total += kernel.back();
    }
    for (double& weight : kernel)
        weight /= total;
    return kernel;
}

}  // namespace

Plane ssim(const Plane& a, const Plane& b, int width, int height) {
    const Kernel kernel = window();
    const auto mean = [&](const auto& value) {
        Plane plane(a.size());
        for (size_t i = 0; i < plane.size(); ++i)
            plane[i] = value(i);
        return filtered(plane, width, height, kernel, kernel);
    };
    const Plane meanA = mean([&](size_t i) { return a[i]; }), meanB = mean([&](size_t i) { return b[i]; });
    const Plane squareA = mean([&](size_t i) { return a[i] * a[i]; });
    const Plane squareB = mean([&](size_t i) { return b[i] * b[i]; });
    const Plane product = mean([&](size_t i) { return a[i] * b[i]; });
    Plane result(a.size());
    for (size_t i = 0; i < result.size(); ++i) {
        // Values are at most 1 and C2 is 9e-4: the cancellation costs 1e-16 / 9e-4 at most.
        const double ab = meanA[i] * meanB[i], aa = meanA[i] * meanA[i], bb = meanB[i] * meanB[i];
        result[i] = (2.0 * ab + kC1) * (2.0 * (product[i] - ab) + kC2) /
                    ((aa + bb + kC1) * ((squareA[i] - aa) + (squareB[i] - bb) + kC2));
    }
    return result;
}

}  // namespace lobe
