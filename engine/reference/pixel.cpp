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

/// The largest standard error of the channels, in units of what is wanted.
double worstExcess(const glm::dvec3& mean, const glm::dvec3& variance, const Effort& effort) {
    double worst = 0.0;
    for (int c = 0; c < 3; ++c) {
        const double error = std::sqrt(variance[c]),
                     wanted = effort.relativeError * (mean[c] + effort.floor[c]);
        if (error > 0.0) worst = std::max(worst, wanted > 0.0 ? error / wanted : kInfinity);
    }
    return worst;
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
    return EnvironmentMap::of(scene);
}

std::optional<EnvironmentMap> backgroundOf(const Scene& scene) {
    if (!scene.environment || !scene.environment->background) return std::nullopt;
    return EnvironmentMap::ofBackground(scene);
}

}  // namespace

glm::dvec3 throughOf(const SurfacePoint& surface, const glm::dvec3& toEye) {
    glm::dvec3 through(1.0 - surface.alpha);
    if (surface.brdf != nullptr && surface.brdf->transmittance)
        through += surface.alpha * surface.brdf->transmittance(std::max(glm::dot(surface.normal, toEye), 0.0),
                                                               surface.values());
    return through;
}

glm::dvec3 PixelTruth::total() const {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& one : radiance)
        sum += one;
    return sum;
}

PixelIntegrator::PixelIntegrator(std::shared_ptr<const Scene> scene, const Camera& camera, int width,
                                 int height, const TruthOptions& options)
    : kept_(std::move(scene)),
      scene_(*kept_),
      view_(makeView(camera, width, height)),
      options_(options),
      tracer_(kept_, view_.eye),
      differentials_(pixelDifferentials(view_)),
      environment_(environmentOf(scene_)),
      background_(backgroundOf(scene_)),
      lights_(scene_, environment_ ? &*environment_ : nullptr, options.method) {}

PixelTruth PixelIntegrator::at(int x, int y, const Effort& effort, uint64_t seed) const {
    const auto pixel =
        static_cast<uint64_t>(y) * static_cast<uint64_t>(view_.width) + static_cast<uint64_t>(x);
    Pcg32 random(seed, pixel);
    if (options_.filter == PixelFilter::box) return overPixel(x, y, effort, random);
    return along(pixelRay(view_, x + 0.5, view_.height - y - 0.5), effort, random);
}

PixelTruth PixelIntegrator::along(const Ray& ray, const Effort& effort, Pcg32& random) const {
    LightEffort first;
    // Far below what is wanted of the whole, as the estimate is far above the error of smooth integrals.
    first.quadratureError = std::clamp(effort.relativeError / 20.0, 1e-8, 1e-3);
    // What blocks four times as much light as the error wanted is met by a ray on average.
    first.grid =
        std::clamp(static_cast<int>(std::ceil(std::sqrt(0.25 / effort.relativeError / kParts))), 1, 64);
    PixelTruth truth;
    const double metres = glm::length(ray.direction);  // a unit of the ray
    const glm::dvec3 direction = ray.direction / metres;
    glm::dvec3 remaining(1.0);  // what the layers so far let through
    double uncovered = 1.0;
    std::deque<Layer> layers;
    // Adds the fog in front of what is at some distance, of which `share` is seen; what the fog leaves of it.
    const auto addFog = [&](const glm::dvec3& share, double distance) {
        const FogOnRay fog = fogOnRay(scene_, ray.origin, direction, distance);
        truth.radiance[static_cast<size_t>(Source::fog)] += share * fog.radiance;
        return fog.transmittance;
    };
    std::vector<SurfacePoint> surfaces;
    tracer_.surfacesAlong(ray, &differentials_, surfaces);
    for (SurfacePoint& surface : surfaces) {
        if (truth.material == 0) {
            truth.depth = surface.t;
            truth.normal = surface.brdf == nullptr ? surface.geometricNormal : surface.normal;
            truth.material = surface.material + 1;
        }
        const glm::dvec3 through = throughOf(surface, -direction);
        const glm::dvec3 weight =
            remaining * surface.alpha * addFog(remaining * (1.0 - through), surface.distance);
        remaining *= through;
        uncovered *= 1.0 - surface.alpha;
        truth.radiance[static_cast<size_t>(Source::emission)] += weight * surface.emission;
        if (surface.brdf == nullptr) continue;
        truth.radiance[static_cast<size_t>(Source::ambient)] +=
            weight * surface.brdf->ambient(surface.values()) *
            scene_.ambientRadiance.value_or(glm::dvec3(0.0)) * surface.occlusion;
        Layer& layer = layers.emplace_back();
        layer.surface = std::move(surface);
        layer.weight = weight;
        const SurfacePoint& point = layer.surface;
        layer.shading = {point.position, glm::dmat3(point.tangent, point.bitangent, point.normal), -direction,
                         point.brdf, point.values()};
        layer.visible = [this, &layer, &truth](const glm::dvec3& towards, double distance) {
            ++truth.rays;
            return options_.shadows ? tracer_.visibility(layer.surface, towards, distance) : 1.0;
        };
        Contributions exact{};
        layer.integrals = lights_.at(layer.shading, layer.visible, random, exact, first);
        for (size_t source = 0; source < kSources; ++source)
            truth.radiance[source] += weight * exact[source];
    }
    truth.coverage = 1.0 - uncovered;
    if (remaining != glm::dvec3(0.0)) {
        const glm::dvec3 clear = addFog(remaining, kInfinity);
        if (background_) {
            truth.radiance[static_cast<size_t>(Source::environment)] +=
                remaining * clear * background_->radiance(direction);
            truth.coverage = 1.0;
        }
    }

    // The worst integral next, until the whole is good.
    const glm::dvec3 exact = truth.total();
    for (;;) {
        glm::dvec3 mean = exact;
        truth.variance = glm::dvec3(0.0);
        double worst = 0.0;
        LightIntegral* next = nullptr;
        for (const Layer& layer : layers)
            for (const auto& integral : layer.integrals) {
                const glm::dvec3 variance = layer.weight * layer.weight * integral->estimate().variance;
                mean += layer.weight * integral->estimate().mean;
                truth.variance += variance;
                if (const double size = variance.x + variance.y + variance.z; size > worst) {
                    worst = size;
                    next = integral.get();
                }
            }
        const double excess = worstExcess(mean, truth.variance, effort);
        if (next == nullptr || excess <= 1.0 || truth.rays + next->rays() > effort.mostRays) break;
        // The error of stratified draws falls with the side of their cells to the power of 3/2 at the least
        // where shadows' edges make it; a little more, so as not to miss by a little.
        next->refine(1.1 * std::pow(excess, 2.0 / 3.0));
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
                    const PixelTruth sample = along(pixelRay(view_, place.x, place.y), once, random);
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
        if ((!few && worstExcess(truth.total(), truth.variance, effort) <= 1.0) || rays * 4 > effort.mostRays)
            break;
    }
    Pcg32 unused(0);
    const PixelTruth middle = along(pixelRay(view_, x + 0.5, view_.height - y - 0.5), once, unused);
    truth.depth = middle.depth;
    truth.normal = middle.normal;
    truth.material = middle.material;
    return truth;
}

}  // namespace lobe::reference
