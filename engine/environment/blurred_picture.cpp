#include "environment/blurred_picture.hpp"

#include <cmath>
#include <cstring>
#include <numbers>

#include "environment/radiance_tree.hpp"

namespace lobe {

Bitmap blurredPicture(const EnvironmentMap& map) {
    constexpr double kPi = std::numbers::pi;
    constexpr double kWidth = 5.0 * kPi / 180.0;
    const environment::RadianceTree tree(map);
    const environment::ZonalKernel gaussian(
        [](double angle) { return std::exp(-0.5 * angle * angle / (kWidth * kWidth)); });
    Bitmap result;
    result.width = 256;
    result.height = 128;
    result.channels = 3;
    result.type = ComponentType::f32;
    const auto width = static_cast<size_t>(result.width), height = static_cast<size_t>(result.height);
    std::vector<float> values(width * height * 3);
    environment::inParallel(height, [&](size_t y) {
        for (size_t x = 0; x < width; ++x) {
            const double phi = 2.0 * kPi * (static_cast<double>(x) + 0.5) / result.width;
            const double theta = kPi * (static_cast<double>(y) + 0.5) / result.height;
            const glm::vec3 d(std::sin(theta) * std::sin(phi), std::cos(theta),
                              -std::sin(theta) * std::cos(phi));
            const glm::dvec3 rgb = tree.blurred(d, gaussian);
            for (size_t c = 0; c < 3; ++c)
                values[3 * (y * width + x) + c] = static_cast<float>(rgb[static_cast<int>(c)]);
        }
    });
    result.data.resize(values.size() * sizeof(float));
    std::memcpy(result.data.data(), values.data(), result.data.size());
    return result;
}

}  // namespace lobe
