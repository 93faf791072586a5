/// Draws of every model against the density that goes with them, and what they estimate.
#include "shading/sampling.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "albedo.hpp"
#include "math/quadrature.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"

namespace lobe {
namespace {

const double kPi = glm::pi<double>();
/// Of a whole test that finds a fault where there is none; shared out among its cases (Bonferroni).
constexpr double kSignificance = 1e-3;
constexpr int kDraws = 40000;

struct Case {
    std::string name;
    const Brdf* brdf;
    ParameterValues values;
};

/// Every model by its defaults, as imitations of glTF surfaces, and turned and stretched where it can be.
std::vector<Case> cases() {
    std::vector<Case> cases;
    for (const Brdf& brdf : allBrdfs()) {
        if (!brdf.traits.scattersLight) continue;
        for (const double roughness : {0.1, 0.4, 1.0})
            for (const double metallic : {0.0, 1.0})
                cases.push_back({brdf.name + " roughness " + std::to_string(roughness) + " metallic " +
                                     std::to_string(metallic),
                                 &brdf, brdf.fromMetallicRoughness({{0.9, 0.6, 0.3}, metallic, roughness})});
        if (brdf.tableParameter() < 0) cases.push_back({brdf.name + " default", &brdf, brdf.defaults()});
        if (!brdf.presets.empty())
            cases.push_back({brdf.name + " preset", &brdf, brdf.presets.front().values});
        for (const auto& [x, y, first, second] :
             {std::tuple("alphaX", "alphaY", 0.1, 0.4), std::tuple("nu", "nv", 20.0, 300.0)}) {
            if (brdf.parameterIndex(x) < 0) continue;
            Case turned{brdf.name + " anisotropic", &brdf, brdf.defaults()};
            const auto set = [&](const char* name, double value) {
                turned.values[static_cast<size_t>(brdf.valueOffset(brdf.parameterIndex(name)))] = value;
            };
            set(x, first);
            set(y, second);
            set("rotation", 0.7);
            cases.push_back(std::move(turned));
        }
    }
    return cases;
}

const std::vector<double> kAngles{0.0, 45.0, 80.0, 89.0, 89.9};

glm::dvec3 eyeAt(double degrees, double azimuth) {
    const double low = glm::radians(90.0 - degrees);
    return {std::cos(low) * std::cos(azimuth), std::cos(low) * std::sin(azimuth), std::sin(low)};
}

/// Cells about the mirrored direction, between it and the horizon.
class Cells {
public:
    Cells(const glm::dvec3& wo, double sharpness)
        : axis_(-wo.x, -wo.y, wo.z),
          frame_(frameAbout(axis_)),
          breaks_(gradedBreaks(0.1 * wo.z / (1.0 + sharpness), 1.0, kPolar)) {}

    static constexpr int kPolar = 20, kAzimuth = 16;
    static constexpr size_t kBelow = kPolar * kAzimuth;

    size_t of(const glm::dvec3& w) const {
        if (w.z <= 0.0) return kBelow;
        const glm::dvec3 local = glm::transpose(frame_) * w;
        double azimuth = std::atan2(local.y, local.x);
        if (azimuth < 0.0) azimuth += 2.0 * kPi;
        const double fraction = std::atan2(std::hypot(local.x, local.y), local.z) / horizon(azimuth);
        const auto polar =
            std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, fraction) - breaks_.begin() - 1;
        return static_cast<size_t>(polar * kAzimuth +
                                   std::min(static_cast<int>(azimuth / kStep), kAzimuth - 1));
    }

    struct Integral {
        double value = 0.0, error = 0.0;
    };
    /// Of f over each cell, by halving both ways where two estimates differ.
    std::vector<Integral> integrals(const std::function<double(const glm::dvec3&)>& f) const {
        std::vector<Integral> result(kBelow);
        for (int p = 0; p < kPolar; ++p)
            for (int a = 0; a < kAzimuth; ++a) {
                const auto i = static_cast<size_t>(p);
                const Patch patch{breaks_[i], breaks_[i + 1], a * kStep, (a + 1.0) * kStep};
                refine(f, patch, estimate(f, patch), 8, result[static_cast<size_t>(p * kAzimuth + a)]);
            }
        return result;
    }

private:
    struct Patch {
        double fraction0, fraction1, azimuth0, azimuth1;
    };
    double estimate(const std::function<double(const glm::dvec3&)>& f, const Patch& patch) const {
        static const QuadratureRule kRule = gaussLegendre(6);
        const double azimuths[]{patch.azimuth0, patch.azimuth1};
        const double fractions[]{patch.fraction0, patch.fraction1};
        return integratePanels(
            [&](double azimuth) {
                const double edge = horizon(azimuth);
                return edge * integratePanels(
                                  [&](double fraction) {
                                      const double polar = edge * fraction;
                                      return std::sin(polar) * f(frame_ * fromPolar(polar, azimuth));
                                  },
                                  fractions, kRule);
            },
            azimuths, kRule);
    }
    void refine(const std::function<double(const glm::dvec3&)>& f, const Patch& patch, double whole,
                int halvings, Integral& sum) const {
        const double fraction = 0.5 * (patch.fraction0 + patch.fraction1);
        const double azimuth = 0.5 * (patch.azimuth0 + patch.azimuth1);
        const Patch quarters[]{{patch.fraction0, fraction, patch.azimuth0, azimuth},
                               {fraction, patch.fraction1, patch.azimuth0, azimuth},
                               {patch.fraction0, fraction, azimuth, patch.azimuth1},
                               {fraction, patch.fraction1, azimuth, patch.azimuth1}};
        double estimates[4], total = 0.0;
        for (int i = 0; i < 4; ++i)
            total += estimates[i] = estimate(f, quarters[i]);
        if (std::abs(total - whole) < 1e-7 || halvings == 0) {
            sum.value += total;
            sum.error += std::abs(total - whole);
            return;
        }
        for (int i = 0; i < 4; ++i)
            refine(f, quarters[i], estimates[i], halvings - 1, sum);
    }

    static constexpr double kStep = 2.0 * 3.14159265358979323846 / kAzimuth;
    double horizon(double azimuth) const {
        return std::atan2(axis_.z, -(frame_ * fromPolar(glm::half_pi<double>(), azimuth)).z);
    }
    glm::dvec3 axis_;
    glm::dmat3 frame_;
    std::vector<double> breaks_;
};

struct Agreement {
    double chi2 = 0.0, limit = 0.0;
    double offset = 0.0;  ///< what the quadrature's error adds to chi2, in the mean
};

/// Draws of one mixture against the density of another, at this significance; cells that expect fewer than
/// ten draws count as one.
Agreement agreement(const SamplingMixture& drawn, const SamplingMixture& described, const Cells& cells,
                    double significance) {
    const auto density = [&](const glm::dvec3& w) { return samplingDensity(described, w); };
    std::vector<Cells::Integral> expected = cells.integrals(density);
    Agreement result;
    Cells::Integral below{1.0, 0.0};
    for (const Cells::Integral& cell : expected) {
        below.value -= cell.value;
        below.error += cell.error;
    }
    expected.push_back(below);
    std::vector<double> counts(expected.size());
    Pcg32 random(20);
    for (int i = 0; i < kDraws; ++i) {
        const double u0 = random.uniform(), u1 = random.uniform(), u2 = random.uniform();
        counts[cells.of(sampleDirection(drawn, u0, u1, u2))] += 1.0;
    }
    double restExpected = 0.0, rest = 0.0;
    int used = 0;
    const auto compare = [&](double count, double mean) {
        result.chi2 += (count - mean) * (count - mean) / mean;
        ++used;
    };
    for (size_t i = 0; i < expected.size(); ++i) {
        const double mean = expected[i].value * kDraws;
        if (mean >= 10.0) {
            compare(counts[i], mean);
            result.offset += kDraws * expected[i].error * expected[i].error / expected[i].value;
        } else {
            restExpected += mean;
            rest += counts[i];
        }
    }
    if (restExpected >= 10.0) compare(rest, restExpected);
    result.limit = quantile(complement(boost::math::chi_squared(std::max(used - 1, 1)), significance));
    return result;
}

TEST(Sampling, DrawsFollowTheDensity) {
    const std::vector<Case> all = cases();
    const double significance = kSignificance / static_cast<double>(all.size() * kAngles.size());
    for (const Case& c : all) {
        const BrdfSampler sampler(*c.brdf, c.values);
        for (const double angle : kAngles) {
            SCOPED_TRACE(c.name + " at " + std::to_string(angle));
            const glm::dvec3 wo = eyeAt(angle, 0.6);
            const SamplingMixture mixture = sampler.at(wo);
            const Agreement result =
                agreement(mixture, mixture, {wo, c.brdf->lobeSharpness(c.values)}, significance);
            EXPECT_LT(result.offset, 1.0);
            EXPECT_LT(result.chi2, result.limit);
        }
    }
}

SamplingMixture mixtureOf(const SamplingLobe& lobe, const glm::dvec3& wo) {
    SamplingLobes lobes;
    lobes.add(lobe);
    return {lobes, wo};
}

/// The test above finds a width that is a tenth off, and an exponent a fifth, in each shape.
TEST(Sampling, AWrongDensityIsFound) {
    const glm::dvec3 wo = eyeAt(45.0, 0.6);
    const glm::dvec3 mirrored(-wo.x, -wo.y, wo.z);
    for (const SamplingLobe& lobe : {SamplingLobe{LobeShape::ggxVisibleNormals, 1.0, 0.3, 0.2},
                                     SamplingLobe{LobeShape::gaussianSlopes, 1.0, 0.3, 0.2},
                                     SamplingLobe{LobeShape::powerNormals, 1.0, 20.0, 50.0},
                                     SamplingLobe{LobeShape::power, 1.0, 20.0, 0.0, 0.0, mirrored}}) {
        SamplingLobe wrong = lobe;
        wrong.x *= lobe.x > 1.0 ? 1.2 : 1.1;
        const Cells cells(wo, 6.0);
        const Agreement good =
            agreement(mixtureOf(lobe, wo), mixtureOf(lobe, wo), cells, kSignificance / 8.0);
        EXPECT_LT(good.chi2, good.limit) << int(lobe.shape);
        const Agreement bad =
            agreement(mixtureOf(lobe, wo), mixtureOf(wrong, wo), cells, kSignificance / 8.0);
        EXPECT_GT(bad.chi2, bad.limit) << int(lobe.shape);
    }
}

/// Over both hemispheres.
TEST(Sampling, DensitiesIntegrateToOne) {
    for (const Case& c : cases()) {
        const BrdfSampler sampler(*c.brdf, c.values);
        for (const double angle : {0.0, 45.0, 80.0}) {
            const glm::dvec3 wo = eyeAt(angle, 0.6);
            const SamplingMixture mixture = sampler.at(wo);
            const Cells cells(wo, c.brdf->lobeSharpness(c.values));
            double sum = 0.0, error = 1e-9;
            for (const double side : {1.0, -1.0})
                for (const Cells::Integral& cell : cells.integrals([&](const glm::dvec3& w) {
                         return samplingDensity(mixture, {w.x, w.y, side * w.z});
                     })) {
                    sum += cell.value;
                    error += cell.error;
                }
            EXPECT_NEAR(sum, 1.0, error) << c.name << " at " << angle;
            EXPECT_LT(error, 1e-4) << c.name << " at " << angle;
        }
    }
}

TEST(Sampling, EstimatesTheAlbedo) {
    const std::vector<Case> all = cases();
    const std::vector<double> angles{45.0, 80.0};
    const double deviations = quantile(complement(
        boost::math::normal(), kSignificance / 2.0 / static_cast<double>(all.size() * angles.size())));
    for (const Case& c : all) {
        const BrdfSampler sampler(*c.brdf, c.values);
        for (const double angle : angles) {
            const glm::dvec3 wo = eyeAt(angle, 0.0);
            const SamplingMixture mixture = sampler.at(wo);
            Pcg32 random(7);
            double sum = 0.0, squares = 0.0;
            for (int i = 0; i < kDraws; ++i) {
                const double u0 = random.uniform(), u1 = random.uniform(), u2 = random.uniform();
                const glm::dvec3 wi = sampleDirection(mixture, u0, u1, u2);
                const double value =
                    wi.z > 0.0 ? c.brdf->fCos({wi, wo}, c.values).r / samplingDensity(mixture, wi) : 0.0;
                sum += value;
                squares += value * value;
            }
            const double mean = sum / kDraws;
            const double variance = std::max(squares / kDraws - mean * mean, 0.0);
            const harness::Albedo truth = test::albedo(*c.brdf, c.values, wo.z);
            EXPECT_NEAR(mean, truth.value, deviations * std::sqrt(variance / kDraws) + truth.error + 1e-12)
                << c.name << " at " << angle;
        }
    }
}

/// The ends of every range, and eyes that graze to 1e-7.
TEST(Sampling, FiniteAtTheEndsOfRanges) {
    Pcg32 random(3);
    const std::vector<double> numbers{0.0, 0x1p-53, 0.25, 0.5, 1.0 - 0x1p-53};
    for (const LobeShape shape : {LobeShape::cosine, LobeShape::ggxVisibleNormals, LobeShape::gaussianSlopes,
                                  LobeShape::powerNormals, LobeShape::power})
        for (const double z : {1.0, 0.3, 1e-3, 1e-7})
            for (int i = 0; i < 400; ++i) {
                const bool exponents = shape == LobeShape::powerNormals || shape == LobeShape::power;
                const auto parameter = [&] {
                    if (exponents) return i % 7 == 0 ? 0.0 : random.logUniform(1e-3, 1e6);
                    return random.logUniform(1e-5, 10.0);
                };
                const glm::dvec3 wo(std::sqrt((1.0 - z) * (1.0 + z)), 0.0, z);
                const double x = parameter(), y = parameter();
                const SamplingMixture mixture =
                    mixtureOf({shape, 1.0, x, y, random.uniform(-7.0, 7.0), {-wo.x, -wo.y, wo.z}}, wo);
                for (const double u1 : numbers)
                    for (const double u2 : numbers) {
                        const glm::dvec3 wi = sampleDirection(mixture, 0.9, u1, u2);
                        ASSERT_NEAR(glm::length(wi), 1.0, 1e-12);
                        const double density = samplingDensity(mixture, wi);
                        ASSERT_TRUE(std::isfinite(density) && density >= 0.0)
                            << int(shape) << " x " << x << " y " << y << " z " << z << " u " << u1 << " "
                            << u2 << " density " << density;
                    }
            }
}

TEST(Sampling, MirrorsHaveNothingToDraw) {
    const Brdf& mirror = requireBrdf("mirror");
    const SamplingMixture mixture = BrdfSampler(mirror, mirror.defaults()).at({0.0, 0.0, 1.0});
    EXPECT_TRUE(mixture.empty());
    EXPECT_EQ(samplingDensity(mixture, {0.0, 0.0, 1.0}), 0.0);
}

TEST(Sampling, TheHeaviestLobesAreKept) {
    SamplingLobes lobes;
    for (size_t i = 0; i < 2 * SamplingLobes::kMost; ++i)
        lobes.add({LobeShape::cosine, static_cast<double>(i)});
    ASSERT_EQ(lobes.all().size(), SamplingLobes::kMost);
    for (const SamplingLobe& lobe : lobes.all())
        EXPECT_GE(lobe.weight, static_cast<double>(SamplingLobes::kMost));
}

}  // namespace
}  // namespace lobe
