#include "fit/lobe_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace lobe::fit {
namespace {

constexpr Eigen::Index kChunk = 256;  // its derivatives stay in the first cache
using Floats = Eigen::Array<float, 1, kChunk>;
/// Derivatives of the residuals by each number, and the residuals.
using Rows = Eigen::Matrix<float, kAllNumbers + 1, kChunk, Eigen::RowMajor>;

/// What the density of one lobe is computed from.
struct Lobe {
    float a, b, c, d, k;
    float skew;    // d / a
    float turned;  // det N / (a c)
    float factor;  // weight (k + 1) / (2 pi) det N

    Lobe(const Numbers& numbers, int offset) {
        const double power = std::exp(numbers[offset + kPowerAt]);
        const double scale = 1.0 / std::sqrt(power + 3.0);
        const double across = std::exp(numbers[offset]) * scale,
                     along = std::exp(numbers[offset + 2]) * scale;
        const double det = 1.0 - numbers[offset + 1] * numbers[offset + 3];
        a = static_cast<float>(across);
        b = static_cast<float>(numbers[offset + 1]);
        c = static_cast<float>(along);
        skew = static_cast<float>(numbers[offset + 3]);
        d = skew * a;
        k = static_cast<float>(power);
        turned = static_cast<float>(det);
        factor = static_cast<float>(std::exp(numbers[offset + kWeightAt]) * (power + 1.0) /
                                    glm::two_pi<double>() * det * across * along);
    }
};

/// A lobe of less is a line: its density is nearly 0 or beyond measure.
constexpr double kLeastTurned = 1e-3;

bool isFolded(const Numbers& numbers) {
    for (int o = 0; o < kAllNumbers; o += kLobeNumbers)
        if (!(1.0 - numbers[o + 1] * numbers[o + 3] > kLeastTurned)) return true;
    return !numbers.allFinite();
}

/// Some of the samples; those after the last are in no direction and count for nothing.
struct Chunk {
    Floats x, y, z, value, factor;

    Chunk(const SearchSamples& samples, Eigen::Index first) {
        const Eigen::Index count = std::min(kChunk, samples.x.size() - first);
        const auto take = [&](Floats& to, const Eigen::ArrayXf& from, float rest) {
            to.head(count) = from.segment(first, count).transpose();
            to.tail(kChunk - count).setConstant(rest);
        };
        take(x, samples.x, 0.0f);
        take(y, samples.y, 0.0f);
        take(z, samples.z, 1.0f);
        take(value, samples.value, 0.0f);
        take(factor, samples.factor, 0.0f);
    }
};

/// The weighted density of a lobe at the samples, and what its derivatives are made of.
struct Densities {
    Floats vx, vy, vz, inverse2;  // N w, its z above 0; 1 / |N w|^2
    Floats logCosine2;            // of the angle about the lobe's axis; not where k is 1
    Floats density;

    Densities(const Lobe& lobe, const Chunk& chunk, bool cosine) {
        vx = lobe.a * chunk.x + lobe.b * chunk.z;
        vy = lobe.c * chunk.y;
        vz = lobe.d * chunk.x + chunk.z;
        const Floats length2 = vx.square() + vy.square() + vz.square();
        inverse2 = length2.inverse();
        const auto inFront = vz > 0.0f;
        const Floats front = vz.max(1e-12f * length2.sqrt());
        if (cosine) {
            density = inFront.select(lobe.factor * front * inverse2.square(), 0.0f);
        } else {
            logCosine2 = (front.square() * inverse2).log();
            const Floats power = (0.5f * lobe.k * logCosine2).exp();
            density = inFront.select(lobe.factor * power * inverse2 * inverse2.sqrt(), 0.0f);
        }
        vz = front;
    }
};

void differentiate(const Lobe& lobe, const Densities& d, const Chunk& chunk, int o, bool cosine, Rows& rows) {
    const auto row = [&](int i) { return rows.row(o + i).array(); };
    const Floats weighted = d.density * chunk.factor;
    // Of ln D by N w, times |N w|^2 or the like; then by the numbers.
    const Floats common = -(lobe.k + 3.0f) * d.inverse2;
    const Floats slopeX = common * d.vx;
    const Floats slopeZ = common * d.vz + lobe.k * d.vz.inverse();
    const Floats byLnA = lobe.a * (slopeX + lobe.skew * slopeZ) * chunk.x + 1.0f;
    const Floats byLnC = common * d.vy.square() + 1.0f;
    row(0) = weighted * byLnA;
    row(1) = weighted * (slopeX * chunk.z - lobe.skew / lobe.turned);
    row(2) = weighted * byLnC;
    row(3) = weighted * (lobe.a * slopeZ * chunk.x - lobe.b / lobe.turned);
    if (cosine)
        row(kPowerAt).setZero();
    else
        row(kPowerAt) =
            lobe.k * weighted *
            (1.0f / (lobe.k + 1.0f) + 0.5f * d.logCosine2 - (0.5f / (lobe.k + 3.0f)) * (byLnA + byLnC));
    row(kWeightAt) = weighted;
}

using Products = Eigen::Matrix<double, kAllNumbers + 1, kAllNumbers + 1>;

/// Of each row with each before it and itself, four at a time: 13 rows are few for a product of matrices.
void addProducts(const Rows& rows, Products& products) {
    using Packet = Eigen::Array<float, 4, 1>;
    const auto packet = [&](int row, Eigen::Index i) {
        return Eigen::Map<const Packet>(rows.data() + row * kChunk + i);
    };
    for (int i = 0; i <= kAllNumbers; ++i)
        for (int j = 0; j <= i; j += 4) {
            std::array<Packet, 4> sums;
            for (Packet& sum : sums)
                sum.setZero();
            const int last = kAllNumbers;
            const std::array<int, 4> others{j, std::min(j + 1, last), std::min(j + 2, last),
                                            std::min(j + 3, last)};
            for (Eigen::Index at = 0; at < kChunk; at += 4) {
                const Packet here = packet(i, at);
                for (size_t n = 0; n < sums.size(); ++n)
                    sums[n] += here * packet(others[n], at);
            }
            for (size_t n = 0; n < sums.size(); ++n)
                if (j + static_cast<int>(n) <= i)
                    products(i, others[n]) += static_cast<double>(sums[n].sum());
        }
}

const double kLogLowest = std::log(kLowestPower), kLogHighest = std::log(kHighestPower);
/// Of weights over the albedo: none, and a lobe that is below the horizon but for a sixth.
const double kLeastLogWeight = std::log(1e-6), kMostLogWeight = std::log(6.0);

double albedoOf(const std::vector<LobeSample>& samples, size_t drawn) {
    double albedo = 0.0;
    for (const LobeSample& s : samples)
        albedo += s.value / s.density;
    return albedo / static_cast<double>(drawn);
}

/// tan of the angle about +z that half of the light is within.
double medianSlopeOf(const std::vector<LobeSample>& samples) {
    std::vector<std::pair<double, double>> slopes;
    double total = 0.0;
    for (const LobeSample& s : samples) {
        slopes.emplace_back(s.w.z > 0.0 ? std::hypot(s.w.x, s.w.y) / s.w.z : HUGE_VAL, s.value / s.density);
        total += slopes.back().second;
    }
    std::sort(slopes.begin(), slopes.end());
    constexpr double kSteepest = 3.0;
    double sum = 0.0;
    for (const auto& [slope, light] : slopes) {
        sum += light;
        if (sum >= 0.5 * total) return std::clamp(slope, 1e-9, kSteepest);
    }
    return kSteepest;
}

}  // namespace

Shapes shapesOf(const Numbers& numbers) {
    Shapes shapes;
    for (size_t j = 0; j < kLobes; ++j)
        std::copy_n(numbers.data() + static_cast<size_t>(kLobeNumbers) * j, shapes[j].size(),
                    shapes[j].begin());
    return shapes;
}

SearchSamples::SearchSamples(const std::vector<LobeSample>& samples, size_t drawn)
    : albedo_(albedoOf(samples, drawn)) {
    const auto count = static_cast<Eigen::Index>(samples.size());
    for (Eigen::ArrayXf* array : {&x, &y, &z, &value, &factor})
        array->resize(count);
    if (dark()) return;
    medianSlope_ = medianSlopeOf(samples);
    for (Eigen::Index i = 0; i < count; ++i) {
        const LobeSample& s = samples[static_cast<size_t>(i)];
        x[i] = static_cast<float>(s.w.x);
        y[i] = static_cast<float>(s.w.y);
        z[i] = static_cast<float>(s.w.z);
        const double relative = s.value / albedo_;
        value[i] = static_cast<float>(relative);
        factor[i] = static_cast<float>(
            1.0 / std::sqrt(s.density * static_cast<double>(drawn) * 0.5 * (relative + s.density)));
    }
}

std::optional<Slope> slopeAt(const Numbers& numbers, const SearchSamples& samples, bool cosines) {
    if (isFolded(numbers)) return {};
    Rows rows;
    Products products = Products::Zero();
    for (Eigen::Index first = 0; first < samples.x.size(); first += kChunk) {
        const Chunk chunk(samples, first);
        Floats residual = -chunk.value;
        for (int o = 0; o < kAllNumbers; o += kLobeNumbers) {
            const Lobe lobe(numbers, o);
            const Densities densities(lobe, chunk, cosines);
            residual += densities.density;
            differentiate(lobe, densities, chunk, o, cosines, rows);
        }
        rows.row(kAllNumbers) = residual * chunk.factor;
        addProducts(rows, products);
    }
    if (!products.allFinite()) return {};
    Slope slope;
    slope.cost = products(kAllNumbers, kAllNumbers);
    slope.gradient = products.block<1, kAllNumbers>(kAllNumbers, 0).transpose();
    slope.curvature = products.topLeftCorner<kAllNumbers, kAllNumbers>().selfadjointView<Eigen::Lower>();
    return slope;
}

Curvature freedom(const Numbers& at, const Numbers& gradient, const FitOptions& options) {
    Curvature free = Curvature::Identity();
    for (int o = 0; o < kAllNumbers; o += kLobeNumbers) {
        const double power = at[o + kPowerAt], weight = at[o + kWeightAt];
        const double byPower = gradient[o + kPowerAt], byWeight = gradient[o + kWeightAt];
        if (options.cosines || (power <= kLogLowest && byPower > 0.0) ||
            (power >= kLogHighest && byPower < 0.0))
            free(o + kPowerAt, o + kPowerAt) = 0.0;
        if ((weight <= kLeastLogWeight && byWeight > 0.0) || (weight >= kMostLogWeight && byWeight < 0.0))
            free(o + kWeightAt, o + kWeightAt) = 0.0;
        if (!options.roundAbout) continue;
        free(o + 2, o) = 1.0;
        for (int fixed : {1, 2, 3})
            free(o + fixed, o + fixed) = 0.0;
    }
    return free;
}

Numbers stepped(const Numbers& from, const Numbers& step) {
    constexpr double kLongest = 1.0;
    Numbers to = from + step.cwiseMax(-kLongest).cwiseMin(kLongest);
    for (int o = 0; o < kAllNumbers; o += kLobeNumbers) {
        to[o + kPowerAt] = std::clamp(to[o + kPowerAt], kLogLowest, kLogHighest);
        to[o + kWeightAt] = std::clamp(to[o + kWeightAt], kLeastLogWeight, kMostLogWeight);
    }
    return to;
}

LobeFit improve(const Numbers& start, const SearchSamples& samples, const FitOptions& options) {
    constexpr double kLittle = 1e-4;  // what is worth another step, of the cost
    const double pull2 = options.pull * options.pull;
    const auto pulled = [&](const Numbers& numbers, double cost) {
        return cost + pull2 * (numbers - start).squaredNorm();
    };
    LobeFit fit{start, HUGE_VAL};
    std::optional<Slope> slope = slopeAt(start, samples, options.cosines);
    if (!slope) return fit;
    double damping = 1e-3, objective = slope->cost;
    fit.cost = slope->cost;
    for (int i = 0; i < options.evaluations; ++i) {
        const Numbers gradient = slope->gradient + pull2 * (fit.numbers - start);
        const Curvature free = freedom(fit.numbers, gradient, options);
        const Curvature curvature = free.transpose() * slope->curvature * free;
        Curvature damped = curvature;
        for (int n = 0; n < kAllNumbers; ++n)
            damped(n, n) += damping * (curvature(n, n) + 1e-6) + pull2 + 1e-12;
        const Numbers step = free * damped.ldlt().solve(-(free.transpose() * gradient));
        const Numbers next = stepped(fit.numbers, step);
        const std::optional<Slope> there = slopeAt(next, samples, options.cosines);
        if (!there || !(pulled(next, there->cost) < objective)) {
            damping *= 8.0;
            if (damping > 1e4) break;
            continue;
        }
        const double before = objective;
        objective = pulled(next, there->cost);
        slope = there;
        fit = {next, there->cost};
        damping = std::max(damping * 0.2, 1e-7);
        if (before - objective < kLittle * before) break;
    }
    return fit;
}

LobeFit fitFresh(const SearchSamples& samples, const FitOptions& options) {
    LobeFit best{Numbers::Zero(), HUGE_VAL};
    for (double k : {1.5, 10.0, 50.0}) {
        if (options.cosines && k > 2.0) break;
        const double power = options.cosines ? 1.0 : k;
        // Half of a cosine power is within this tan.
        const double median = std::sqrt(std::exp2(2.0 / (power + 1.0)) - 1.0);
        const double width = std::log(median / samples.medianSlope() * std::sqrt(power + 3.0));
        for (double shift : {0.0, 0.5, -0.5}) {
            if (options.roundAbout && shift != 0.0) break;
            const double spread = shift == 0.0 ? 0.4 : 0.0, weight = -std::log(2.0);
            Numbers start;
            start << width + spread, shift, width + spread, 0.0, std::log(power), weight,  //
                width - spread, -shift, width - spread, 0.0, std::log(power), weight;
            const LobeFit fit = improve(start, samples, options);
            if (fit.cost < best.cost) best = fit;
        }
    }
    return best;
}

}  // namespace lobe::fit
