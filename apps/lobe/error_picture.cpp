#include "error_picture.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "output_name.hpp"
#include "plot/geometry.hpp"
#include "plot/style.hpp"

namespace lobe::app {
namespace {

Bitmap viridis(const Image& map, double largest) {
    Bitmap bitmap{map.width, map.height, 3, ComponentType::u8, {}};
    bitmap.data.reserve(3 * map.pixelCount());
    for (const float value : map.values) {
        const double share = largest > 0.0 ? static_cast<double>(value) / largest : 0.0;
        const std::string color = plot::sequentialColor(share);  // #rrggbb
        for (size_t c = 0; c < 3; ++c)
            bitmap.data.push_back(static_cast<std::byte>(std::stoi(color.substr(1 + 2 * c, 2), nullptr, 16)));
    }
    return bitmap;
}

}  // namespace

void requireMapName(const std::string& file) {
    const std::string extension = lowerExtension(file);
    const std::vector<std::string>& display = ImageFiles::displayExtensions();
    if (extension != ".exr" && std::find(display.begin(), display.end(), extension) == display.end())
        throw UsageError("-o " + file + ": expected a name that ends in .png, .jpg, .jpeg or .exr");
}

std::string writeErrorMap(const std::string& file, const ErrorMaps& maps, Metric metric, ImageFiles& files) {
    Image map = errorMap(maps, metric);
    const std::string& name = metricNames()[static_cast<size_t>(metric)];
    WriteOptions options;
    options.exrPrecision = ExrPrecision::single;
    if (lowerExtension(file) == ".exr") {
        options.metadata["lobe:metric"] = name;
        files.write(file, map, options);
        return file + ": values of " + name;
    }
    for (float& value : map.values)
        value = metric == Metric::ssim ? 1.0F - value : std::abs(value);
    const bool unit = metric >= Metric::flip && metric <= Metric::hdrFlipMax;
    const float largest =
        unit || map.values.empty() ? 1.0F : *std::max_element(map.values.begin(), map.values.end());
    const std::string range =
        name + " 0 (dark blue) to " + plot::shortNumber(static_cast<double>(largest)) + " (yellow), viridis";
    options.metadata["lobe:range"] = range;
    files.write(file, viridis(map, static_cast<double>(largest)), options);
    return file + ": " + range;
}

}  // namespace lobe::app
