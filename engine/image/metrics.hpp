/// How far a picture is from the truth (docs/compare.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "image/flip.hpp"
#include "image/image.hpp"

namespace lobe {

/// Of linear radiance, over all pixels and R, G, B, unless said otherwise.
enum class Metric : uint8_t {
    relMse,         ///< mean of (x - r)^2 / (r^2 + 0.01)
    relMseTrimmed,  ///< the same without the worst 0.1 % of the pixels
    rmse,
    max,   ///< largest |x - r|
    bias,  ///< mean of x - r, signed
    p95,   ///< 95th percentile over pixels of the largest |x - r| of the three; next, the 99th
    p99,
    psnr,     ///< dB, of sRGB-encoded values with peak 1; infinite if equal
    flip,     ///< mean of LDR FLIP of the picture clamped to 0..1
    flipP99,  ///< its 99th percentile and maximum: the mean hides fireflies
    flipMax,
    hdrFlip,
    hdrFlipP99,
    hdrFlipMax,
    ssim  ///< mean, of the sRGB-encoded luminance
};
inline constexpr size_t kMetricCount = 15;

/// rel_mse, rel_mse_trimmed, ..., in the order of the enumeration.
const std::vector<std::string>& metricNames();
/// PSNR and SSIM: larger is better.
bool largerIsBetter(Metric metric);
/// Whether display colours have it: PSNR, FLIP and SSIM.
bool isForDisplay(Metric metric);

/// Nothing where a metric does not apply, or where either picture has a non-finite pixel.
struct ErrorMetrics {
    size_t pixels = 0;        ///< that were counted
    NonFinite testNonFinite;  ///< of R, G, B; either is a failure
    NonFinite truthNonFinite;
    std::array<std::optional<double>, kMetricCount> values;

    std::optional<double> operator[](Metric metric) const { return values[static_cast<size_t>(metric)]; }
};

struct ErrorOptions {
    bool display = false;  ///< the values are sRGB-encoded display colours 0..1, not radiance
    /// Take the truth's own variance off the squared error: its channels error.R, error.G, error.B hold the
    /// standard error. An estimate without bias, so that it may be slightly negative.
    bool subtractTruthVariance = false;
    bool perceptual = true;  ///< FLIP, HDR-FLIP and SSIM too, which take most of the time
    double pixelsPerDegree = defaultPixelsPerDegree();
};

/// One value a pixel, from which metrics are pooled. Empty where they do not apply.
struct ErrorMaps {
    int width = 0, height = 0;
    Plane relativeSquare, square, difference, largest;  ///< means over R, G, B but the last, max |x - r|
    Plane displaySquare, flip, hdrFlip, ssim;
};

/// By pixel, row by row; a pixel counts where it is not 0.
using PixelMask = std::vector<uint8_t>;

/// Throws InputError where sizes differ, R, G or B is missing, or error.R G B where they are asked for.
/// Values have to be finite.
ErrorMaps errorMaps(const Image& test, const Image& truth, const ErrorOptions& options = {});

/// Over the pixels of the mask, or all where it is empty. A mask without a pixel gives no values.
ErrorMetrics poolErrors(const ErrorMaps& maps, const PixelMask& mask = {});

/// Both together, non-finite pixels counted first.
ErrorMetrics measureError(const Image& test, const Image& truth, const ErrorOptions& options = {});

/// The map that a metric is pooled from, as a picture with the one channel "Y".
Image errorMap(const ErrorMaps& maps, Metric metric);

/// The channels `layer`R, G, B ("" or "point.") as R, G, B; nothing where one is missing.
std::optional<Image> rgbLayer(const Image& image, const std::string& layer);

}  // namespace lobe
