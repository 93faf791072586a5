#include <cmath>

#include "plot/albedo.hpp"
#include "plot/fresnel_curves.hpp"
#include "plot/geometry.hpp"
#include "shading/metals.hpp"
#include "shading/on_contexts.hpp"

namespace lobe::plot {
namespace {

class PlotCurves : public test::OnContext {};

TEST_P(PlotCurves, SchlickStartsAndEndsAtTheExactReflectance) {
    const Sampler sampler(library());
    FresnelRequest request{"all", {{"", 1.5, 0.0}, {"", 1.05, 0.0}, {"", 4.0, 0.0}}};
    for (const shading::Metal& metal : shading::metals())
        request.interfaces.push_back({metal.name, metal.eta.g, metal.k.g});
    for (const FresnelCurve& curve : computeFresnel(sampler, request).curves) {
        const FresnelPoint &first = curve.points.front(), &last = curve.points.back();
        EXPECT_EQ(first.angle, 0.0);
        EXPECT_EQ(last.angle, 90.0);
        EXPECT_NEAR(first.schlick, first.exact, 1e-6);
        EXPECT_NEAR(first.exact, curve.f0, 1e-6);
        EXPECT_NEAR(last.schlick, 1.0, 1e-6);
        EXPECT_NEAR(last.exact, 1.0, 1e-5);
        double largest = 0.0;
        for (const FresnelPoint& p : curve.points) {
            EXPECT_NEAR(0.5 * (p.s + p.p), p.exact, 2e-6) << curve.interface.label << " at " << p.angle;
            EXPECT_GE(p.s, p.p - 1e-12);
            largest = std::max(largest, std::abs(p.schlick - p.exact));
        }
        EXPECT_EQ(std::abs(curve.largestDifference), largest);
        EXPECT_GT(largest, 0.0);
    }
}

TEST_P(PlotCurves, BrewsterAndTotalReflection) {
    const Sampler sampler(library());
    const FresnelCurves curves =
        computeFresnel(sampler, {"", {{"", std::tan(glm::radians(60.0)), 0.0}, {"", 0.5, 0.0}}});
    for (const FresnelPoint& p : curves.curves[0].points)
        if (p.angle == 60.0) {
            EXPECT_LT(p.p, 1e-12);
        }
    for (const FresnelPoint& p : curves.curves[1].points)
        if (p.angle > 30.5) {
            EXPECT_NEAR(p.exact, 1.0, 1e-5) << p.angle;
        }
}

TEST(PlotFresnel, IndexOfNormalReflectance) {
    EXPECT_NEAR(indexOf(0.04), 1.5, 1e-12);
    EXPECT_NEAR(indexOf(0.0), 1.0, 1e-12);
}

TEST_P(PlotCurves, LambertsAlbedoIsItsReflectance) {
    const Sampler sampler(library());
    const Model model = makeModel("lambert", {{"diffuse", "0.25,0.5,0.75"}});
    for (const glm::dvec3& albedo : directionalAlbedo(sampler, model, {0.0, 45.0, 80.0, 89.0}, 0.0))
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(albedo[c], 0.25 * (c + 1), 1e-5);
}

TEST_P(PlotCurves, NarrowLobesKeepTheirEnergy) {
    const Sampler sampler(library());
    const std::vector<double> angles{0.0, 30.0, 60.0, 80.0, 88.0};
    for (const char* alpha : {"0.1", "0.01", "0.001"}) {
        const auto albedos =
            directionalAlbedo(sampler, makeModel("ggx", {{"alpha", alpha}, {"f0", "1"}}), angles, 0.0);
        for (size_t i = 0; i < angles.size(); ++i) {
            EXPECT_LT(albedos[i].r, 1.002) << alpha << " at " << angles[i];
            EXPECT_GT(albedos[i].r, angles[i] < 70.0 ? 0.95 : 0.85) << alpha << " at " << angles[i];
        }
    }
    // Lafortune and Willems: an energy-normalised Phong lobe reflects all light at normal incidence.
    for (const char* n : {"1", "50", "5000"})
        EXPECT_NEAR(directionalAlbedo(sampler,
                                      makeModel("phong", {{"diffuse", "0"},
                                                          {"specular", "1"},
                                                          {"shininess", n},
                                                          {"normalization", "energy"}}),
                                      {0.0}, 0.0)[0]
                        .g,
                    1.0, 1e-4)
            << n;
}

TEST_P(PlotCurves, MirroredPartsCount) {
    const Sampler sampler(library());
    EXPECT_NEAR(directionalAlbedo(sampler, makeModel("mirror", {{"f0", "0.3"}}), {0.0}, 0.0)[0].r, 0.3, 1e-6);
}

TEST_P(PlotCurves, AlbedoByParameter) {
    const Sampler sampler(library());
    const Albedo albedo =
        computeAlbedo(sampler, {makeModel("phong", {{"diffuse", "0"}, {"normalization", "energy"}}),
                                "shininess",
                                {5.0, 500.0},
                                {0.0, 60.0}});
    ASSERT_EQ(albedo.albedo.size(), 2U);
    ASSERT_EQ(albedo.albedo[0].size(), 2U);
    EXPECT_NEAR(albedo.albedo[0][0], 0.5, 1e-4);
    EXPECT_NEAR(albedo.albedo[1][0], 0.5, 1e-4);
    // A narrow lobe's falls with the cosine of the incidence, a wide one's more slowly.
    EXPECT_NEAR(albedo.albedo[1][1], 0.25, 1e-3);
    EXPECT_GT(albedo.albedo[0][1], 0.255);
    EXPECT_THROW(computeAlbedo(sampler, {makeModel("phong", {}), "shininess", {-1.0}, {0.0}}), UsageError);
    EXPECT_THROW(computeAlbedo(sampler, {makeModel("phong", {}), "diffuse", {0.5}, {0.0}}), UsageError);
}

LOBE_ON_EVERY_BACKEND(PlotCurves);

TEST(PlotSteps, EndsAreExact) {
    EXPECT_EQ(linearSteps(0.0, 90.0, 4), (std::vector<double>{0.0, 30.0, 60.0, 90.0}));
    EXPECT_EQ(geometricSteps(0.001, 1.0, 4).back(), 1.0);
    EXPECT_NEAR(geometricSteps(0.001, 1.0, 4)[1], 0.01, 1e-15);
    EXPECT_EQ(rounded(0.0398107, 3), 0.0398);
    EXPECT_EQ(rounded(0.0, 3), 0.0);
}

}  // namespace
}  // namespace lobe::plot
