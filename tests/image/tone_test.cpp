#include "image/tone.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <random>

namespace lobe {
namespace {

using Rgb = std::array<float, 3>;

constexpr std::array kCurves = {ToneMapping::none, ToneMapping::reinhard, ToneMapping::aces, ToneMapping::agx,
                                ToneMapping::neutral};

Rgb mapped(ToneMapping curve, Rgb rgb) {
    toneMap(curve, rgb.data());
    return rgb;
}

glm::dmat3 rows(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    return glm::transpose(glm::dmat3(a, b, c));
}

/// The curves in double precision, in the form of their publications.
glm::dvec3 reference(ToneMapping curve, glm::dvec3 c) {
    c = glm::max(c, 0.0);
    switch (curve) {
        case ToneMapping::none:
            break;
        case ToneMapping::reinhard:
            c /= 1.0 + glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722));
            break;
        case ToneMapping::aces: {
            c = rows({.59719, .35458, .04823}, {.07600, .90834, .01566}, {.02840, .13383, .83777}) * c;
            c = (c * (c + .0245786) - .000090537) / (c * (.983729 * c + .4329510) + .238081);
            c = rows({1.60475, -.53108, -.07367}, {-.10208, 1.10813, -.00605}, {-.00327, -.07276, 1.07602}) *
                c;
            break;
        }
        case ToneMapping::agx: {
            const auto to709 =
                rows({1.6605, -.5876, -.0728}, {-.1246, 1.1329, -.0083}, {-.0182, -.1006, 1.1187});
            c = glm::inverse(to709) * c;
            c = rows({.856627, .095121, .048252}, {.137319, .761242, .101439}, {.111898, .076799, .811302}) *
                c;
            for (int i = 0; i < 3; ++i) {
                const double x = std::clamp(
                    (std::log2(std::max(c[i], 1e-10)) + 12.47393) / (4.026069 + 12.47393), 0.0, 1.0);
                c[i] = 15.5 * std::pow(x, 6) - 40.14 * std::pow(x, 5) + 31.96 * std::pow(x, 4) -
                       6.868 * std::pow(x, 3) + .4298 * x * x + .1191 * x - .00232;
            }
            c = glm::inverse(rows({.899797, .087200, .013003}, {.111421, .875576, .013003},
                                  {.111421, .087200, .801379})) *
                c;
            for (int i = 0; i < 3; ++i)
                c[i] = std::pow(std::max(c[i], 0.0), 2.2);
            c = to709 * c;
            break;
        }
        case ToneMapping::neutral: {
            const double x = std::min({c.r, c.g, c.b});
            c -= x < 0.08 ? x - 6.25 * x * x : 0.04;
            const double peak = std::max({c.r, c.g, c.b});
            if (peak < 0.76) break;
            const double newPeak = 1.0 - 0.24 * 0.24 / (peak + 0.24 - 0.76);
            const double g = 1.0 - 1.0 / (0.15 * (peak - newPeak) + 1.0);
            c = glm::mix(c * newPeak / peak, glm::dvec3(newPeak), g);
            break;
        }
    }
    return glm::clamp(c, 0.0, 1.0);
}

TEST(Tone, NamesFollowTheEnumeration) {
    ASSERT_EQ(toneMappingNames().size(), kCurves.size());
    EXPECT_EQ(toneMappingNames()[static_cast<size_t>(ToneMapping::none)], "none");
    EXPECT_EQ(toneMappingNames()[static_cast<size_t>(ToneMapping::neutral)], "neutral");
}

/// Rounding of the forms: of the order of ten ulp of 1. AgX' polynomial has terms of up to 40 that cancel,
/// which its power and its gamut conversion enlarge up to fourfold: 40 * 6e-8 * 2 * 4. Both are far below an
/// 8-bit code, 4e-3.
TEST(Tone, AgreesWithDoublePrecision) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> exponent(-14.0F, 8.0F);
    for (const ToneMapping curve : kCurves) {
        double worst = 0.0;
        for (int i = 0; i < 100'000; ++i) {
            Rgb rgb{std::exp2(exponent(random)), std::exp2(exponent(random)), std::exp2(exponent(random))};
            if (i % 10 == 0) rgb[static_cast<size_t>(i / 10 % 3)] = 0.0F;
            const Rgb result = mapped(curve, rgb);
            const glm::dvec3 expected = reference(curve, {rgb[0], rgb[1], rgb[2]});
            for (int c = 0; c < 3; ++c)
                worst = std::max(worst,
                                 std::abs(static_cast<double>(result[static_cast<size_t>(c)]) - expected[c]));
        }
        EXPECT_LT(worst, curve == ToneMapping::agx ? 2e-5 : 1.2e-6)
            << toneMappingNames()[static_cast<size_t>(curve)];
        RecordProperty(toneMappingNames()[static_cast<size_t>(curve)], std::to_string(worst));
    }
}

TEST(Tone, IsFiniteAndInRangeForAnyFiniteInput) {
    constexpr float kMax = std::numeric_limits<float>::max();
    const std::array values = {0.0F,  -0.0F,    1e-45F, 1e-38F, 1e-10F, 0.04F, 0.08F,   0.76F, 0.8F,   1.0F,
                               16.3F, 65504.0F, 1e9F,   1e19F,  1e30F,  kMax,  -1e-10F, -1.0F, -1e30F, -kMax};
    for (const ToneMapping curve : kCurves)
        for (const float r : values)
            for (const float g : values)
                for (const float b : values) {
                    const Rgb result = mapped(curve, {r, g, b});
                    for (const float value : result)
                        ASSERT_TRUE(value >= 0.0F && value <= 1.0F)
                            << toneMappingNames()[static_cast<size_t>(curve)] << " of " << r << " " << g
                            << " " << b << " has " << value;
                }
}

TEST(Tone, SendsNonFiniteInputIntoRange) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const ToneMapping curve : kCurves)
        for (const float bad : {kNan, kInfinity, -kInfinity})
            for (const float value : mapped(curve, {bad, 0.5F, bad}))
                EXPECT_TRUE(value >= 0.0F && value <= 1.0F);
}

/// Along grey: never darker for more light, in every channel, but for rounding (8 ulp of 1).
TEST(Tone, IsMonotoneAlongGrey) {
    constexpr float kRounding = 8.0F * std::numeric_limits<float>::epsilon();
    for (const ToneMapping curve : kCurves) {
        Rgb last{};
        float darkest = 1.0F;
        for (float exponent = -30.0F; exponent < 127.0F; exponent += 1.0F / 256) {
            const float grey = std::exp2(exponent);
            const Rgb result = mapped(curve, {grey, grey, grey});
            for (size_t c = 0; c < 3; ++c) {
                ASSERT_GE(result[c], last[c] - kRounding)
                    << toneMappingNames()[static_cast<size_t>(curve)] << " at " << grey;
                last[c] = std::max(last[c], result[c]);
                darkest = std::min(darkest, result[c]);
            }
        }
        EXPECT_LT(darkest, 0.002F);
        EXPECT_GT(last[1], 0.98F) << "white is reached";
    }
}

TEST(Tone, KeepsHueOfOverflowingColours) {
    for (const ToneMapping curve : kCurves) {
        const Rgb result = mapped(curve, {3e38F, 3e38F, 0.0F});
        EXPECT_GT(result[0], 0.9F);
        EXPECT_GT(result[1], 0.9F);
        EXPECT_LE(result[2], result[0]);
    }
}

/// Published values: neutral keeps base colours less the 0.04 of Fresnel reflection; grey card of the others.
TEST(Tone, HasKnownValues) {
    EXPECT_NEAR(mapped(ToneMapping::neutral, {0.5F, 0.3F, 0.2F})[0], 0.46F, 1e-6F);
    EXPECT_NEAR(mapped(ToneMapping::neutral, {0.5F, 0.3F, 0.2F})[2], 0.16F, 1e-6F);
    EXPECT_NEAR(mapped(ToneMapping::reinhard, {1.0F, 1.0F, 1.0F})[1], 0.5F, 1e-6F);
    EXPECT_NEAR(mapped(ToneMapping::none, {0.25F, 2.0F, -1.0F})[0], 0.25F, 0.0F);
    EXPECT_NEAR(mapped(ToneMapping::aces, {0.18F, 0.18F, 0.18F})[1], 0.1056F, 2e-4F);
    // AgX puts middle grey at half of its output scale (linear: to the power 2.2); the polynomial's error
    // is 1.9e-3 rms.
    EXPECT_NEAR(std::pow(mapped(ToneMapping::agx, {0.18F, 0.18F, 0.18F})[1], 1.0F / 2.2F), 0.5F, 3 * 1.9e-3F);
}

}  // namespace
}  // namespace lobe
