#include "reference/pixel.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "reference/fog.hpp"
#include "reference/parts.hpp"

namespace lobe::reference {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool good(const glm::dvec3& mean, const glm::dvec3& variance, const Effort& effort) {
    for (int c = 0; c < 3; ++c)
        if (std::sqrt(variance[c]) > effort.relativeError * (mean[c] + effort.floor[c])) return false;
    return true;
}

/// A surface's share of what the eye gets, and all that must live while its integrals do.
struct Layer {
    SurfacePoint surface;
    ShadingPoint shading;
    Visibility visible;
    glm::dvec3 weight{0.0};
    std::vector<std::unique_ptr<LightIntegral>> integrals;
};

std::optional<EnvironmentMap> environmentOf(const Scene& scene) {
    if (!scene.environment) return std::nullopt;
    const int image = scene.environment->image;
    return EnvironmentMap(*scene.environment,
                          image < 0 ? nullptr : &scene.images[static_cast<size_t>(image)]);
}

}  // namespace

glm::dvec3 PixelTruth::total() const {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& one : radiance)
        sum += one;
    return sum;
}

PixelIntegrator::PixelIntegrator(const Scene& scene, const Camera& camera, int width, int height,
                                 const TruthOptions& options)
    : scene_(scene),
      camera_(camera),
      view_(makeView(camera, width, height)),
      options_(options),
      tracer_(scene, view_.eye),
      environment_(environmentOf(scene)),
      lights_(scene, environment_ ? &*environment_ : nullptr, options.method) {}

PixelRay PixelIntegrator::rayThrough(const glm::dvec2& place) const {
    const auto ray = [&](double x, double y) {
        return Ray{view_.eye + view_.rayOrigin + x * view_.rayOriginDx + y * view_.rayOriginDy,
                   view_.rayDirection + x * view_.rayDirectionDx + y * view_.rayDirectionDy};
    };
    PixelRay result;
    static_cast<Ray&>(result) = ray(place.x, place.y);
    result.dx = ray(place.x + 1.0, place.y);
    result.dy = ray(place.x, place.y + 1.0);
    return result;
}

PixelTruth PixelIntegrator::at(int x, int y, const Effort& effort, uint64_t seed) const {
    const auto pixel =
        static_cast<uint64_t>(y) * static_cast<uint64_t>(view_.width) + static_cast<uint64_t>(x);
    Pcg32 random(seed, pixel);
    if (options_.filter == PixelFilter::box) return overPixel(x, y, effort, random);
    return along(rayThrough({x + 0.5, view_.height - y - 0.5}), effort, random);
}

PixelTruth PixelIntegrator::along(const PixelRay& ray, const Effort& effort, Pcg32& random) const {
    // Far below what is wanted of the whole, as the estimate is far above the error of smooth integrals.
    const double quadratureError = std::clamp(effort.relativeError / 20.0, 1e-8, 1e-3);
    PixelTruth truth;
    const double metres = glm::length(ray.direction);  // a unit of the ray
    const glm::dvec3 direction = ray.direction / metres;
    double remaining = 1.0;  // what the layers so far let through
    std::deque<Layer> layers;
    const auto addFog = [&](double share, double distance) {
        if (!scene_.fog) return glm::dvec3(share);
        const glm::dvec3 clear = fogTransmittance(*scene_.fog, ray.origin.y, direction.y, distance);
        truth.radiance[static_cast<size_t>(Source::fog)] += share * (1.0 - clear) * scene_.fog->radiance;
        return share * clear;
    };
    for (SurfacePoint& surface :
         tracer_.surfacesAlong(ray, camera_.zNear, camera_.zFar.value_or(kInfinity))) {
        const glm::dvec3 way = surface.position - ray.origin;
        if (truth.material == 0) {
            truth.depth = glm::dot(surface.position - view_.eye, view_.forward);
            truth.normal = surface.brdf == nullptr ? surface.geometricNormal : surface.frame[2];
            truth.material = surface.material + 1;
        }
        const glm::dvec3 weight = addFog(remaining * surface.alpha, glm::length(way));
        remaining *= 1.0 - surface.alpha;
        truth.radiance[static_cast<size_t>(Source::emission)] += weight * surface.emission;
        if (surface.brdf == nullptr) continue;
        truth.radiance[static_cast<size_t>(Source::ambient)] +=
            weight * surface.brdf->ambient(surface.values) *
            scene_.ambientRadiance.value_or(glm::dvec3(0.0)) * surface.occlusion;
        Layer& layer = layers.emplace_back();
        layer.surface = std::move(surface);
        layer.weight = weight;
        layer.shading = {layer.surface.position, layer.surface.frame, -direction, layer.surface.brdf,
                         layer.surface.values};
        layer.visible = [this, &layer, &truth](const glm::dvec3& towards, double distance) {
            ++truth.rays;
            return options_.shadows ? tracer_.visibility(layer.surface, towards, distance) : 1.0;
        };
        Contributions exact{};
        layer.integrals = lights_.at(layer.shading, layer.visible, random, exact, quadratureError);
        for (size_t source = 0; source < kSources; ++source)
            truth.radiance[source] += weight * exact[source];
    }
    truth.coverage = 1.0 - remaining;
    if (environment_ && scene_.environment->background && remaining > 0.0)
        truth.radiance[static_cast<size_t>(Source::environment)] +=
            addFog(remaining, kInfinity) * environment_->radiance(direction);
    else if (remaining > 0.0)
        (void)addFog(remaining, kInfinity);

    // The worst integral next, until the whole is good.
    const glm::dvec3 exact = truth.total();
    for (;;) {
        glm::dvec3 mean = exact;
        truth.variance = glm::dvec3(0.0);
        double worst = -1.0;
        LightIntegral* next = nullptr;
        for (const Layer& layer : layers)
            for (const auto& integral : layer.integrals) {
                const glm::dvec3 variance = layer.weight * layer.weight * integral->estimate().variance;
                mean += layer.weight * integral->estimate().mean;
                truth.variance += variance;
                // What blocks less than the error wanted may have been missed by so few rays.
                const bool few = integral->nextRays() <= 1.0 / effort.relativeError;
                const double size = few ? kInfinity : variance.x + variance.y + variance.z;
                if (size > worst) {
                    worst = size;
                    next = integral.get();
                }
            }
        const bool enough = good(mean, truth.variance, effort) && worst < kInfinity;
        if (next == nullptr || enough || truth.rays + next->nextRays() > effort.mostRays) break;
        next->refine();
    }
    for (const Layer& layer : layers)
        for (const auto& integral : layer.integrals)
            truth.radiance[static_cast<size_t>(integral->source())] +=
                layer.weight * integral->estimate().mean;
    return truth;
}

PixelTruth PixelIntegrator::overPixel(int x, int y, const Effort& effort, Pcg32& random) const {
    Effort once;
    once.relativeError = kInfinity;
    PixelTruth truth;
    long long rays = 0;
    for (int grid = 1;; grid *= 2) {
        std::array<Contributions, kParts> sums{};
        std::array<double, kParts> coverage{};
        const double share = 1.0 / (static_cast<double>(grid) * grid);
        for (size_t part = 0; part < kParts; ++part)
            for (int row = 0; row < grid; ++row)
                for (int column = 0; column < grid; ++column) {
                    const glm::dvec2 place(x + (column + random.uniform()) / grid,
                                           view_.height - y - (row + random.uniform()) / grid);
                    const PixelTruth sample = along(rayThrough(place), once, random);
                    rays += sample.rays + 1;
                    coverage[part] += share * sample.coverage;
                    for (size_t source = 0; source < kSources; ++source)
                        sums[part][source] += share * sample.radiance[source];
                }
        truth.radiance = {};
        truth.coverage = 0.0;
        Parts totals{};
        for (size_t part = 0; part < kParts; ++part) {
            truth.coverage += coverage[part] / kParts;
            for (size_t source = 0; source < kSources; ++source) {
                totals[part] += sums[part][source];
                truth.radiance[source] += sums[part][source] / static_cast<double>(kParts);
            }
        }
        truth.variance = estimateOf(totals).variance;
        truth.rays = rays;
        // A small thing may have been missed by so few rays.
        const bool few = kParts * static_cast<double>(grid) * grid < 0.5 / effort.relativeError;
        if ((!few && good(truth.total(), truth.variance, effort)) || rays * 4 > effort.mostRays) break;
    }
    Pcg32 unused(0);
    const PixelTruth middle = along(rayThrough({x + 0.5, view_.height - y - 0.5}), once, unused);
    truth.depth = middle.depth;
    truth.normal = middle.normal;
    truth.material = middle.material;
    return truth;
}

}  // namespace lobe::reference
