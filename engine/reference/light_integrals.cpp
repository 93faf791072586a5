#include "reference/light_integrals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <list>
#include <numbers>
#include <optional>

#include "math/cubature.hpp"
#include "reference/body_lamp.hpp"
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
    ShadowedIntegral(Source source, const Scatterer& at, int grid, const BodyLamp& lamp,
                     const CubatureResult& unshadowed)
        : StratifiedIntegral(source, at, grid),
          lamp_(lamp),
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
        const BodySample drawn = lamp_.draw(u.x, u.y, u.z);
        if (drawn.solidAngle == 0.0) return;
        const glm::dvec3 lit = reflected(point_, drawn.direction) *
                               lamp_.radiance(drawn.direction, drawn.distance) * drawn.solidAngle;
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

    BodyLamp lamp_;
    glm::dvec3 unshadowed_;
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
        add(part, lamp_.draw(u.x, u.y, u.z).direction);
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

struct EnvironmentLamp {
    const EnvironmentMap& map;
    BodySample draw(double u, double v, double) const { return {map.draw(u, v), 0.0, 0.0}; }
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
/// Of an image, in all its parts.
constexpr int kMostParts = 2500;
constexpr int kMostImageEvaluations = 400000;

void add(CubatureResult& sum, const CubatureResult& one) {
    sum.integral += one.integral;
    sum.error += one.error;
    sum.evaluations += one.evaluations;
    sum.converged &= one.converged;
}

/// What `view` shows of the lamp, `light` or a part of it, without shadows. `sharpness`: the power of e by
/// which the lobe changes over it.
CubatureResult unshadowed(const ShadingPoint& point, const Light& light, const BodyView& view,
                          const BodyLamp& lamp, double sharpness, double relativeError) {
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
        add(sum, integrateSquare(
                     [&](double u, double v) {
                         const BodySample seen = view.at(patch, u, v);
                         return seen.solidAngle > 0.0
                                    ? reflected(point, seen.direction) *
                                          lamp.radiance(seen.direction, seen.distance) * seen.solidAngle
                                    : glm::dvec3(0.0);
                     },
                     options));
    }
    return sum;
}

/// The part of a rect between the centres of four texels, or between them and its edges, where its image is
/// smooth; nothing where it is black.
std::optional<Light> partOf(const Light& light, const LightImage& image, int x, int y) {
    const glm::dvec2 size(image.width(), image.height());
    const glm::dvec2 low = glm::max((glm::dvec2(x, y) - 0.5) / size, 0.0);
    const glm::dvec2 high = glm::min((glm::dvec2(x, y) + 0.5) / size, 1.0);
    if (image.at(low) + image.at(high) + image.at({low.x, high.y}) + image.at({high.x, low.y}) ==
        glm::dvec3(0.0))
        return std::nullopt;
    const glm::dvec2 center = 0.5 * (low + high);
    Light part = light;
    part.position += (0.5 - center.x) * light.width * light.axis +
                     (center.y - 0.5) * light.height * glm::cross(light.direction, light.axis);
    part.width *= high.x - low.x;
    part.height *= high.y - low.y;
    return part;
}

/// The same of a rect with an image. `sharpness`: by radian.
CubatureResult unshadowedImage(const ShadingPoint& point, const Light& light, const LightImage& image,
                               const BodyLamp& lamp, double sharpness, double relativeError) {
    CubatureResult sum;
    sum.converged = (image.width() + 1) * (image.height() + 1) <= kMostParts;
    for (int y = 0; sum.converged && y <= image.height(); ++y)
        for (int x = 0; sum.converged && x <= image.width(); ++x) {
            const auto part = partOf(light, image, x, y);
            if (!part) continue;
            const BodyView view(*part, point.position);
            add(sum, unshadowed(point, *part, view, lamp, sharpness * view.angularRadius(), relativeError));
            sum.converged &= sum.evaluations <= kMostImageEvaluations;
        }
    return sum;
}

}  // namespace

glm::dvec3 bodyRadiance(const Light& light, const glm::dvec3& point) {
    const glm::dvec3 toLight = light.position - point;
    return radianceOf(light) * rangeWindow(glm::dot(toLight, toLight), light.range);
}

std::unique_ptr<LightIntegral> bodyIntegral(const Scatterer& at, const Light& light, const BodyImage* image,
                                            Method method, const LightEffort& effort) {
    const ShadingPoint& point = at.point;
    const glm::dvec3 radiance = bodyRadiance(light, point.position);
    const BodyLamp lamp(light, point.position, radiance, image);
    const BodyView& view = lamp.view();
    if (view.patches() == 0 || (image != nullptr && image->black()) || radiance == glm::dvec3(0.0))
        return nullptr;
    const Source source = sourceOf(light.type);
    std::unique_ptr<LightIntegral> integral;
    const double sharpness = point.brdf->lobeSharpness ? point.brdf->lobeSharpness(point.values) : 0.0;
    const int parts = image != nullptr ? std::min(image->image().width(), image->image().height()) : 1;
    if (method == Method::automatic && sharpness * view.angularRadius() <= kSmooth * parts) {
        const CubatureResult all =
            image != nullptr
                ? unshadowedImage(point, light, image->image(), lamp, sharpness, effort.quadratureError)
                : unshadowed(point, light, view, lamp, sharpness * view.angularRadius(),
                             effort.quadratureError);
        if (all.converged) {
            if (all.integral == glm::dvec3(0.0)) return nullptr;
            integral = std::make_unique<ShadowedIntegral>(source, at, effort.grid, lamp, all);
        }
    }
    if (!integral) integral = std::make_unique<MixedIntegral<BodyLamp>>(source, at, effort.grid, lamp);
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
