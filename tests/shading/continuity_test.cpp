/// No jumps: the GLSL followed along a parameter or an angle through the places where its code changes
/// branch, where its ratio to the twin may wander by rounding only.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "harness/brdf_table.hpp"
#include "harness/comparison.hpp"
#include "math/sphere.hpp"
#include "on_contexts.hpp"

namespace lobe {
namespace {

using harness::BrdfRow;

constexpr const char* kLightAngle = "light angle";
constexpr const char* kLightAzimuth = "light azimuth";
constexpr int kSteps = 800;

struct Scan {
    const char* model;
    const char* along;  ///< a parameter, or one of the angles above
    double from, to;    ///< by powers where both are positive and a factor of 100 apart
    std::vector<std::pair<std::string, double>> fixed;
    double lightAngle = 0.5, lightAzimuth = 0.4, viewAngle = 0.7;
};

const std::vector<Scan>& scans() {
    static const std::vector<Scan> list{
        // log1p's two forms meet at tan^2(theta_h) = 0.3.
        {"blinn_phong", kLightAngle, 0.1, 1.5, {{"shininess", 30.0}, {"normalization", 1.0}}},
        {"blinn_phong", "shininess", 1e-3, 1e6, {}, 0.7, 3.1416},
        {"phong", "shininess", 1e-3, 1e6, {}, 0.7, 3.1416},
        {"phong", kLightAngle, 0.1, 1.5, {{"shininess", 30.0}}, 0.5, 3.0},
        {"ashikhmin_shirley", kLightAngle, 0.1, 1.55, {{"nu", 3.0}, {"nv", 40.0}}},
        {"ashikhmin_shirley", "nu", 1e-3, 1e6, {}, 0.7, 3.14},
        // Fresnel: eta^2 - 1 about +-0.5, k^2 about 0.01, the sign of eta^2 - k^2 - sin^2.
        {"cook_torrance", "eta", 1.0001, 4.0, {{"fresnel", 1.0}}},
        {"cook_torrance", "eta", 0.3, 1.1, {{"fresnel", 1.0}}},
        {"cook_torrance", "k", 0.0, 0.3, {{"fresnel", 2.0}, {"eta", 1.2}}},
        {"cook_torrance", "eta", 0.01, 4.0, {{"fresnel", 2.0}, {"k", 1.5}}},
        {"cook_torrance", "m", 0.02, 10.0, {}},
        {"cook_torrance", kLightAngle, 0.0, 1.57, {}},
        {"beckmann_smith", "m", 0.02, 10.0, {}},
        {"beckmann_smith", kLightAngle, 0.0, 1.57, {{"m", 0.5}}},
        {"ggx", "alphaX", 1e-4, 1.0, {{"rotation", 0.3}}},
        {"ggx", "rotation", -7.0, 7.0, {{"alphaX", 0.02}}},
        {"metallic_roughness", "roughness", 0.0, 0.05, {}},
        {"ward", "alpha", 0.05, 10.0, {}},
        {"ward_anisotropic", "alphaX", 0.05, 10.0, {{"form", 1.0}}},
        {"ward_anisotropic", "rotation", -7.0, 7.0, {{"alphaX", 0.3}, {"alphaY", 1.0}, {"variant", 2.0}}},
        {"ward_anisotropic", kLightAngle, 0.0, 1.57, {{"form", 1.0}, {"variant", 1.0}, {"alphaX", 0.5}}},
        // The roles of both directions change at 0.7 rad, the cut's two forms meet at 45 degrees.
        {"oren_nayar", kLightAngle, 0.0, 1.57, {{"sigma", 0.6}}, 0.5, 2.5, 0.7},
        {"oren_nayar", kLightAngle, 0.0, 1.57, {{"sigma", 0.6}}, 0.5, 2.5, 1.2},
        {"oren_nayar", kLightAzimuth, 0.0, 6.28, {{"sigma", 0.6}}, 1.2, 0.0, 1.3},
        {"oren_nayar", "sigma", 0.0, 1.57, {}},
        // He: one term, a few, steps of more than one term, the paper's form from g = 1e7 on.
        {"he", "sigma", 1e-22, 1e-7, {{"tau", 1e-5}}, 0.5, 3.14, 0.5},
        {"he", "sigma", 1e-7, 1e-6, {{"tau", 4e-6}}},
        {"he", "sigma", 1e-4, 2e-4, {{"tau", 1e-3}}},
        {"he", "tau", 3e-7, 3e-5, {}, 0.5, 3.1, 0.52},
        {"he", kLightAngle, 0.0, 1.57, {{"sigma", 4e-7}, {"tau", 1e-6}}},
    };
    return list;
}

BrdfRow rowAt(const Brdf& brdf, const Scan& scan, double t) {
    const ParameterValues defaults = brdf.defaults();
    BrdfRow row{scan.along, {}, {}, {defaults.begin(), defaults.begin() + brdf.valueCount()}};
    const auto set = [&](const std::string& name, double value) {
        const int index = brdf.parameterIndex(name);
        for (int c = 0; c < brdf.parameters.at(static_cast<size_t>(index)).components(); ++c)
            row.values[static_cast<size_t>(brdf.valueOffset(index)) + static_cast<size_t>(c)] =
                static_cast<float>(value);
    };
    for (const auto& [name, value] : scan.fixed)
        set(name, value);
    double angle = scan.lightAngle, azimuth = scan.lightAzimuth;
    const double range = scan.to / scan.from;
    const double value = range > 100.0 && std::isfinite(range) ? scan.from * std::pow(range, t)
                                                               : scan.from + (scan.to - scan.from) * t;
    if (scan.along == std::string(kLightAngle))
        angle = value;
    else if (scan.along == std::string(kLightAzimuth))
        azimuth = value;
    else
        set(scan.along, value);
    row.wi = glm::vec3(fromPolar(angle, azimuth));
    row.wo = glm::vec3(fromPolar(scan.viewAngle, 0.0));
    return row;
}

class Continuity : public test::OnContext {};

TEST_P(Continuity, NoJumpsWhereBranchesMeet) {
    for (const Scan& scan : scans()) {
        const Brdf& brdf = requireBrdf(scan.model);
        std::vector<BrdfRow> rows;
        for (int i = 0; i <= kSteps; ++i)
            rows.push_back(rowAt(brdf, scan, double(i) / kSteps));
        const auto results = harness::BrdfEvaluator(library(), brdf).evaluate(rows);
        double last = NAN, worst = 0.0;
        int steps = 0;
        for (size_t i = 0; i < rows.size(); ++i) {
            const Directions d = harness::directionsOf(rows[i]);
            const ParameterValues values = harness::valuesOf(brdf, rows[i]);
            const double exact = brdf.fCos(d, values).r;
            const harness::Condition c = harness::conditionOf(brdf, d, values);
            const double unit =
                kFloatRounding * (4.0 * c.terms.r + c.componentwise.r + c.length.r + c.parameters.r);
            if (exact < 1e-36 || unit > 1e-3) {
                last = NAN;
                continue;
            }
            const double ratio = double(results[i].fCos.r) / exact;
            if (std::isfinite(last)) {
                const double jump = std::abs(ratio - last) / unit;
                worst = std::max(worst, jump);
                ++steps;
                EXPECT_LE(jump, 8.0) << scan.model << " along " << scan.along << ": " << ratio - last
                                     << " at " << describe(rows[i]);
            }
            last = ratio;
        }
        EXPECT_GT(steps, kSteps / 2) << scan.model << " along " << scan.along;
        std::printf("%s along %s: largest step %.2f of 8 units\n", scan.model, scan.along, worst);
    }
}

LOBE_ON_EVERY_BACKEND(Continuity);

}  // namespace
}  // namespace lobe
