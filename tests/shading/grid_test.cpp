/// What the tables that every model is tested over must hold, so that a change of a range or of the generator
/// does not quietly take the hard cases out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/brdf_table.hpp"

namespace lobe {
namespace {

/// The rows of the agreement test (brdf_twin_test.cpp).
std::vector<harness::BrdfRow> rowsOf(const Brdf& brdf) {
    return harness::brdfRows(brdf, 4000, 1);
}

struct Reach {
    const char* parameter;
    double low, high;
};

/// Ends that a parameter of this name must have, in whichever model it is.
constexpr Reach kReaches[] = {{"m", 1e-5, 10.0},     {"shininess", 0.0, 1e6}, {"nu", 0.0, 1e6},
                              {"nv", 0.0, 1e6},      {"eta", 1.0001, 4.0},    {"k", 0.0, 10.0},
                              {"alpha", 1e-5, 10.0}, {"roughness", 0.0, 1.0}, {"metallic", 0.0, 1.0},
                              {"sigma", 0.0, 1.57}};

TEST(Grid, DirectionsOfEveryKind) {
    for (const Brdf& brdf : allBrdfs()) {
        SCOPED_TRACE(brdf.name);
        float leastLight = 1.0f, leastView = 1.0f, leastSum = 1.0f;
        size_t equal = 0, normal = 0;
        for (const harness::BrdfRow& row : rowsOf(brdf)) {
            leastLight = std::min(leastLight, row.wi.z > 0.0f ? row.wi.z : 1.0f);
            leastView = std::min(leastView, row.wo.z > 0.0f ? row.wo.z : 1.0f);
            leastSum = std::min(leastSum, glm::length(row.wi + row.wo));
            equal += row.wi == row.wo ? 1 : 0;
            normal += row.wi == glm::vec3(0, 0, 1) ? 1 : 0;
        }
        EXPECT_LT(leastLight, 1.1e-7f);
        EXPECT_LT(leastView, 1.1e-7f);
        EXPECT_LT(leastSum, 1e-6f);
        EXPECT_GE(equal, 1000U);
        EXPECT_GE(normal, 1000U);
    }
}

TEST(Grid, ParametersReachTheirEnds) {
    size_t found = 0;
    for (const Brdf& brdf : allBrdfs()) {
        const std::vector<harness::BrdfRow> rows = rowsOf(brdf);
        for (const Reach& reach : kReaches) {
            const int index = brdf.parameterIndex(reach.parameter);
            if (index < 0) continue;
            SCOPED_TRACE(brdf.name + "." + reach.parameter);
            ++found;
            const Parameter& parameter = brdf.parameters[static_cast<size_t>(index)];
            EXPECT_LE(parameter.minimum, reach.low);
            EXPECT_GE(parameter.maximum, reach.high);
            const auto offset = static_cast<size_t>(brdf.valueOffset(index));
            double least = INFINITY, most = -INFINITY;
            for (const harness::BrdfRow& row : rows) {
                least = std::min(least, double(row.values[offset]));
                most = std::max(most, double(row.values[offset]));
            }
            EXPECT_LE(least, reach.low + 1e-3 * std::max(reach.low, 0.01));
            EXPECT_GE(most, 0.99 * reach.high);
        }
    }
    EXPECT_GE(found, 20U);
}

/// Both ways round, with lobes that floats resolve.
TEST(Grid, AnisotropyToAThousand) {
    size_t found = 0;
    for (const Brdf& brdf : allBrdfs()) {
        for (const auto& [along, across] : {std::pair("alphaX", "alphaY"), std::pair("nv", "nu")}) {
            if (brdf.parameterIndex(along) < 0) continue;
            ++found;
            const auto x = static_cast<size_t>(brdf.valueOffset(brdf.parameterIndex(along)));
            const auto y = static_cast<size_t>(brdf.valueOffset(brdf.parameterIndex(across)));
            // Exponents go with the square of widths.
            const double thousand = along == std::string("nv") ? 0.99e6 : 990.0;
            size_t wide = 0, narrow = 0;
            for (const harness::BrdfRow& row : rowsOf(brdf)) {
                const double a = std::max(double(row.values[x]), 1e-30),
                             b = std::max(double(row.values[y]), 1e-30);
                wide += a / b >= thousand ? 1 : 0;
                narrow += b / a >= thousand ? 1 : 0;
            }
            EXPECT_GE(wide, 100U) << brdf.name;
            EXPECT_GE(narrow, 100U) << brdf.name;
        }
    }
    EXPECT_EQ(found, 3U);
}

}  // namespace
}  // namespace lobe
