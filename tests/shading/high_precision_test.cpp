/// The double twins against 50 digits: they must be right to far better than the floats that they judge.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <tuple>

#include "harness/brdf_table.hpp"
#include "harness/comparison.hpp"
#include "high_precision.hpp"
#include "math/random.hpp"

namespace lobe {
namespace {

using harness::BrdfRow;

constexpr double kRounding = 0x1p-53;

/// Small enough for differences in doubles to follow lobes that floats do not resolve.
constexpr double kConditionStep = 1e-9;

/// Makes the range of these parameters so small that they are fixed.
void pin(Brdf& brdf, const std::vector<std::pair<std::string, double>>& fixed) {
    for (const auto& [parameterName, value] : fixed) {
        Parameter& parameter = brdf.parameters.at(static_cast<size_t>(brdf.parameterIndex(parameterName)));
        parameter.usual.reset();
        parameter.minimum = value;
        parameter.maximum = value == 0.0 ? 1e-300 : value + 1e-12 * std::abs(value);
    }
}

/// He's model on surfaces and wavelengths that there are, whose series 50 digits can sum term by term.
Brdf usualHe() {
    Brdf brdf = requireBrdf("he");
    for (const char* name : {"sigma", "tau", "wavelength"}) {
        Parameter& parameter = brdf.parameters.at(static_cast<size_t>(brdf.parameterIndex(name)));
        std::tie(parameter.minimum, parameter.maximum) = *parameter.usual;
    }
    return brdf;
}

struct Worst {
    double units = 0.0;
    std::string where;
    size_t compared = 0;
};

/// Error in units of 2^-53 (4 t + c), c the condition number, t the terms' size over their sum.
void compare(const Brdf& brdf, const std::vector<BrdfRow>& rows, Worst& worst) {
    const test::PreciseFCos& precise = test::preciseModels().at(brdf.name);
    const Brdf& whole = requireBrdf(brdf.name);  // with the full ranges
    for (const BrdfRow& row : rows) {
        const Directions d = harness::directionsOf(row);
        if (d.wi.z <= 0.0 || d.wo.z <= 0.0) continue;
        const ParameterValues values = harness::valuesOf(brdf, row);
        const glm::dvec3 twin = brdf.fCos(d, values);
        const glm::dvec3 exact = precise(d, values);
        const harness::Condition condition = harness::conditionOf(whole, d, values, kConditionStep);
        const glm::dvec3 unit = kRounding * (4.0 * condition.terms + condition.componentwise +
                                             condition.length + condition.parameters);
        for (int c = 0; c < 3; ++c) {
            // Fresnel's factor of a black surface is 0 for L = V; 50 digits leave 1e-250 of it.
            if (exact[c] < 1e-70) {
                EXPECT_LT(twin[c], 1e-60) << brdf.name << " " << describe(row);
                continue;
            }
            ++worst.compared;
            const double units = std::abs(twin[c] - exact[c]) / exact[c] / unit[c];
            if (!(units <= worst.units)) {
                char text[200];
                std::snprintf(text, sizeof text, " channel %d: %.17g; in 50 digits %.17g, %.1f units of %.2e",
                              c, twin[c], exact[c], units, unit[c]);
                worst.units = units;
                worst.where = describe(row) + text;
            }
        }
    }
}

class HighPrecision : public testing::TestWithParam<std::string> {};

TEST_P(HighPrecision, TwinIsRightToDoubleRounding) {
    const Brdf brdf = GetParam() == "he" ? usualHe() : requireBrdf(GetParam());
    Worst worst;
    compare(brdf, harness::brdfRows(brdf, GetParam() == "he" ? 40 : 250, 91), worst);
    std::printf("%s: %zu values, worst %.1f units of 2^-53 (4 + c)\n", brdf.name.c_str(), worst.compared,
                worst.units);
    EXPECT_LT(worst.units, 16.0) << worst.where;
}

INSTANTIATE_TEST_SUITE_P(, HighPrecision,
                         testing::Values("phong", "blinn_phong", "cook_torrance", "beckmann_smith", "ggx",
                                         "metallic_roughness", "ward", "ward_anisotropic",
                                         "ashikhmin_shirley", "lafortune", "oren_nayar", "he"),
                         [](const testing::TestParamInfo<std::string>& model) { return model.param; });

struct Hard {
    const char* name;
    const char* model;
    std::vector<std::pair<std::string, double>> fixed;
};

const std::vector<Hard>& hardCases() {
    static const std::vector<Hard> cases{
        {"narrow Beckmann", "cook_torrance", {{"m", 1e-5}}},
        {"wide Beckmann", "cook_torrance", {{"m", 10.0}}},
        {"narrow Beckmann with Smith", "beckmann_smith", {{"m", 1e-5}}},
        {"wide Beckmann with Smith", "beckmann_smith", {{"m", 10.0}}},
        {"narrow GGX", "ggx", {{"alphaX", 1e-4}, {"alphaY", 1e-4}}},
        {"anisotropic GGX", "ggx", {{"alphaX", 1e-3}, {"alphaY", 1.0}}},
        {"index near 1", "cook_torrance", {{"fresnel", 1.0}, {"eta", 1.0001}}},
        {"metal with small eta", "cook_torrance", {{"fresnel", 2.0}, {"eta", 0.01}, {"k", 10.0}}},
        {"black Schlick", "cook_torrance", {{"fresnel", 0.0}, {"f0", 0.0}}},
        {"sharp Phong", "phong", {{"shininess", 1e6}}},
        {"sharp Blinn-Phong", "blinn_phong", {{"shininess", 1e6}}},
        {"flat Phong", "phong", {{"shininess", 0.0}}},
        {"narrow Ward", "ward", {{"alpha", 1e-5}}},
        {"anisotropic Ward", "ward_anisotropic", {{"alphaX", 1e-3}, {"alphaY", 1.0}}},
        {"unturned anisotropic Ward",
         "ward_anisotropic",
         {{"alphaX", 1.0}, {"alphaY", 1e-3}, {"rotation", 0.0}}},
        {"sharp Ashikhmin-Shirley", "ashikhmin_shirley", {{"nu", 1e6}, {"nv", 1e6}}},
        {"anisotropic Ashikhmin-Shirley", "ashikhmin_shirley", {{"nu", 1.0}, {"nv", 1e6}}},
        {"rough Oren-Nayar", "oren_nayar", {{"sigma", 1.5}, {"form", 0.0}}},
    };
    return cases;
}

TEST(HighPrecisionHard, TwinsAreRightAtTheEndsOfRanges) {
    for (const Hard& hard : hardCases()) {
        Brdf brdf = requireBrdf(hard.model);
        pin(brdf, hard.fixed);
        Worst worst;
        compare(brdf, harness::brdfRows(brdf, 60, 92), worst);
        std::printf("%s: %zu values, worst %.1f units of 2^-53 (4 + c)\n", hard.name, worst.compared,
                    worst.units);
        EXPECT_LT(worst.units, 16.0) << hard.name << ": " << worst.where;
    }
}

/// He's series from one term to hundreds of thousands, sigma in micrometres.
TEST(HighPrecisionHard, HesSeries) {
    for (const double sigma : {1e-4, 0.03, 0.2, 1.0, 10.0, 60.0})
        for (const double slope : {0.01, 0.2, 2.0}) {
            Brdf brdf = usualHe();
            pin(brdf, {{"sigma", sigma * 1e-6}, {"tau", 2.0 * sigma * 1e-6 / slope}});
            Worst worst;
            compare(brdf, harness::brdfRows(brdf, sigma > 5.0 ? 2 : 8, 93), worst);
            std::printf("He, sigma %g um, slope %g: worst %.1f units of 2^-53 (4 + c)\n", sigma, slope,
                        worst.units);
            EXPECT_LT(worst.units, 16.0) << worst.where;
        }
}

/// Relative change of f per relative change of `value`, by differences.
glm::dvec3 sensitivity(const std::function<glm::dvec3()>& f, double& value) {
    const glm::dvec3 centre = f();
    const double kept = value;
    value = kept * (1.0 - kConditionStep);
    const glm::dvec3 change = glm::abs(f() - centre) / kConditionStep;
    value = kept;
    return {change.r / centre.r, change.g / centre.g, change.b / centre.b};
}

/// What no light without extent shows, at angles down to 1e-7 rad from the horizon.
TEST(HighPrecisionHard, MirrorReflectances) {
    Pcg32 random(94);
    double worst = 0.0;
    for (const char* name : {"mirror", "he"}) {
        const Brdf brdf = name == std::string("he") ? usualHe() : requireBrdf(name);
        for (const BrdfRow& row : harness::brdfRows(brdf, 30, 95)) {
            ParameterValues values(row.values.begin(), row.values.end());
            double cosine = random.below(2) == 0 ? random.uniform() : random.logUniform(1e-7, 1.0);
            const auto twin = [&] { return brdf.mirror(cosine, values); };
            const glm::dvec3 got = twin();
            const glm::dvec3 exact = name == std::string("he") ? test::preciseHeMirror(cosine, values)
                                                               : test::preciseFresnel(values, cosine);
            glm::dvec3 condition = sensitivity(twin, cosine);
            for (double& value : values)
                condition += sensitivity(twin, value);
            for (int c = 0; c < 3; ++c) {
                if (exact[c] < 1e-250) continue;
                const double units =
                    std::abs(got[c] - exact[c]) / exact[c] / (kRounding * (4.0 + condition[c]));
                EXPECT_LT(units, 16.0) << name << " cosine " << cosine << " " << describe(row);
                worst = std::max(worst, units);
            }
        }
    }
    std::printf("mirrored light: worst %.1f units of 2^-53 (4 + c)\n", worst);
}

}  // namespace
}  // namespace lobe
