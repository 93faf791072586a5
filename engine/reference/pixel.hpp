/// The radiance of one pixel, with its error.
#pragma once

#include <optional>

#include "reference/direct_light.hpp"
#include "reference/tracer.hpp"
#include "scene/camera.hpp"

namespace lobe::reference {

/// Point: the ray through the pixel's centre, as a picture without anti-aliasing has it. Box: the mean over
/// the pixel.
enum class PixelFilter : uint8_t { point, box };

struct TruthOptions {
    PixelFilter filter = PixelFilter::point;
    bool shadows = true;  ///< without: everything sees everything, as renderers without shadows draw
    Method method = Method::automatic;
};

/// When a pixel is good enough.
struct Effort {
    double relativeError = 0.01;  ///< wanted standard error, of the pixel's radiance
    glm::dvec3 floor{0.0};  ///< added to the radiance before: what is dark against it need not be better
    long long mostRays = 1 << 20;  ///< a pixel
};

struct PixelTruth {
    Contributions radiance{};  ///< by source, as the eye gets it
    glm::dvec3 variance{0.0};  ///< of their sum
    double coverage = 0.0;     ///< by surfaces, 0 to 1
    long long rays = 0;
    /// Of the nearest surface, where there is one: depth along the view axis in metres, normal, material + 1.
    double depth = 0.0;
    glm::dvec3 normal{0.0};
    int material = 0;

    glm::dvec3 total() const;
};

/// What shows of things behind a surface, per channel: where it does not cover them, and what it lets
/// through.
glm::dvec3 throughOf(const SurfacePoint& surface, const glm::dvec3& toEye);

/// One for any number of threads.
class PixelIntegrator {
public:
    PixelIntegrator(std::shared_ptr<const Scene> scene, const Camera& camera, int width, int height,
                    const TruthOptions& options);

    /// Pixel (x, y), row 0 at the top. Equal seeds give equal results; different ones independent ones.
    PixelTruth at(int x, int y, const Effort& effort, uint64_t seed) const;

    const View& view() const { return view_; }
    const Tracer& tracer() const { return tracer_; }
    const EnvironmentMap* environment() const { return environment_ ? &*environment_ : nullptr; }

private:
    PixelTruth along(const Ray& ray, const Effort& effort, Pcg32& random) const;
    PixelTruth overPixel(int x, int y, const Effort& effort, Pcg32& random) const;

    std::shared_ptr<const Scene> kept_;
    const Scene& scene_;
    View view_;
    TruthOptions options_;
    Tracer tracer_;
    RayDifferentials differentials_;
    std::optional<EnvironmentMap> environment_, background_;  ///< what lights, and what is seen
    DirectLight lights_;
};

}  // namespace lobe::reference
