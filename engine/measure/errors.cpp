#include "measure/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "image/edges.hpp"
#include "plot/style.hpp"

namespace lobe::measure {
namespace {

using nlohmann::json;

constexpr std::pair<const char*, Metric> kMetrics[] = {
    {"relmse", Metric::relMse}, {"relmse_trimmed", Metric::relMseTrimmed},
    {"rmse", Metric::rmse},     {"max", Metric::max},
    {"p95", Metric::p95},       {"psnr", Metric::psnr},
    {"flip", Metric::flip},     {"ssim", Metric::ssim},
};

json valueOf(std::optional<double> value) {
    return value && std::isfinite(*value) ? json(*value) : json();  // PSNR of equal pictures is infinite
}

Image withoutNonFinite(Image image) {
    for (float& value : image.values)
        if (!std::isfinite(value)) value = 0.0F;
    return image;
}

void addEdges(json& error, const Image& test, const Image& truth, const ErrorMaps& maps) {
    const std::optional<PixelMask> edges = edgePixels(test, truth);
    if (!edges) return;
    PixelMask shading(edges->size());
    std::transform(edges->begin(), edges->end(), shading.begin(),
                   [](uint8_t edge) { return static_cast<uint8_t>(edge == 0); });
    error["shading_relmse"] = valueOf(poolErrors(maps, shading)[Metric::relMse]);
    error["edge_relmse"] = valueOf(poolErrors(maps, *edges)[Metric::relMse]);
    error["edge_pixels"] =
        std::count_if(edges->begin(), edges->end(), [](uint8_t edge) { return edge != 0; });
}

Bitmap differenceMap(const ErrorMaps& maps) {
    constexpr double kDecades = 4.0;
    Bitmap map{maps.width, maps.height, 3, ComponentType::u8, {}};
    map.data.reserve(maps.relativeSquare.size() * 3);
    for (const double square : maps.relativeSquare) {
        const std::string colour =
            plot::sequentialColor(square > 0.0 ? 1.0 + 0.5 * std::log10(square) / kDecades : 0.0);
        for (size_t c = 0; c < 3; ++c)
            map.data.push_back(static_cast<std::byte>(std::stoi(colour.substr(1 + 2 * c, 2), nullptr, 16)));
    }
    return map;
}

}  // namespace

PictureError pictureError(const Image& test, const Image& truth) {
    const size_t nonFinite = countNonFinite(test).pixels;
    const ErrorMaps maps = nonFinite == 0 ? errorMaps(test, truth)
                                          : errorMaps(withoutNonFinite(test), truth, {.perceptual = false});
    PictureError result{json::object(), std::numeric_limits<double>::infinity(), differenceMap(maps)};
    const ErrorMetrics metrics = nonFinite == 0 ? poolErrors(maps) : ErrorMetrics{};
    for (const auto& [name, metric] : kMetrics)
        result.values[name] = valueOf(metrics[metric]);
    result.values["non_finite"] = nonFinite;
    for (const char* name : {"shading_relmse", "edge_relmse", "edge_pixels"})
        result.values[name] = nullptr;
    if (nonFinite > 0) return result;
    result.relativeSquare = metrics[Metric::relMse].value();
    addEdges(result.values, test, truth, maps);
    return result;
}

const std::vector<std::string>& errorColumns() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all = errorMetricNames();
        all.insert(all.end(), {"non_finite", "shading_relmse", "edge_relmse", "edge_pixels"});
        return all;
    }();
    return names;
}

const std::vector<std::string>& errorMetricNames() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const auto& [name, metric] : kMetrics)
            all.emplace_back(name);
        return all;
    }();
    return names;
}

bool largerIsBetter(const std::string& metric) {
    for (const auto& [name, value] : kMetrics)
        if (metric == name) return lobe::largerIsBetter(value);
    return false;
}

}  // namespace lobe::measure
