/// Renders test scenes on a context of each backend.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "passes/renderer.hpp"
#include "scene/brdf_tables.hpp"
#include "support/scenes.hpp"

namespace lobe::test {

inline Camera frontCamera(double distance = 4.0) {
    Camera camera = lookAt({0, 0, distance}, {0, 0, 0}, 0.7);
    camera.zNear = 0.01;
    return camera;
}

/// Without shadows where they are not asked for: their own tests do, and others need not wait for their
/// programs.
inline RenderOptions smallPicture(Quality quality = {.samples = 1, .gbufferBits = 32},
                                  AovSet aovs = {Aov::radiance}, Shadows shadows = Shadows::none) {
    RenderOptions options;
    options.width = 96;
    options.height = 64;
    options.quality = quality;
    options.quality.shadows = shadows;
    options.aovs = std::move(aovs);
    return options;
}

inline Image render(gl::Context& context, const Scene& scene, const Camera& camera,
                    const RenderOptions& options = smallPicture()) {
    context.makeCurrent();
    Renderer renderer(context);
    renderer.setScene(std::make_shared<Scene>(scene), options);
    return renderer.render(camera).image;
}

/// A context kept for all tests of this program.
inline gl::Context& eglContext() {
    static const std::unique_ptr<gl::Context> context = gl::Context::create({.backend = gl::Backend::egl});
    return *context;
}

inline Image render(const Scene& scene, const Camera& camera, const RenderOptions& options = smallPicture()) {
    return render(eglContext(), scene, camera, options);
}

inline size_t channelIndex(const Image& image, const std::string& name) {
    for (size_t i = 0; i < image.channels.size(); ++i)
        if (image.channels[i] == name) return i;
    throw std::logic_error("no channel " + name);
}

/// |a - b| / max(|a|, |b|), 0 for two zeros.
inline double relativeDifference(double a, double b) {
    const double scale = std::max(std::abs(a), std::abs(b));
    return scale == 0.0 ? 0.0 : std::abs(a - b) / scale;
}

struct Difference {
    double largest = 0.0;
    int x = 0, y = 0;
    std::string channel;
    float a = 0.0f, b = 0.0f;
};
/// Largest relative difference of two pictures of the same shape.
inline Difference compare(const Image& a, const Image& b) {
    EXPECT_EQ(a.channels, b.channels);
    Difference worst;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            for (size_t c = 0; c < a.channelCount(); ++c) {
                const float va = a.pixel(x, y)[c];
                const float vb = b.pixel(x, y)[c];
                const double difference =
                    relativeDifference(static_cast<double>(va), static_cast<double>(vb));
                if (!(difference <= worst.largest)) worst = {difference, x, y, a.channels[c], va, vb};
            }
    return worst;
}
inline std::ostream& operator<<(std::ostream& out, const Difference& d) {
    return out << d.channel << " at (" << d.x << ", " << d.y << "): " << d.a << " and " << d.b;
}

/// Spheres of all registered models with punctual lights of each type, ambient and emission.
/// Of the spheres of modelsAndLights(), m.
inline constexpr double kModelRadius = 0.44;

inline Scene modelsAndLights() {
    Scene scene;
    int number = 0;
    for (const Brdf& brdf : allBrdfs()) {
        const int material = addMaterial(scene, brdf.name);
        scene.materials[static_cast<size_t>(material)].values =
            brdf.fromMetallicRoughness({{0.8, 0.5, 0.3}, 0.3, 0.5});
        const int sphere = addSphere(scene, material);
        const glm::dvec3 position(0.95 * (number % 6) - 2.375, 0.95 - 0.95 * (number / 6), 0.0);
        addInstance(scene, sphere,
                    glm::scale(glm::translate(glm::dmat4(1.0), position), glm::dvec3(kModelRadius)));
        ++number;
    }
    placeTables(scene.materials);
    scene.materials[0].emission = glm::vec3(0.05f, 0.0f, 0.02f);
    scene.ambientRadiance = glm::dvec3(0.1, 0.2, 0.3);
    scene.lights.push_back(directional({0.3, -1, -0.5}, {2.0, 1.9, 1.7}));
    scene.lights.push_back(point({1.0, 1.5, 2.0}, {3.0, 2.0, 1.0}));
    scene.lights.push_back(point({-2.0, -1.0, 1.5}, {1.0, 2.0, 3.0}, 3.0));
    scene.lights.push_back(spot({0, 2, 2}, {0.5, 0, 0}, {6.0, 6.0, 6.0}, 0.2, 0.4));
    return scene;
}

}  // namespace lobe::test
