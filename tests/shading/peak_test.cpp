/// Upper bounds of what a model reflects of a direction (Brdf::peak).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "harness/brdf_table.hpp"

namespace lobe {
namespace {

TEST(Peak, NothingIsReflectedAboveIt) {
    std::vector<std::string> without;
    for (const Brdf& brdf : allBrdfs()) {
        if (!brdf.peak) {
            without.push_back(brdf.name);
            continue;
        }
        double nearest = 0.0;
        for (const harness::BrdfRow& row : harness::brdfRows(brdf, 20000, 3)) {
            const ParameterValues values = harness::valuesOf(brdf, row);
            const glm::dvec3 f = brdf.fCos(harness::directionsOf(row), values), peak = brdf.peak(values);
            for (int c = 0; c < 3; ++c) {
                // Directions of floats are longer than 1 by up to 1e-7.
                ASSERT_LE(f[c], peak[c] * (1.0 + 1e-5)) << brdf.name << testing::PrintToString(values);
                if (std::isfinite(peak[c]) && peak[c] > 0.0) nearest = std::max(nearest, f[c] / peak[c]);
            }
        }
        EXPECT_GT(nearest, 0.3) << brdf.name
                                << ": a bound so far above all that it can't be wrong says nothing";
    }
    // Their masking or normalisation lets them grow without end towards grazing angles, but for he, whose
    // series has no bound that we know, and the mirror, which shows no light without extent.
    EXPECT_THAT(without, testing::UnorderedElementsAre("ashikhmin_shirley", "cook_torrance", "he", "mirror",
                                                       "ward", "ward_anisotropic"));
}

}  // namespace
}  // namespace lobe
