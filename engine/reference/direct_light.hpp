/// Light that reaches a point straight from its sources and is reflected to the eye, in double from the
/// twins.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "environment/environment_map.hpp"
#include "math/random.hpp"
#include "scene/scene.hpp"

namespace lobe::reference {

class BodyImage;

/// What radiance comes from. Light types follow in their order.
enum class Source : uint8_t {
    emission,
    ambient,
    directional,
    point,
    spot,
    rect,
    disk,
    sphere,
    tube,
    environment,
    fog
};
inline constexpr size_t kSources = 11;
/// Radiance by source.
using Contributions = std::array<glm::dvec3, kSources>;
/// "emission", "ambient", ...
const char* nameOf(Source source);
Source sourceOf(LightType type);

/// A point of a surface. Columns of `frame`: tangent, bitangent, shading normal, in world axes.
struct ShadingPoint {
    glm::dvec3 position{0.0};  ///< world, metres
    glm::dmat3 frame{1.0};
    glm::dvec3 toEye{0.0, 0.0, 1.0};  ///< unit, world
    const Brdf* brdf = nullptr;
    std::span<const double> values;
};

/// Transmittance of the way from the point in a direction (unit, world) over a distance (metres, or
/// infinity).
using Visibility = std::function<double(const glm::dvec3& direction, double distance)>;

/// Radiance with what is known of its error: the variance of the mean, from independent parts, and the
/// estimate of the quadrature's error, squared.
struct Estimate {
    glm::dvec3 mean{0.0};
    glm::dvec3 variance{0.0};
};

/// The light of one source, better with every refine().
class LightIntegral {
public:
    virtual ~LightIntegral() = default;
    /// Draws anew, with `factor` (1.2 to 4) times as many cells along each side of the strata; the first time
    /// with those it was made for.
    virtual void refine(double factor = 2.0) = 0;
    /// That the estimate has cost.
    virtual long long rays() const = 0;
    Source source() const { return source_; }
    const Estimate& estimate() const { return estimate_; }

protected:
    explicit LightIntegral(Source source) : source_(source) {}
    Source source_;
    Estimate estimate_;
};

/// How lights with a body are integrated: by quadrature wherever that is smooth, or, to check it, by sampling
/// alone.
enum class Method : uint8_t { automatic, sampled };

/// How well lights are integrated at first.
struct LightEffort {
    int grid = 2;                   ///< strata: cells along each side of the square, in each independent part
    double quadratureError = 1e-7;  ///< relative, wanted of smooth integrals
};

/// What a surface reflects of all lights of a scene.
class DirectLight {
public:
    /// Both are kept by reference; `environment` may be null.
    DirectLight(const Scene& scene, const EnvironmentMap* environment, Method method = Method::automatic);

    /// What has no extent is added to `exact` at once (directional, point and spot lights, and what a mirror
    /// shows); what has is returned, after its first refine(). `point`, its values and `visible` must live as
    /// long as the result.
    std::vector<std::unique_ptr<LightIntegral>> at(const ShadingPoint& point, const Visibility& visible,
                                                   Pcg32& random, Contributions& exact,
                                                   const LightEffort& effort = {}) const;

private:
    glm::dvec3 punctual(const ShadingPoint& point, const Visibility& visible, const Light& light) const;
    void addMirrored(const ShadingPoint& point, const Visibility& visible, Contributions& exact) const;
    const Scene& scene_;
    const EnvironmentMap* environment_;
    Method method_;
    std::vector<std::shared_ptr<const BodyImage>> images_;  ///< of each light; null: it shows none
};

}  // namespace lobe::reference
