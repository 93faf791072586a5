#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "base/error.hpp"
#include "image/edges.hpp"
#include "image/metrics.hpp"
#include "image/ssim.hpp"

namespace lobe {
namespace {

Image picture(int width, int height, const std::function<double(int, int, int)>& value) {
    Image image(width, height, {"R", "G", "B"});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                image.pixel(x, y)[c] = static_cast<float>(value(x, y, c));
    return image;
}

Image constant(int width, int height, double value) {
    return picture(width, height, [&](int, int, int) { return value; });
}

/// The same formula as given to NVIDIA's flip_evaluator 1.x, whose means are below.
double wave(double x, double y, int c) {
    return c == 0   ? 0.5 + 0.4 * std::sin(x / 9 + y / 23)
           : c == 1 ? 0.3 + 0.3 * std::cos(x / 31)
                    : 0.5 + 0.5 * std::sin(x * y / 900);
}

RgbPlanes planes(double gain, double shift, bool hdr) {
    RgbPlanes result{96, 64, {}};
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 96; ++x) {
                const double value = gain * wave(x + shift, y, c);
                const double display =
                    value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
                result.rgb[static_cast<size_t>(c)].push_back(hdr ? 8 * std::pow(value, 4) + 0.001 : display);
            }
    return result;
}

double mean(const Plane& plane) {
    double sum = 0.0;
    for (const double value : plane)
        sum += value;
    return sum / static_cast<double>(plane.size());
}

// The published implementation computes in float: sums of about 40 products each of 2^-24, twice, and powers
// of at most 0.7: 1e-5 covers its rounding.
constexpr double kFloatFlip = 1e-5;

TEST(Flip, IsThePublishedImplementations) {
    const double pixels = defaultPixelsPerDegree();
    EXPECT_NEAR(pixels, 67.02064, 1e-5);
    const RgbPlanes truth = planes(1, 0, false), bright = planes(1, 0, true);
    EXPECT_NEAR(mean(flip(planes(0.9, 0, false), truth, pixels)), 0.29870462, kFloatFlip);
    EXPECT_NEAR(mean(flip(planes(1, 1, false), truth, pixels)), 0.11889910, kFloatFlip);
    EXPECT_NEAR(mean(hdrFlip(planes(0.9, 0, true), bright, pixels)), 0.32067296, kFloatFlip);
    EXPECT_NEAR(mean(hdrFlip(planes(1, 1, true), bright, pixels)), 0.16808917, kFloatFlip);
    EXPECT_NEAR(exposuresOf(bright).start, 0.15491265, 1e-5);
    EXPECT_NEAR(exposuresOf(bright).stop, 1.49181569, 1e-5);
}

TEST(Flip, IsSymmetricAndNothingForEqualPictures) {
    const RgbPlanes a = planes(1, 0, false), b = planes(0.8, 3, false);
    EXPECT_EQ(flip(a, b, 67), flip(b, a, 67));
    EXPECT_EQ(mean(flip(a, a, 67)), 0.0);
    EXPECT_EQ(mean(hdrFlip(a, a, 67)), 0.0);
    EXPECT_GT(mean(flip(a, b, 67)), 0.1);
}

TEST(Flip, OfBlackAndWhiteIsOne) {
    const RgbPlanes black{4, 4, {Plane(16, 0.0), Plane(16, 0.0), Plane(16, 0.0)}};
    const RgbPlanes white{4, 4, {Plane(16, 1.0), Plane(16, 1.0), Plane(16, 1.0)}};
    EXPECT_GT(mean(flip(black, white, 67)), 0.95);
    EXPECT_LE(mean(flip(black, white, 67)), 1.0);
    EXPECT_EQ(exposuresOf(black).count, 1);
}

TEST(Ssim, OfConstantsIsItsLuminanceTerm) {
    const Plane a(64, 0.25), b(64, 0.75);
    const double expected = (2 * 0.25 * 0.75 + 1e-4) / (0.25 * 0.25 + 0.75 * 0.75 + 1e-4);
    for (const double value : ssim(a, b, 8, 8))
        EXPECT_NEAR(value, expected, 1e-12);  // variances cancel to 1e-16, over C2 = 9e-4
    EXPECT_EQ(ssim(a, b, 8, 8), ssim(b, a, 8, 8));
}

TEST(Error, OfConstantsIsItsClosedForm) {
    const ErrorMetrics error = measureError(constant(40, 25, 1.5), constant(40, 25, 2.0));
    constexpr double kSum = 1000 * 4 * 0x1p-53;  // additions of one sum, relative
    EXPECT_EQ(error.pixels, 1000U);
    EXPECT_NEAR(*error[Metric::relMse], 0.25 / 4.01, kSum);
    EXPECT_NEAR(*error[Metric::relMseTrimmed], 0.25 / 4.01, kSum);
    EXPECT_NEAR(*error[Metric::rmse], 0.5, kSum);
    EXPECT_EQ(*error[Metric::max], 0.5);
    EXPECT_EQ(*error[Metric::p95], 0.5);
    EXPECT_NEAR(*error[Metric::bias], -0.5, kSum);
    EXPECT_NEAR(*measureError(constant(40, 25, 2.0), constant(40, 25, 1.5))[Metric::bias], 0.5, kSum);
    EXPECT_TRUE(std::isinf(*error[Metric::psnr]));  // both are white on a display
}

TEST(Error, TrimmingLeavesOutOneInAThousand) {
    Image test = constant(50, 40, 1.0);
    for (float* value = test.pixel(7, 9); value < test.pixel(7, 9) + 3; ++value)
        *value = 1000.0F;
    const ErrorMetrics error = measureError(test, constant(50, 40, 1.0), {.perceptual = false});
    EXPECT_GT(*error[Metric::relMse], 400.0);
    EXPECT_EQ(*error[Metric::relMseTrimmed], 0.0);
    EXPECT_EQ(*error[Metric::p99], 0.0);
    EXPECT_EQ(*error[Metric::max], 999.0);
}

TEST(Error, TakesOffTheTruthsVariance) {
    Image truth(2, 2, {"R", "G", "B", "error.R", "error.G", "error.B"});
    for (size_t i = 0; i < truth.values.size(); ++i)
        truth.values[i] = i % 6 < 3 ? 1.0F : 0.5F;
    const ErrorMetrics error =
        measureError(constant(2, 2, 2.0), truth, {.subtractTruthVariance = true, .perceptual = false});
    EXPECT_NEAR(*error[Metric::relMse], 0.75 / 1.01, 1e-15);
    EXPECT_THROW(measureError(truth, constant(2, 2, 1.0), {.subtractTruthVariance = true}), InputError);
}

TEST(Error, CountsNonFinitePixelsAndGivesNothingElse) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Image test = constant(3, 3, 1.0);
        test.pixel(1, 2)[0] = bad;
        const ErrorMetrics error = measureError(test, constant(3, 3, 1.0));
        EXPECT_EQ(error.testNonFinite.pixels, 1U);
        EXPECT_FALSE(error[Metric::rmse]);
        EXPECT_EQ(measureError(constant(3, 3, 1.0), test).truthNonFinite.pixels, 1U);
    }
}

TEST(Error, IsFiniteForOnePixelBlackAndHugeValues) {
    for (const double a : {0.0, 1e-30, 1.0, 1e30})
        for (const double b : {0.0, 1.0, 1e30}) {
            const ErrorMetrics error = measureError(constant(1, 1, a), constant(1, 1, b));
            for (size_t i = 0; i < kMetricCount; ++i) {
                ASSERT_TRUE(error.values[i]) << metricNames()[i];
                if (static_cast<Metric>(i) != Metric::psnr) {
                    EXPECT_TRUE(std::isfinite(*error.values[i])) << metricNames()[i] << ' ' << a << ' ' << b;
                }
            }
        }
}

TEST(Error, RefusesDifferentSizes) {
    EXPECT_THROW(measureError(constant(2, 3, 1.0), constant(3, 2, 1.0)), InputError);
}

TEST(Edges, AreWhereMaterialsMeetAndNotOnASlantedPlane) {
    Image truth(9, 5, {"material.id", "depth.Z"});
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 9; ++x) {
            truth.pixel(x, y)[0] = x < 4 ? 1.0F : 2.0F;
            truth.pixel(x, y)[1] = 1.0F / (1.0F - 0.1F * static_cast<float>(x));  // a plane, steep
        }
    const std::optional<PixelMask> mask = edgePixels(constant(9, 5, 0.0), truth);
    ASSERT_TRUE(mask);
    for (size_t x = 0; x < 9; ++x)
        EXPECT_EQ((*mask)[9 * 2 + x], x == 3 || x == 4 ? 1 : 0) << x;
    EXPECT_FALSE(edgePixels(constant(9, 5, 0.0), constant(9, 5, 0.0)));
}

}  // namespace
}  // namespace lobe
