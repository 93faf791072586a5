#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/gtc/constants.hpp>

#include "plot/drawing.hpp"
#include "plot/geometry.hpp"
#include "shading/on_contexts.hpp"

namespace lobe::plot {
namespace {

class PlotMaps : public test::OnContext {};

TEST_P(PlotMaps, ModelsStayBelowTheirBound) {
    const Sampler sampler(library());
    for (const Brdf& brdf : allBrdfs()) {
        if (!brdf.traits.scattersLight) continue;
        const ErrorMap map =
            computeErrorMap(sampler, {makeModel(brdf.name, {}), "", {0.0}, {0.0, 20.0, 45.0, 70.0, 88.0}});
        ASSERT_EQ(map.cells.size(), 5U);
        EXPECT_LT(map.worstShare.share, 1.0) << brdf.name;
        if (brdf.name != "lambert") {
            EXPECT_GT(map.worstUlp.ulp, 0.0) << brdf.name;
        }
    }
    const ErrorMap swept = computeErrorMap(
        sampler, {makeModel("cook_torrance", {}), "m", {0.001, 0.03, 1.0}, {0.0, 60.0, 85.0}});
    EXPECT_LT(swept.worstShare.share, 1.0);
    EXPECT_EQ(swept.cells.size(), 9U);
}

TEST_P(PlotMaps, AWrongModelDoesNot) {
    const Sampler sampler(library());
    Brdf wrong = requireBrdf("ggx");
    const auto right = wrong.fCos;
    wrong.fCos = [right](const Directions& d, std::span<const double> values) {
        return right(d, values) * (1.0 + 1e-3 * d.wo.z);
    };
    Model model = makeModel("ggx", {});
    model.brdf = &wrong;
    const ErrorMap map = computeErrorMap(sampler, {model, "", {0.0}, {0.0, 45.0}});
    EXPECT_GT(map.worstShare.share, 1.0);
    EXPECT_GT(map.worstUlp.ulp, 1000.0);
}

TEST_P(PlotMaps, SlicesHoldTheReflectance) {
    const Sampler sampler(library());
    for (const char* name : {"lambert", "measured"}) {  // whose default table is Lambert's
        const Slice slice = computeSlice(sampler, {makeModel(name, {})});
        ASSERT_EQ(slice.cells.size(), 8100U);
        for (const SliceCell& cell : slice.cells) {
            EXPECT_NEAR(cell.f.g, 1.0 / glm::pi<double>(), 1e-6) << name;
            EXPECT_EQ(cell.tone[1], 255);
        }
    }
    // The lobe lies where the half vector is along the normal.
    const Slice ggx = computeSlice(sampler, {makeModel("ggx", {{"alpha", "0.1"}, {"f0", "1"}}), 90.0, 30});
    EXPECT_GT(ggx.cells[0].f.r, 10.0 * ggx.cells[29].f.r);
    EXPECT_GT(ggx.cells[0].tone[0], ggx.cells[15].tone[0]);
}

/// A table of the MERL database with one size of 2 and others of 1, red, green and blue.
std::string merlFile(const std::vector<double>& values) {
    std::string bytes(12, '\0');
    const std::array<int32_t, 3> sizes{2, 1, 1};
    std::memcpy(bytes.data(), sizes.data(), 12);
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
    return bytes;
}

TEST_P(PlotMaps, FilesOfMeasurements) {
    const std::string file = testing::TempDir() + "two_cells_" + GetParam() + ".binary";
    std::ofstream(file, std::ios::binary) << merlFile({1500.0, 0.0, 1500.0, 0.0, 1500.0, -1.0});
    const Slice slice = computeSlice(Sampler(library()), {makeModel("measured", {{"file", file}})});
    EXPECT_NEAR(slice.cells.front().f.r, 1.0, 1e-6);
    EXPECT_NEAR(slice.cells.front().f.g, 1.15, 1e-6);
    EXPECT_EQ(slice.cells.back().f, glm::dvec3(0.0));
    std::ofstream(file, std::ios::binary) << merlFile({1.0});
    EXPECT_THROW(makeModel("measured", {{"file", file}}), InputError);
    EXPECT_THROW(makeModel("measured", {{"file", file + ".missing"}}), InputError);
}

TEST_P(PlotMaps, SurfacesCoverTheHemisphere) {
    const Sampler sampler(library());
    for (const char* alpha : {"0.01", "1"}) {
        const Surface surface = computeSurface(sampler, {makeModel("ggx", {{"alpha", alpha}})});
        ASSERT_EQ(surface.rings.size(), 64U);
        double lowest = 1.0;
        for (const auto& ring : surface.rings) {
            ASSERT_EQ(ring.size(), 91U);
            EXPECT_EQ(ring.front().value, ring.back().value);
            for (const SurfacePoint& point : ring) {
                EXPECT_GT(point.direction.z, 0.0);
                EXPECT_NEAR(glm::length(point.direction), 1.0, 1e-12);
                lowest = std::min(lowest, point.direction.z);
            }
        }
        EXPECT_LT(lowest, 1e-3);
    }
}

LOBE_ON_EVERY_BACKEND(PlotMaps);

TEST(PlotMapsErrors, MirrorsAndTwinsAreRefused) {
    const Sampler twin;
    EXPECT_THROW(computeErrorMap(twin, {makeModel("ggx", {}), "", {0.0}, {0.0}}), UsageError);
    EXPECT_THROW(computeSlice(twin, {makeModel("mirror", {})}), UsageError);
    EXPECT_THROW(computeSurface(twin, {makeModel("mirror", {})}), UsageError);
    EXPECT_THROW(computeSurface(twin, {makeModel("ggx", {}), 95.0}), UsageError);
}

}  // namespace
}  // namespace lobe::plot
