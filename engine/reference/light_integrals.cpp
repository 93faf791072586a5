#include "reference/light_integrals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/cubature.hpp"
#include "reference/body_view.hpp"
#include "reference/lobe_sampler.hpp"
#include "reference/parts.hpp"
#include "shading/punctual.hpp"

namespace lobe::reference {
namespace {

double sumOf(const glm::dvec3& v) {
    return v.x + v.y + v.z;
}

/// Stratified draws in independent parts: `grid` x `grid` cells of the unit square each, one point a cell.
class StratifiedIntegral : public LightIntegral {
public:
    void refine() final {
        begin();
        for (size_t part = 0; part < kParts; ++part)
            for (int y = 0; y < grid_; ++y)
                for (int x = 0; x < grid_; ++x)
                    sample(part, [this, x, y] {
                        return glm::dvec3((x + random_.uniform()) / grid_, (y + random_.uniform()) / grid_,
                                          random_.uniform());
                    });
        estimate_ = finish(static_cast<double>(grid_) * grid_);
        grid_ *= 2;
        nextRays_ = static_cast<long long>(kParts) * grid_ * grid_ * raysEach_;
    }

protected:
    using Point = std::function<glm::dvec3()>;
    StratifiedIntegral(Source source, const ShadingPoint& point, const Visibility& visible, Pcg32& random)
        : LightIntegral(source), point_(point), visible_(visible), random_(random) {}
    virtual void begin() = 0;
    virtual void sample(size_t part, const Point& next) = 0;
    virtual Estimate finish(double samplesEach) = 0;

    const ShadingPoint& point_;
    const Visibility& visible_;
    Pcg32& random_;
    int grid_ = 2;
    int raysEach_ = 1;
};

/// A body before a smooth lobe: what it lights unshadowed is known by quadrature, and draws find how much of
/// it is shadowed. Their mean is corrected by beta (I - mean of the unshadowed draws), where beta, the
/// regression of the shadowed on the unshadowed, comes from the other parts: unbiased, exact where all or
/// nothing is visible.
class ShadowedIntegral final : public StratifiedIntegral {
public:
    ShadowedIntegral(Source source, const ShadingPoint& point, const Visibility& visible, Pcg32& random,
                     const BodyView& view, const glm::dvec3& radiance, const CubatureResult& unshadowed)
        : StratifiedIntegral(source, point, visible, random),
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
        for (size_t part = 0; part < kParts; ++part) {
            const Sums& own = sums_[part];
            const double m = n * (kParts - 1);
            const double lit = total.lit1 - own.lit1, seen = total.seen1 - own.seen1;
            const double variance = (total.litLit - own.litLit) - lit * lit / m;
            const double covariance = (total.litSeen - own.litSeen) - lit * seen / m;
            // Draws that hardly differ say nothing but what share of them is visible.
            const double beta = variance > 1e-12 * (total.litLit - own.litLit) ? covariance / variance
                                : lit > 0.0                                    ? seen / lit
                                                                               : 1.0;
            parts[part] = own.seen / n + beta * (unshadowed_ - own.lit / n);
        }
        Estimate estimate = estimateOf(parts);
        estimate.variance += glm::dvec3(quadratureError_ * quadratureError_);
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
    MixedIntegral(Source source, const ShadingPoint& point, const Visibility& visible, Pcg32& random,
                  Lamp lamp)
        : StratifiedIntegral(source, point, visible, random),
          lamp_(std::move(lamp)),
          toLocal_(glm::transpose(point.frame)),
          lobe_(*point.brdf, point.values, toLocal_ * point.toEye) {
        raysEach_ = 2;
    }

private:
    void begin() override { sums_.fill(glm::dvec3(0.0)); }

    void sample(size_t part, const Point& next) override {
        const glm::dvec3 u = next(), v = next();
        add(part, lamp_.draw(u.x, u.y, u.z));
        add(part, point_.frame * lobe_.draw(v.x, v.y, v.z));
    }

    void add(size_t part, const glm::dvec3& direction) {
        const glm::dvec3 f = reflected(point_, direction);
        if (f == glm::dvec3(0.0)) return;
        const auto [radiance, distance] = lamp_.towards(direction);
        if (radiance == glm::dvec3(0.0)) return;
        const double density = lamp_.density(direction) + lobe_.density(toLocal_ * direction);
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
    LobeSampler lobe_;
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

/// Where the lobe changes by no more than this power of e over the light, a few cells of a quadrature see all
/// of it.
constexpr double kSmooth = 6.0;
constexpr double kRelativeError = 1e-7;
constexpr int kMostEvaluations = 20000;

/// The light without shadows.
CubatureResult unshadowed(const ShadingPoint& point, const BodyView& view, const glm::dvec3& radiance) {
    CubatureResult sum;
    sum.converged = true;
    CubatureOptions options;
    options.relativeError = kRelativeError;
    options.evaluations = kMostEvaluations;
    options.cells = 2;
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

std::unique_ptr<LightIntegral> bodyIntegral(const ShadingPoint& point, const Visibility& visible,
                                            Pcg32& random, const Light& light, Method method) {
    const BodyView view(light, point.position);
    const glm::dvec3 radiance = bodyRadiance(light, point.position);
    if (view.patches() == 0 || radiance == glm::dvec3(0.0)) return nullptr;
    const Source source = sourceOf(light.type);
    std::unique_ptr<LightIntegral> integral;
    const double sharpness = point.brdf->lobeSharpness ? point.brdf->lobeSharpness(point.values) : 0.0;
    // Half vectors turn half as fast as directions do.
    if (method == Method::automatic && sharpness * view.angularRadius() <= kSmooth) {
        const CubatureResult all = unshadowed(point, view, radiance);
        if (all.converged) {
            if (all.integral == glm::dvec3(0.0)) return nullptr;
            integral =
                std::make_unique<ShadowedIntegral>(source, point, visible, random, view, radiance, all);
        }
    }
    if (!integral)
        integral = std::make_unique<MixedIntegral<BodyLamp>>(source, point, visible, random,
                                                             BodyLamp{view, radiance});
    integral->refine();
    return integral;
}

std::unique_ptr<LightIntegral> environmentIntegral(const ShadingPoint& point, const Visibility& visible,
                                                   Pcg32& random, const EnvironmentMap& environment) {
    auto integral = std::make_unique<MixedIntegral<EnvironmentLamp>>(Source::environment, point, visible,
                                                                     random, EnvironmentLamp{environment});
    integral->refine();
    return integral;
}

}  // namespace lobe::reference
