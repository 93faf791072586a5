#include "reference/light_integrals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <list>
#include <numbers>

#include "math/cubature.hpp"
#include "reference/body_view.hpp"
#include "reference/parts.hpp"
#include "shading/punctual.hpp"
#include "shading/sampling.hpp"

namespace lobe::reference {
namespace {

double sumOf(const glm::dvec3& v) {
    return v.x + v.y + v.z;
}

/// The sampler of a model with these values, made anew only where they change: between pixels they often do
/// not.
const BrdfSampler& samplerOf(const Brdf& brdf, std::span<const double> values) {
    struct Entry {
        const Brdf* brdf;
        ParameterValues values;
        BrdfSampler sampler;
    };
    constexpr size_t kKept = 16;
    thread_local std::list<Entry> entries;
    for (auto entry = entries.begin(); entry != entries.end(); ++entry)
        if (entry->brdf == &brdf &&
            std::equal(values.begin(), values.end(), entry->values.begin(), entry->values.end())) {
            entries.splice(entries.begin(), entries, entry);
            return entries.front().sampler;
        }
    entries.push_front({&brdf, ParameterValues(values.begin(), values.end()), BrdfSampler(brdf, values)});
    if (entries.size() > kKept) entries.pop_back();
    return entries.front().sampler;
}

/// Stratified draws in independent parts: `grid` x `grid` cells of the unit square each, one point a cell.
class StratifiedIntegral : public LightIntegral {
public:
    void refine(double factor) final {
        if (drawn_)
            grid_ =
                std::max(grid_ + 1,
                         static_cast<int>(std::ceil(grid_ * std::clamp(factor, kLeastGrowth, kMostGrowth))));
        drawn_ = true;
        begin();
        for (size_t part = 0; part < kParts; ++part)
            for (int y = 0; y < grid_; ++y)
                for (int x = 0; x < grid_; ++x)
                    sample(part, [this, x, y] {
                        return glm::dvec3((x + random_.uniform()) / grid_, (y + random_.uniform()) / grid_,
                                          random_.uniform());
                    });
        estimate_ = finish(static_cast<double>(grid_) * grid_);
    }

    long long rays() const final { return static_cast<long long>(kParts) * grid_ * grid_ * raysEach_; }

protected:
    using Point = std::function<glm::dvec3()>;
    StratifiedIntegral(Source source, const Scatterer& at, int grid)
        : LightIntegral(source), point_(at.point), visible_(at.visible), random_(at.random), grid_(grid) {}
    virtual void begin() = 0;
    virtual void sample(size_t part, const Point& next) = 0;
    virtual Estimate finish(double samplesEach) = 0;

    const ShadingPoint& point_;
    const Visibility& visible_;
    Pcg32& random_;
    int raysEach_ = 1;

private:
    static constexpr double kLeastGrowth = 1.2, kMostGrowth = 4.0;
    int grid_;  ///< cells along each side of the square, in each part
    bool drawn_ = false;
};

/// A body before a smooth lobe: what it lights unshadowed is known by quadrature, and draws find how much of
/// it is shadowed. Their mean is corrected by beta (I - mean of the unshadowed draws), where beta, the
/// regression of the shadowed on the unshadowed, comes from the other parts: unbiased, exact where all or
/// nothing is visible.
class ShadowedIntegral final : public StratifiedIntegral {
public:
    ShadowedIntegral(Source source, const Scatterer& at, int grid, const BodyView& view,
                     const glm::dvec3& radiance, const CubatureResult& unshadowed)
        : StratifiedIntegral(source, at, grid),
          view_(view),
          radiance_(radiance),
          unshadowed_(unshadowed.integral),
          quadratureError_(unshadowed.error) {}

private:
    struct Sums {
        glm::dvec3 lit{0.0}, seen{0.0};
        double lit1 = 0.0, seen1 = 0.0, litLit = 0.0, litSeen = 0.0;
        Sums& operator+=(const Sums& o) {
            lit += o.lit;
            seen += o.seen;
            lit1 += o.lit1;
            seen1 += o.seen1;
            litLit += o.litLit;
            litSeen += o.litSeen;
            return *this;
        }
    };

    void begin() override { sums_.fill({}); }

    void sample(size_t part, const Point& next) override {
        const glm::dvec3 u = next();
        const BodySample drawn = view_.draw(u.x, u.y, u.z);
        if (drawn.solidAngle == 0.0) return;
        const glm::dvec3 lit = reflected(point_, drawn.direction) * radiance_ * drawn.solidAngle;
        if (lit == glm::dvec3(0.0)) return;
        const double transmittance = visible_(drawn.direction, drawn.distance);
        Sums& sums = sums_[part];
        const double one = sumOf(lit);
        sums += {lit, lit * transmittance, one, one * transmittance, one * one, one * one * transmittance};
    }

    Estimate finish(double n) override {
        Sums total;
        for (const Sums& sums : sums_)
            total += sums;
        Parts parts;
        double weight = 0.0;
        for (size_t part = 0; part < kParts; ++part) {
            const Sums& own = sums_[part];
            const double m = n * (kParts - 1);
            const double lit = total.lit1 - own.lit1, seen = total.seen1 - own.seen1;
            const double variance = (total.litLit - own.litLit) - lit * lit / m;
            const double covariance = (total.litSeen - own.litSeen) - lit * seen / m;
            // Draws that hardly differ say nothing but what share of them is visible. Any weight is unbiased;
            // one beyond what visibility can be only adds noise.
            const double beta = variance > 1e-12 * (total.litLit - own.litLit)
                                    ? std::clamp(covariance / variance, 0.0, 1.0)
                                : lit > 0.0 ? seen / lit
                                            : 1.0;
            parts[part] = own.seen / n + beta * (unshadowed_ - own.lit / n);
            weight += beta / kParts;
        }
        Estimate estimate = estimateOf(parts);
        const double quadrature = weight * quadratureError_;
        estimate.variance += glm::dvec3(quadrature * quadrature);
        return estimate;
    }

    BodyView view_;
    glm::dvec3 radiance_, unshadowed_;
    double quadratureError_;
    std::array<Sums, kParts> sums_;
};

/// Draws from the light and from the lobe, weighted by the balance heuristic (Veach, Guibas 1995).
template<class Lamp>
class MixedIntegral final : public StratifiedIntegral {
public:
    MixedIntegral(Source source, const Scatterer& at, int grid, Lamp lamp)
        : StratifiedIntegral(source, at, grid),
          lamp_(std::move(lamp)),
          toLocal_(glm::transpose(at.point.frame)),
          lobe_(samplerOf(*at.point.brdf, at.point.values).at(toLocal_ * at.point.toEye)) {
        raysEach_ = 2;
    }

private:
    void begin() override { sums_.fill(glm::dvec3(0.0)); }

    void sample(size_t part, const Point& next) override {
        const glm::dvec3 u = next(), v = next();
        add(part, lamp_.draw(u.x, u.y, u.z));
        add(part, point_.frame * sampleDirection(lobe_, v.z, v.x, v.y));
    }

    void add(size_t part, const glm::dvec3& direction) {
        const glm::dvec3 f = reflected(point_, direction);
        if (f == glm::dvec3(0.0)) return;
        const auto [radiance, distance] = lamp_.towards(direction);
        if (radiance == glm::dvec3(0.0)) return;
        const double density = lamp_.density(direction) + samplingDensity(lobe_, toLocal_ * direction);
        if (!(density > 0.0)) return;
        sums_[part] += f * radiance * (visible_(direction, distance) / density);
    }

    Estimate finish(double n) override {
        Parts parts;
        for (size_t part = 0; part < kParts; ++part)
            parts[part] = sums_[part] / n;
        return estimateOf(parts);
    }

    Lamp lamp_;
    glm::dmat3 toLocal_;
    SamplingMixture lobe_;
    Parts sums_{};
};

struct BodyLamp {
    BodyView view;
    glm::dvec3 radiance;
    glm::dvec3 draw(double u, double v, double w) const { return view.draw(u, v, w).direction; }
    double density(const glm::dvec3& direction) const { return view.density(direction); }
    std::pair<glm::dvec3, double> towards(const glm::dvec3& direction) const {
        const auto distance = view.distanceAlong(direction);
        return distance ? std::pair(radiance, *distance) : std::pair(glm::dvec3(0.0), 0.0);
    }
};

struct EnvironmentLamp {
    const EnvironmentMap& map;
    glm::dvec3 draw(double u, double v, double) const { return map.draw(u, v); }
    double density(const glm::dvec3& direction) const { return map.density(direction); }
    std::pair<glm::dvec3, double> towards(const glm::dvec3& direction) const {
        return {map.radiance(direction), std::numeric_limits<double>::infinity()};
    }
};

/// Where the lobe changes by no more than this power of e over the light, the cells of a quadrature see all
/// of it; there is one more in each direction for every kCellSharpness of them.
constexpr double kSmooth = 24.0;
constexpr double kCellSharpness = 4.0;
constexpr int kCellsAtHorizon = 8;
constexpr int kMostEvaluations = 20000;

/// The light without shadows. `sharpness`: the power of e by which the lobe changes over the light.
CubatureResult unshadowed(const ShadingPoint& point, const Light& light, const BodyView& view,
                          const glm::dvec3& radiance, double sharpness, double relativeError) {
    CubatureResult sum;
    sum.converged = true;
    CubatureOptions options;
    options.relativeError = relativeError;
    options.evaluations = kMostEvaluations;
    options.cells = 2 + static_cast<int>(sharpness / kCellSharpness);
    // Where the horizon cuts the light, the sliver beyond the outermost points of a cell is not seen: small
    // cells keep it below a millionth.
    const glm::dvec3 toLight = light.position - point.position;
    const double height = glm::dot(toLight, point.frame[2]), distance = glm::length(toLight);
    if (std::abs(height) < distance * std::sin(std::min(view.angularRadius(), std::numbers::pi / 2)) ||
        view.angularRadius() >= std::numbers::pi / 2)
        options.cells = std::max(options.cells, kCellsAtHorizon);
    for (int patch = 0; patch < view.patches(); ++patch) {
        const CubatureResult one = integrateSquare(
            [&](double u, double v) {
                const BodySample seen = view.at(patch, u, v);
                return seen.solidAngle > 0.0 ? reflected(point, seen.direction) * radiance * seen.solidAngle
                                             : glm::dvec3(0.0);
            },
            options);
        sum.integral += one.integral;
        sum.error += one.error;
        sum.converged &= one.converged;
    }
    return sum;
}

}  // namespace

glm::dvec3 bodyRadiance(const Light& light, const glm::dvec3& point) {
    const glm::dvec3 toLight = light.position - point;
    return radianceOf(light) * rangeWindow(glm::dot(toLight, toLight), light.range);
}

std::unique_ptr<LightIntegral> bodyIntegral(const Scatterer& at, const Light& light, Method method,
                                            const LightEffort& effort) {
    const ShadingPoint& point = at.point;
    const BodyView view(light, point.position);
    const glm::dvec3 radiance = bodyRadiance(light, point.position);
    if (view.patches() == 0 || radiance == glm::dvec3(0.0)) return nullptr;
    const Source source = sourceOf(light.type);
    std::unique_ptr<LightIntegral> integral;
    const double sharpness =
        (point.brdf->lobeSharpness ? point.brdf->lobeSharpness(point.values) : 0.0) * view.angularRadius();
    if (method == Method::automatic && sharpness <= kSmooth) {
        const CubatureResult all =
            unshadowed(point, light, view, radiance, sharpness, effort.quadratureError);
        if (all.converged) {
            if (all.integral == glm::dvec3(0.0)) return nullptr;
            integral = std::make_unique<ShadowedIntegral>(source, at, effort.grid, view, radiance, all);
        }
    }
    if (!integral)
        integral =
            std::make_unique<MixedIntegral<BodyLamp>>(source, at, effort.grid, BodyLamp{view, radiance});
    integral->refine();
    return integral;
}

std::unique_ptr<LightIntegral> environmentIntegral(const Scatterer& at, const EnvironmentMap& environment,
                                                   const LightEffort& effort) {
    std::unique_ptr<LightIntegral> integral = std::make_unique<MixedIntegral<EnvironmentLamp>>(
        Source::environment, at, effort.grid, EnvironmentLamp{environment});
    integral->refine();
    return integral;
}

}  // namespace lobe::reference
