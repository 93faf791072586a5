/// Pictures drawn with OpenGL against the reference.
#pragma once

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>
#include <vector>

#include "passes/rendering.hpp"
#include "reference/pixel.hpp"

namespace lobe::reference {

/// One sample, full precision, no shadows.
inline Quality exact() {
    Quality quality;
    quality.samples = 1;
    quality.gbufferBits = 32;
    quality.shadows = Shadows::none;
    return quality;
}

/// Radiance through the pixels' centres, row by row from the top. `error`: relative, of each pixel.
inline std::vector<glm::dvec3> truthOf(const Scene& scene, const Camera& camera, int width, int height,
                                       double error, bool shadows) {
    const PixelIntegrator integrator(std::make_shared<const Scene>(scene), camera, width, height,
                                     {.filter = PixelFilter::point, .shadows = shadows});
    std::vector<glm::dvec3> pixels(static_cast<size_t>(width * height));
    Effort effort;
    effort.relativeError = error;
    effort.floor = glm::dvec3(0.05);
    std::vector<std::thread> threads;
    const int count = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    for (int t = 0; t < count; ++t)
        threads.emplace_back([&, t] {
            for (int y = t; y < height; y += count)
                for (int x = 0; x < width; ++x)
                    pixels[static_cast<size_t>(y * width + x)] = integrator.at(x, y, effort, 1).total();
        });
    for (std::thread& thread : threads)
        thread.join();
    return pixels;
}

/// Mean of |difference| over the mean, and of the difference.
inline std::pair<double, double> errorOf(const Image& image, const std::vector<glm::dvec3>& truths) {
    double off = 0.0, bias = 0.0, sum = 0.0;
    for (size_t i = 0; i < truths.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const float value = image.values[i * image.channelCount() + static_cast<size_t>(c)];
            EXPECT_TRUE(std::isfinite(value) && value >= 0.0F);
            off += std::abs(static_cast<double>(value) - truths[i][c]);
            bias += static_cast<double>(value) - truths[i][c];
            sum += truths[i][c];
        }
    return {off / sum, bias / sum};
}

}  // namespace lobe::reference
