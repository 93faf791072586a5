/// What the models claim of themselves: reciprocity, energy, continuity, sharpness. On the twins, in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <optional>
#include <sstream>

#include "albedo.hpp"
#include "harness/brdf_table.hpp"
#include "math/sphere.hpp"
#include "shading/brdf.hpp"

namespace lobe {
namespace {

using test::Albedo;
using test::albedo;

const double kPi = glm::pi<double>();

/// Every combination of minimum, middle and maximum, scalars by powers of ten where the range is wide.
std::vector<ParameterValues> parameterGrid(const Brdf& brdf) {
    std::vector<ParameterValues> grid{{}};
    for (const Parameter& parameter : brdf.parameters) {
        std::vector<double> steps{parameter.minimum, 0.5 * (parameter.minimum + parameter.maximum),
                                  parameter.maximum};
        if (parameter.kind == ParameterKind::table) {
            steps = {0.0};
        } else if (parameter.minimum < 0.0) {
            steps = {0.0, 0.8};  // turns the lobe
        } else if (parameter.kind == ParameterKind::choice) {
            steps.clear();
            for (size_t i = 0; i < parameter.choices.size(); ++i)
                steps.push_back(static_cast<double>(i));
        } else if (parameter.usual) {
            steps = {parameter.usual->first, parameter.usual->second};
        } else if (parameter.maximum - parameter.minimum > 100.0) {
            steps = {parameter.minimum, 1.0, 10.0, 1000.0};
        } else if (parameter.kind == ParameterKind::scalar) {
            steps = {parameter.minimum, 0.3, 0.6, parameter.maximum};
        }
        std::vector<ParameterValues> longer;
        for (const ParameterValues& values : grid)
            for (double step : steps) {
                longer.push_back(values);
                longer.back().insert(longer.back().end(), static_cast<size_t>(parameter.components()), step);
            }
        grid = std::move(longer);
    }
    if (brdf.table) {
        std::vector<ParameterValues> longer;
        for (const ParameterValues& values : grid)
            for (const auto& [name, rows] : brdf.table->examples()) {
                longer.push_back(values);
                longer.back().insert(longer.back().end(), rows.begin(), rows.end());
            }
        grid = std::move(longer);
    }
    std::reverse(grid.begin(), grid.end());  // the brightest first: where albedo exceeds 1, it does so here
    return grid;
}

/// A combination whose albedo exceeds `bound` for certain, if there is one.
std::optional<std::string> albedoAbove(const Brdf& brdf, double bound) {
    for (const ParameterValues& values : parameterGrid(brdf))
        for (double cosine : {0.05, 0.5, 1.0}) {
            const Albedo a = albedo(brdf, values, cosine);
            if (a.value - a.error <= bound) continue;
            std::ostringstream text;
            text << "albedo " << a.value << " at cosine " << cosine << ", values";
            for (double value : values)
                text << " " << value;
            return text.str();
        }
    return std::nullopt;
}

/// Largest relative difference of f_r(L, V) and f_r(V, L).
double worstAsymmetry(const Brdf& brdf) {
    double worst = 0.0;
    for (const harness::BrdfRow& row : harness::brdfRows(brdf, 500, 7)) {
        const Directions d = harness::directionsOf(row);
        const ParameterValues values = harness::valuesOf(brdf, row);
        const double there = brdf.fCos(d, values).r / d.wi.z;
        const double back = brdf.fCos({d.wo, d.wi}, values).r / d.wo.z;
        if (there + back > 1e-290) worst = std::max(worst, std::abs(there - back) / (there + back));
    }
    return worst;
}

TEST(Properties, ReciprocalExactlyWhereClaimed) {
    for (const Brdf& brdf : allBrdfs()) {
        const double asymmetry = worstAsymmetry(brdf);
        if (brdf.traits.reciprocal)
            // Lobes of sharpness 2e4 amplify 1e-16, and a black metal's F = (1 - v.h)^5 the rounding of 1 -
            // v.h.
            EXPECT_LT(asymmetry, 1e-6) << brdf.name;
        else
            EXPECT_GT(asymmetry, 0.1) << brdf.name << " disclaims reciprocity but has it";
    }
}

TEST(Properties, AlbedoAtMostOneExactlyWhereClaimed) {
    for (const Brdf& brdf : allBrdfs()) {
        if (brdf.traits.energyConserving) {
            const auto gain = albedoAbove(brdf, 1.0 + 1e-9);
            EXPECT_FALSE(gain) << brdf.name << ": " << *gain;
        } else {
            EXPECT_TRUE(albedoAbove(brdf, 1.01)) << brdf.name << " disclaims conservation but has it";
        }
    }
}

/// The spike and the directional-diffuse part of He's model with a perfect reflector.
TEST(He, KnownGainOfEnergy) {
    const Brdf& brdf = requireBrdf("he");
    const double wavelength = 5e-7;
    const auto reflected = [&](double sigma, double slope, double cosine) {
        ParameterValues values{0, 0, 0, sigma * wavelength, 2.0 * sigma * wavelength / slope};
        values.insert(values.end(), {wavelength, wavelength, wavelength, 0, 1, 1, 1, 1.5, 1.5, 1.5, 0, 0, 0});
        return albedo(brdf, values, cosine).value + brdf.mirror(cosine, values).r;
    };
    EXPECT_NEAR(reflected(0.1, 0.2, 0.3), 1.042, 1e-3);
    for (double sigma : {0.02, 0.1, 0.5, 2.0}) {
        EXPECT_LE(reflected(sigma, 0.2, 1.0), 1.0003);
        for (double cosine : {0.5, 0.2, 0.1})
            EXPECT_LE(reflected(sigma, 0.2, cosine), 1.043);
    }
}

TEST(Lafortune, BrushedMetalGainsEnergy) {
    const Brdf& brdf = requireBrdf("lafortune");
    EXPECT_NEAR(albedo(brdf, brdf.findPreset("brushedmetal")->values, 0.1, 2).value, 1.56, 0.01);
}

ParameterValues phongLobe(double n, double diffuse, double specular, bool energy) {
    return {0, 0, 0, diffuse, diffuse, diffuse, specular, specular, specular, n, energy ? 1.0 : 0.0};
}

TEST(Phong, EnergyFormIsReciprocalAndConserving) {
    for (const char* name : {"phong", "blinn_phong"}) {
        const Brdf& brdf = requireBrdf(name);
        for (double n : {0.0, 0.3, 1.0, 10.0, 100.0, 3000.0}) {
            SCOPED_TRACE(std::string(name) + ", n = " + std::to_string(n));
            const Albedo normal = albedo(brdf, phongLobe(n, 0.0, 1.0, true), 1.0);
            EXPECT_NEAR(normal.value, 1.0, 1e-7 + normal.error);
            for (double cosine : {0.9, 0.5, 0.2, 0.03})
                for (double diffuse : {0.0, 0.4}) {
                    const Albedo a = albedo(brdf, phongLobe(n, diffuse, 1.0 - diffuse, true), cosine);
                    EXPECT_LE(a.value, 1.0 + 1e-9 + a.error);
                }
        }
        for (const harness::BrdfRow& row : harness::brdfRows(brdf, 200, 8)) {
            const Directions d = harness::directionsOf(row);
            ParameterValues values = harness::valuesOf(brdf, row);
            values[10] = 1.0;
            const double there = brdf.fCos(d, values).r / d.wi.z;
            const double back = brdf.fCos({d.wo, d.wi}, values).r / d.wo.z;
            EXPECT_NEAR(there, back, 1e-9 * (there + back) + 1e-300);  // denormals have no digits
        }
    }
}

TEST(Phong, KnownAlbedo) {
    // 0.5005 at cosine 0.5 for exponent 20: docs/models/phong.md.
    EXPECT_NEAR(albedo(requireBrdf("phong"), phongLobe(20.0, 0.0, 1.0, true), 0.5).value, 0.5005, 1e-4);
}

/// E_perp (k_d N.L + k_s (R.V)^n) and with N.H, as the classic form is written, computed from angles.
TEST(Phong, ClassicFormIsTheTextbooks) {
    const double light = 0.5, eye = 0.7;  // polar angles in one plane, on opposite sides
    const Directions d(fromPolar(light, 0.0), fromPolar(eye, kPi));
    const double n = 40.0;
    const double diffuse = 0.3 * std::cos(light);
    EXPECT_NEAR(requireBrdf("phong").fCos(d, phongLobe(n, 0.3, 0.6, false)).r,
                diffuse + 0.6 * std::pow(std::cos(eye - light), n), 1e-14);
    EXPECT_NEAR(requireBrdf("blinn_phong").fCos(d, phongLobe(n, 0.3, 0.6, false)).r,
                diffuse + 0.6 * std::pow(std::cos((eye - light) / 2.0), n), 1e-14);
}

TEST(MetallicRoughness, SingleScatteringAlbedo) {
    const Brdf& brdf = requireBrdf("metallic_roughness");
    const auto white = [&](double alpha, double cosine) {
        return albedo(brdf, {1, 1, 1, 1, std::sqrt(alpha)}, cosine);
    };
    // F = 1, alpha = 1, normal incidence has the closed form 1 - ln 2.
    EXPECT_NEAR(white(1.0, 1.0).value, 1.0 - std::log(2.0), 1e-6);
    EXPECT_NEAR(white(0.2, 1.0).value, 0.9477, 1e-4);
    EXPECT_NEAR(white(0.2, 0.5).value, 0.8952, 1e-4);
    EXPECT_NEAR(white(0.2, 0.1).value, 0.8913, 1e-4);
}

/// A metal's lobe alone conserves energy; it is the diffuse base below a dielectric's coat, weighted by 1 -
/// F(v.h) only, that makes glTF's sum exceed 1 at grazing angles.
TEST(MetallicRoughness, OnlyTheDielectricsSumGainsEnergy) {
    const Brdf& brdf = requireBrdf("metallic_roughness");
    for (double roughness : {0.0, 0.1, 0.3, 0.6, 1.0})
        for (double cosine : {1.0, 0.5, 0.1, 0.02}) {
            const Albedo a = albedo(brdf, {1, 1, 1, 1, roughness}, cosine);
            EXPECT_LE(a.value, 1.0 + 1e-6 + a.error) << "roughness " << roughness << ", cosine " << cosine;
        }
    EXPECT_GT(albedo(brdf, {1, 1, 1, 0, 0.1}, 0.05).value, 1.1);
}

TEST(MetallicRoughness, IsContinuousWhereRoughnessIsKeptAboveTheSmallest) {
    const Brdf& brdf = requireBrdf("metallic_roughness");
    const Directions d(fromPolar(0.4, 0.0), fromPolar(0.4 + 1e-4, kPi));
    const auto at = [&](double roughness) { return brdf.fCos(d, ParameterValues{1, 1, 1, 1, roughness}).r; };
    const double threshold = 0.01;
    EXPECT_EQ(at(0.0), at(threshold));
    EXPECT_EQ(at(0.0099), at(threshold));
    EXPECT_NE(at(0.0101), at(threshold));
    for (double step : {1e-3, 1e-6, 1e-9})
        EXPECT_NEAR(at(threshold * (1.0 + step)) / at(threshold), 1.0, 10.0 * step);
}

/// The largest |d ln f / d theta_h| over the lobe of a metal, whose Fresnel factor is 1.
TEST(MetallicRoughness, SharpnessIsTheSteepestSlopeOfTheLobe) {
    const Brdf& brdf = requireBrdf("metallic_roughness");
    for (double roughness : {0.0, 0.05, 0.2, 0.4}) {
        const ParameterValues values{1, 1, 1, 1, roughness};
        const double alpha = std::max(roughness * roughness, 1e-4);
        double steepest = 0.0;
        for (double x = 0.05; x < 3.0; x += 0.01) {
            const auto logF = [&](double tilt) {
                const glm::dvec3 h = fromPolar(tilt, 0.3);
                const glm::dvec3 w = h;  // L = V = H: only the half vector turns
                return std::log(brdf.fCos({w, w}, values).r / w.z);
            };
            const double theta = std::atan(x * alpha);
            const double step = 1e-4 * alpha;
            steepest = std::max(steepest, std::abs(logF(theta + step) - logF(theta - step)) / (2.0 * step));
        }
        // 2 / alpha is the slope of D against tan theta; against theta it is a little less for wide lobes.
        EXPECT_LE(steepest / brdf.lobeSharpness(values), 1.001) << roughness;
        EXPECT_GE(steepest / brdf.lobeSharpness(values), 0.9) << roughness;
    }
}

TEST(LobeSharpness, VanishesWithTheLobe) {
    EXPECT_EQ(requireBrdf("lambert").lobeSharpness(ParameterValues{1, 1, 1}), 0.0);
    EXPECT_EQ(requireBrdf("phong").lobeSharpness(phongLobe(100.0, 1.0, 0.0, false)), 0.0);
    EXPECT_EQ(requireBrdf("phong").lobeSharpness(phongLobe(100.0, 1.0, 0.1, false)), 20.0);
    EXPECT_EQ(requireBrdf("blinn_phong").lobeSharpness(phongLobe(100.0, 1.0, 0.1, false)), 10.0);
}

}  // namespace
}  // namespace lobe
