/// Small pictures of surfaces under lights with a body, and how far they are from the truth.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "passes/rendering.hpp"
#include "reference/pixel.hpp"

namespace lobe::reference {

inline constexpr int kWidth = 48, kHeight = 36;

inline Light body(LightType type) {
    Light light;
    light.type = type;
    light.position = {-0.6, 1.1, 0.5};
    light.direction = glm::normalize(glm::dvec3(0.5, -1.0, -0.4));
    light.axis = glm::normalize(glm::cross(light.direction, glm::dvec3(0.2, 0.3, 1.0)));
    light.width = 0.8;
    light.height = 0.5;
    light.radius = type == LightType::tube ? 0.04 : 0.3;
    light.length = 0.9;
    const bool flat = type == LightType::rect || type == LightType::disk;
    light.intensity = flat ? glm::dvec3(3.0, 2.5, 2.0) : glm::dvec3(1.0, 0.9, 0.8);
    if (!flat) light.range = 6.0;
    return light;
}

/// A ball over the ground: the horizon cuts the light on the one and, at its far end, on the other; the ball
/// throws a penumbra.
inline Scene ballOnGround(const std::string& model) {
    Scene scene;
    const int ground = test::addMaterial(scene, model), ball = test::addMaterial(scene, model);
    test::addInstance(scene, test::addQuad(scene, ground, 3.0f),
                      glm::rotate(glm::dmat4(1.0), -1.5707963267948966, glm::dvec3(1, 0, 0)));
    test::addInstance(scene, test::addSphere(scene, ball, 32),
                      glm::scale(glm::translate(glm::dmat4(1.0), {0.1, 0.35, 0.0}), glm::dvec3(0.35)));
    return scene;
}

inline Camera camera() {
    Camera camera = lookAt({0.3, 1.3, 2.6}, {0.0, 0.25, 0.0}, 0.65);
    camera.zNear = 0.01;
    return camera;
}

struct Error {
    double mean = 0.0;     ///< of |difference|, of the mean radiance
    double largest = 0.0;  ///< of difference / (radiance + half the mean)
    double rms = 0.0;      ///< of the same
    double missing = 0.0;  ///< drawn mean / true mean - 1
    int compared = 0;
    bool bad = false;  ///< not finite or negative
};

inline Image drawn(const Scene& scene, const Quality& quality,
                   AovSet aovs = {Aov::radiance, Aov::materialId}) {
    RenderOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.quality = quality;
    options.aovs = std::move(aovs);
    test::eglContext().makeCurrent();
    Renderer renderer(test::eglContext());
    renderer.setScene(std::make_shared<const Scene>(scene), options);
    return renderer.render(camera()).image;
}

/// Every pixel's truth, on all cores; each with its neighbours' materials.
inline std::vector<PixelTruth> truth(const Scene& scene, bool shadows, double error) {
    const PixelIntegrator integrator(std::make_shared<const Scene>(scene), camera(), kWidth, kHeight,
                                     {.filter = PixelFilter::point, .shadows = shadows});
    std::vector<PixelTruth> pixels(kWidth * kHeight);
    Effort effort;
    effort.relativeError = error;
    effort.floor = glm::dvec3(0.02);
    std::vector<std::thread> threads;
    const unsigned count = std::max(1u, std::thread::hardware_concurrency());
    for (unsigned t = 0; t < count; ++t)
        threads.emplace_back([&, t] {
            for (int y = static_cast<int>(t); y < kHeight; y += static_cast<int>(count))
                for (int x = 0; x < kWidth; ++x)
                    pixels[static_cast<size_t>(y * kWidth + x)] = integrator.at(x, y, effort, 1);
        });
    for (std::thread& thread : threads)
        thread.join();
    return pixels;
}

inline size_t channelOf(const Image& image, const std::string& name) {
    return static_cast<size_t>(std::find(image.channels.begin(), image.channels.end(), name) -
                               image.channels.begin());
}

/// Where both see one material.
inline Error compareWith(const Image& image, const std::vector<PixelTruth>& truths) {
    Error error;
    const size_t id = channelOf(image, "material.id");
    double sum = 0.0, got = 0.0;
    for (const PixelTruth& pixel : truths)
        sum += glm::dot(pixel.total(), glm::dvec3(1.0)) / 3.0;
    const double mean = sum / static_cast<double>(truths.size());
    sum = 0.0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const PixelTruth& expected = truths[static_cast<size_t>(y * kWidth + x)];
            const float* pixel = image.pixel(x, y);
            for (int c = 0; c < 3; ++c)
                error.bad |= !std::isfinite(pixel[c]) || pixel[c] < 0.0f;
            if (static_cast<int>(pixel[id]) != expected.material || expected.material == 0) continue;
            ++error.compared;
            for (int c = 0; c < 3; ++c) {
                const double value = expected.total()[c], off = static_cast<double>(pixel[c]) - value;
                sum += value;
                got += static_cast<double>(pixel[c]);
                error.mean += std::abs(off);
                const double relative = off / (value + 0.5 * mean);
                error.largest = std::max(error.largest, std::abs(relative));
                error.rms += relative * relative;
            }
        }
    error.mean /= sum;
    error.missing = got / sum - 1.0;
    error.rms = std::sqrt(error.rms / (3.0 * error.compared));
    return error;
}

inline void print(const char* what, const Error& e) {
    std::printf("%s: mean %.2e, rms %.2e, largest %.2e, bias %.2e, %d pixels\n", what, e.mean, e.rms,
                e.largest, e.missing, e.compared);
}

inline Quality exact() {
    Quality quality;
    quality.samples = 1;
    quality.gbufferBits = 32;
    quality.shadows = Shadows::none;
    return quality;
}

}  // namespace lobe::reference
