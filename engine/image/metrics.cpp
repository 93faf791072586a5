#include "image/metrics.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "image/ssim.hpp"
#include "image/tone.hpp"

namespace lobe {
namespace {

constexpr double kDarkSquare = 0.01;    // relMSE's epsilon
constexpr double kTrimmedShare = 1e-3;  // of the pixels

std::string sizeText(const Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height);
}

Image required(const Image& image, const std::string& layer, const char* which) {
    std::optional<Image> rgb = rgbLayer(image, layer);
    if (!rgb)
        throw InputError(std::string(which) + ": no channels " + layer + "R, " + layer + "G, " + layer +
                         "B; expected a picture that has them");
    return *std::move(rgb);
}

/// Display colours, linear, 0..1.
RgbPlanes planesOf(const Image& rgb, bool decode) {
    RgbPlanes planes{rgb.width, rgb.height, {}};
    for (size_t c = 0; c < 3; ++c) {
        planes.rgb[c].resize(rgb.pixelCount());
        for (size_t i = 0; i < rgb.pixelCount(); ++i) {
            const float value = rgb.values[3 * i + c];
            planes.rgb[c][i] = static_cast<double>(decode ? decodeSrgb(value) : value);
        }
    }
    return planes;
}

double encoded(double linear) {
    return static_cast<double>(encodeSrgb(static_cast<float>(std::clamp(linear, 0.0, 1.0))));
}

Plane encodedLuminance(const RgbPlanes& planes) {
    Plane grey(planes.rgb[0].size());
    for (size_t i = 0; i < grey.size(); ++i) {
        const auto shown = [&](size_t c) { return std::clamp(planes.rgb[c][i], 0.0, 1.0); };
        grey[i] = encoded(0.2126 * shown(0) + 0.7152 * shown(1) + 0.0722 * shown(2));
    }
    return grey;
}

void addLinear(ErrorMaps& maps, const RgbPlanes& test, const RgbPlanes& truth, const Image* standardError) {
    const size_t count = test.rgb[0].size();
    for (Plane* plane : {&maps.relativeSquare, &maps.square, &maps.difference, &maps.largest})
        plane->assign(count, 0.0);
    for (size_t i = 0; i < count; ++i)
        for (size_t c = 0; c < 3; ++c) {
            const double r = truth.rgb[c][i], difference = test.rgb[c][i] - r;
            double square = difference * difference;
            if (standardError != nullptr) {
                const auto deviation = static_cast<double>(standardError->values[3 * i + c]);
                square -= deviation * deviation;
            }
            maps.relativeSquare[i] += square / (r * r + kDarkSquare) / 3.0;
            maps.square[i] += square / 3.0;
            maps.difference[i] += difference / 3.0;
            maps.largest[i] = std::max(maps.largest[i], std::abs(difference));
        }
}

double mean(const Plane& values) {
    double sum = 0.0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

/// The smallest value that at least `share` of all do not exceed.
double percentile(Plane values, double share) {
    const auto count = static_cast<double>(values.size());
    const auto rank = static_cast<size_t>(std::max(1.0, std::ceil(share * count)));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank - 1), values.end());
    return values[rank - 1];
}

double largestOf(const Plane& values) {
    return *std::max_element(values.begin(), values.end());
}

double trimmedMean(Plane values) {
    std::sort(values.begin(), values.end());
    values.resize(values.size() - static_cast<size_t>(kTrimmedShare * static_cast<double>(values.size())));
    return mean(values);
}

Plane masked(const Plane& plane, const PixelMask& mask) {
    if (mask.empty()) return plane;
    Plane kept;
    for (size_t i = 0; i < plane.size(); ++i)
        if (mask[i] != 0) kept.push_back(plane[i]);
    return kept;
}

}  // namespace

const std::vector<std::string>& metricNames() {
    static const std::vector<std::string> names = {
        "rel_mse", "rel_mse_trimmed", "rmse",     "max",      "bias",         "p95",          "p99", "psnr",
        "flip",    "flip_p99",        "flip_max", "hdr_flip", "hdr_flip_p99", "hdr_flip_max", "ssim"};
    return names;
}

bool largerIsBetter(Metric metric) {
    return metric == Metric::psnr || metric == Metric::ssim;
}

bool isForDisplay(Metric metric) {
    return largerIsBetter(metric) || metric == Metric::flip || metric == Metric::flipP99 ||
           metric == Metric::flipMax;
}

std::optional<Image> rgbLayer(const Image& image, const std::string& layer) {
    std::array<size_t, 3> from{};
    for (size_t c = 0; c < 3; ++c) {
        const auto found = std::find(image.channels.begin(), image.channels.end(), layer + "RGB"[c]);
        if (found == image.channels.end()) return std::nullopt;
        from[c] = static_cast<size_t>(found - image.channels.begin());
    }
    Image rgb(image.width, image.height, {"R", "G", "B"});
    for (size_t i = 0; i < image.pixelCount(); ++i)
        for (size_t c = 0; c < 3; ++c)
            rgb.values[3 * i + c] = image.values[i * image.channelCount() + from[c]];
    return rgb;
}

ErrorMaps errorMaps(const Image& test, const Image& truth, const ErrorOptions& options) {
    if (test.width != truth.width || test.height != truth.height)
        throw InputError("sizes differ: " + sizeText(test) + " and " + sizeText(truth) +
                         "; expected two pictures of one size");
    const RgbPlanes a = planesOf(required(test, "", "picture"), options.display);
    const RgbPlanes b = planesOf(required(truth, "", "truth"), options.display);
    ErrorMaps maps;
    maps.width = truth.width;
    maps.height = truth.height;
    if (!options.display) {
        std::optional<Image> deviation;
        if (options.subtractTruthVariance) deviation = required(truth, "error.", "truth");
        addLinear(maps, a, b, deviation ? &*deviation : nullptr);
    }
    maps.displaySquare.assign(a.rgb[0].size(), 0.0);
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < maps.displaySquare.size(); ++i) {
            const double difference = encoded(a.rgb[c][i]) - encoded(b.rgb[c][i]);
            maps.displaySquare[i] += difference * difference / 3.0;
        }
    if (!options.perceptual || a.rgb[0].empty()) return maps;
    maps.flip = flip(a, b, options.pixelsPerDegree);
    maps.ssim = ssim(encodedLuminance(a), encodedLuminance(b), maps.width, maps.height);
    if (!options.display) maps.hdrFlip = hdrFlip(a, b, options.pixelsPerDegree);
    return maps;
}

ErrorMetrics poolErrors(const ErrorMaps& maps, const PixelMask& mask) {
    ErrorMetrics metrics;
    const auto set = [&](Metric metric, double value) {
        metrics.values[static_cast<size_t>(metric)] = value;
    };
    const Plane shown = masked(maps.displaySquare, mask);
    metrics.pixels = shown.size();
    if (shown.empty()) return metrics;
    set(Metric::psnr, -10.0 * std::log10(mean(shown)));
    if (!maps.square.empty()) {
        const Plane relative = masked(maps.relativeSquare, mask), largest = masked(maps.largest, mask);
        set(Metric::relMse, mean(relative));
        set(Metric::relMseTrimmed, trimmedMean(relative));
        set(Metric::rmse, std::sqrt(std::max(0.0, mean(masked(maps.square, mask)))));
        set(Metric::max, largestOf(largest));
        set(Metric::bias, mean(masked(maps.difference, mask)));
        set(Metric::p95, percentile(largest, 0.95));
        set(Metric::p99, percentile(largest, 0.99));
    }
    const auto pool = [&](const Plane& plane, Metric average, Metric p99, Metric largest) {
        if (plane.empty()) return;
        const Plane kept = masked(plane, mask);
        set(average, mean(kept));
        set(p99, percentile(kept, 0.99));
        set(largest, largestOf(kept));
    };
    pool(maps.flip, Metric::flip, Metric::flipP99, Metric::flipMax);
    pool(maps.hdrFlip, Metric::hdrFlip, Metric::hdrFlipP99, Metric::hdrFlipMax);
    if (!maps.ssim.empty()) set(Metric::ssim, mean(masked(maps.ssim, mask)));
    return metrics;
}

ErrorMetrics measureError(const Image& test, const Image& truth, const ErrorOptions& options) {
    ErrorMetrics bad;
    bad.testNonFinite = countNonFinite(required(test, "", "picture"));
    bad.truthNonFinite = countNonFinite(required(truth, "", "truth"));
    if (bad.testNonFinite.pixels > 0 || bad.truthNonFinite.pixels > 0) return bad;
    return poolErrors(errorMaps(test, truth, options));
}

Image errorMap(const ErrorMaps& maps, Metric metric) {
    const Plane* plane = &maps.largest;  // max, bias and the percentiles
    if (metric == Metric::relMse || metric == Metric::relMseTrimmed) plane = &maps.relativeSquare;
    if (metric == Metric::rmse) plane = &maps.square;
    if (metric == Metric::bias) plane = &maps.difference;
    if (metric == Metric::psnr) plane = &maps.displaySquare;
    if (metric >= Metric::flip && metric <= Metric::flipMax) plane = &maps.flip;
    if (metric >= Metric::hdrFlip && metric <= Metric::hdrFlipMax) plane = &maps.hdrFlip;
    if (metric == Metric::ssim) plane = &maps.ssim;
    if (plane->empty()) return {};
    Image image(maps.width, maps.height, {"Y"});
    for (size_t i = 0; i < image.pixelCount(); ++i)
        image.values[i] = static_cast<float>((*plane)[i]);
    return image;
}

}  // namespace lobe
