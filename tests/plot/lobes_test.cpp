#include "plot/lobes.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "plot/terms.hpp"
#include "shading/on_contexts.hpp"

namespace lobe::plot {
namespace {

constexpr double kPi = glm::pi<double>();
/// A few roundings of a float value near the top of its range.
constexpr double kFloat = 1e-6;

class PlotLobes : public test::OnContext {};

std::vector<LobePoint> lobeOf(const Sampler& sampler, const Model& model, double incidence,
                              Quantity quantity = Quantity::fCos, double azimuth = 0.0) {
    return computeLobes(sampler, {{model}, {incidence}, quantity, Channel::luminance, azimuth})
        .lobes[0]
        .points;
}

TEST_P(PlotLobes, LambertIsACircleThroughTheOriginForIntensityAndOneAboutItForRadiance) {
    const Sampler sampler(library());
    const Model model = makeModel("lambert", {{"diffuse", "0.5"}});
    for (double incidence : {0.0, 40.0, 80.0}) {
        const auto intensity = lobeOf(sampler, model, incidence, Quantity::fCosOut);
        ASSERT_GE(intensity.size(), 300U);
        const double radius = 0.25 / kPi;
        for (const LobePoint& p : intensity) {
            const double angle = glm::radians(p.angle);
            EXPECT_NEAR(std::hypot(p.value * std::sin(angle), p.value * std::cos(angle) - radius), radius,
                        kFloat);
        }
        for (const LobePoint& p : lobeOf(sampler, model, incidence))
            EXPECT_NEAR(p.value, 0.5 / kPi * std::cos(glm::radians(incidence)), kFloat) << p.angle;
        for (const LobePoint& p : lobeOf(sampler, model, incidence, Quantity::f))
            EXPECT_NEAR(p.value, 0.5 / kPi, kFloat) << p.angle;
    }
}

TEST_P(PlotLobes, EveryModelsLobesAreThoseOfItsTwin) {
    const Sampler glsl(library()), twin;
    for (const Brdf& brdf : allBrdfs()) {
        const Model model = makeModel(brdf.name, {});
        for (double incidence : {0.0, 30.0, 60.0}) {
            const auto fromGlsl = lobeOf(glsl, model, incidence);
            const auto fromTwin = lobeOf(twin, model, incidence);
            const double peak = peakOf(fromTwin);
            EXPECT_NEAR(peakOf(fromGlsl), peak, 1e-4 * peak) << brdf.name;
            if (brdf.traits.scattersLight) {
                EXPECT_GT(peak, 0.0) << brdf.name;
            } else {
                EXPECT_EQ(peak, 0.0) << brdf.name;
            }
        }
    }
}

TEST_P(PlotLobes, NarrowLobesAreResolved) {
    const Sampler sampler(library());
    const auto points = lobeOf(sampler, makeModel("ggx", {{"alpha", "0.001"}, {"f0", "1"}}), 45.0);
    const double peak = peakOf(points);
    // D = 1 / (pi alpha^2) at the mirrored direction, over 4 cos cos, times cos.
    EXPECT_NEAR(peak, 1e6 / kPi / (4.0 * std::sqrt(0.5)), 0.01 * peak);
    for (size_t i = 0; i + 1 < points.size(); ++i) {
        ASSERT_LT(points[i].angle, points[i + 1].angle);
        EXPECT_LT(std::abs(points[i + 1].value - points[i].value), 0.011 * peak) << points[i].angle;
    }
    EXPECT_LT(points.size(), 3000U);
}

TEST_P(PlotLobes, AzimuthTurnsThePlaneOfIncidenceAgainstTheTangent) {
    const Sampler sampler(library());
    const Model along = makeModel("ggx", {{"alphaX", "0.1"}, {"alphaY", "0.4"}});
    const Model across = makeModel("ggx", {{"alphaX", "0.4"}, {"alphaY", "0.1"}});
    const auto turned = lobeOf(sampler, along, 30.0, Quantity::fCos, 90.0);
    const auto swapped = lobeOf(sampler, across, 30.0);
    const double peak = peakOf(swapped);
    EXPECT_NEAR(peakOf(turned), peak, 1e-4 * peak);
    const auto valueAt = [](const std::vector<LobePoint>& points, double angle) {
        for (const LobePoint& p : points)
            if (p.angle == angle) return p.value;
        return -1.0;
    };
    // Away from the mirrored direction, the wider side is the brighter one.
    EXPECT_GT(valueAt(turned, 10.0), 2.0 * valueAt(lobeOf(sampler, along, 30.0), 10.0));
}

TEST_P(PlotLobes, MirroredPartsAreKept) {
    const Sampler sampler(library());
    const Lobes lobes = computeLobes(sampler, {{makeModel("mirror", {{"f0", "0.25"}})}, {0.0}});
    EXPECT_NEAR(lobes.lobes[0].mirror, 0.25, kFloat);
}

TEST_P(PlotLobes, CellsOfATableAddUp) {
    const Sampler sampler(library());
    for (const Brdf& brdf : allBrdfs()) {
        if (!hasTerms(brdf)) continue;
        const Terms terms = computeTerms(sampler, {makeModel(brdf.name, {{"diffuse", "0.3"}})});
        ASSERT_EQ(terms.rows.size(), 3U);
        EXPECT_EQ(terms.rows[0].incidence, 60.0);
        for (const TermsRow& row : terms.rows)
            for (size_t i = 0; i < row.cells[3].size(); ++i) {
                const double sum = row.cells[0][i].value + row.cells[1][i].value + row.cells[2][i].value;
                EXPECT_NEAR(sum, row.cells[3][i].value, 1e-3 * row.cells[3][i].value) << brdf.name;
                EXPECT_EQ(row.cells[0][i].angle, row.cells[3][i].angle);
            }
    }
}

TEST_P(PlotLobes, TheLecturesTable) {
    const Sampler sampler(library());
    const Model phong =
        makeModel("phong", {{"ambient", "1"}, {"diffuse", "0.5"}, {"specular", "0.4"}, {"shininess", "20"}});
    for (const TermsRow& row : computeTerms(sampler, {phong}).rows) {
        const double cosine = std::cos(glm::radians(row.incidence));
        for (size_t i = 0; i < row.cells[0].size(); ++i) {
            const double fromMirror = glm::radians(row.cells[2][i].angle - row.incidence);
            EXPECT_NEAR(row.cells[0][i].value, 0.1, kFloat);
            EXPECT_NEAR(row.cells[1][i].value, 0.5 * cosine, kFloat);
            EXPECT_NEAR(row.cells[2][i].value, 0.4 * std::pow(std::max(std::cos(fromMirror), 0.0), 20.0),
                        kFloat);
        }
    }
}

LOBE_ON_EVERY_BACKEND(PlotLobes);

TEST(PlotLobesErrors, AnglesAndModelsThatCannotBe) {
    const Sampler twin;
    EXPECT_THROW(computeLobes(twin, {{makeModel("lambert", {})}, {90.0}}), UsageError);
    EXPECT_THROW(computeLobes(twin, {{makeModel("lambert", {})}, {-1.0}}), UsageError);
    EXPECT_THROW(computeLobes(twin, {{makeModel("lambert", {})}, {std::nan("")}}), UsageError);
    EXPECT_THROW(computeTerms(twin, {makeModel("lambert", {})}), UsageError);
    EXPECT_THROW(computeTerms(twin, {makeModel("mirror", {})}), UsageError);
}

TEST(PlotLobesErrors, NonFiniteValuesEndThePlot) {
    Brdf broken = requireBrdf("lambert");
    broken.fCos = [](const Directions&, std::span<const double>) {
        return glm::dvec3(std::nan(""), 0.0, 0.0);
    };
    try {
        computeLobes(Sampler(), {{{&broken, broken.defaults()}}, {0.0}});
        FAIL() << "NaN was drawn";
    } catch (const Error& error) {
        EXPECT_EQ(error.exitCode(), ExitCode::nonFinite);
    }
}

}  // namespace
}  // namespace lobe::plot
