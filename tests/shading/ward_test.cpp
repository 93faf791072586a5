/// What docs/models/ward.md and ward_anisotropic.md say of Ward's lobe, as numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "albedo.hpp"
#include "math/quadrature.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"
#include "shading/brdf.hpp"

namespace lobe {
namespace {

const double kPi = glm::pi<double>();

enum Form : int { exact, halfVector };
enum Variant : int { ward, duer, bounded };

/// The lobe alone, with k_s = 1.
ParameterValues lobeValues(double alphaX, double alphaY, Form form, Variant variant, double rotation = 0.0) {
    return {0, 0, 0, 1, 1, 1, alphaX, alphaY, rotation, double(form), double(variant)};
}

/// Albedo of the lobe for light from wo, integrated over the half vector's slopes in units of the widths, in
/// which the lobe is a Gaussian however narrow it is: d wi = 4 V.H d H, d H = cos^3(theta_h) alphaX alphaY
/// du dv.
double slopeAlbedo(const ParameterValues& values, const glm::dvec3& wo) {
    const Brdf& brdf = requireBrdf("ward_anisotropic");
    std::vector<double> breaks;
    for (int i = -32; i <= 32; ++i)
        breaks.push_back(i * 0.1875);  // to 6 widths: exp(-36)
    const QuadratureRule rule = gaussLegendre(6);
    const auto atSlope = [&](double u, double v) {
        const glm::dvec3 h = glm::normalize(glm::dvec3(values[6] * u, values[7] * v, 1.0));
        const double vh = glm::dot(wo, h);
        const glm::dvec3 wi = 2.0 * vh * h - wo;
        if (vh <= 0.0 || wi.z <= 0.0) return 0.0;
        return brdf.fCos({wi, wo}, values).r * 4.0 * vh * std::pow(h.z, 3.0) * values[6] * values[7];
    };
    return integratePanels(
        [&](double u) { return integratePanels([&](double v) { return atSlope(u, v); }, breaks, rule); },
        breaks, rule);
}

glm::dvec3 atCosine(double cosine, double phi = 0.0) {
    return fromPolar(std::acos(cosine), phi);
}

double isotropicAlbedo(double alpha, Form form, Variant variant, double cosine) {
    return slopeAlbedo(lobeValues(alpha, alpha, form, variant), atCosine(cosine));
}

TEST(Ward, KnownAlbedo) {
    EXPECT_NEAR(isotropicAlbedo(0.2, exact, ward, 1.0), 0.895, 1e-3);
    EXPECT_NEAR(isotropicAlbedo(0.2, exact, ward, 0.3), 0.298, 1e-3);
    EXPECT_NEAR(isotropicAlbedo(0.2, exact, duer, 0.3), 0.891, 1e-3);
}

TEST(Ward, KnownGainsOfEnergy) {
    EXPECT_NEAR(isotropicAlbedo(0.2, exact, duer, 0.05), 1.52, 0.01);
    EXPECT_NEAR(isotropicAlbedo(0.7, exact, duer, 0.01), 8.8, 0.05);
    // Half vectors far out count here, where the slopes' quadrature ends.
    const auto wide =
        test::albedo(requireBrdf("ward_anisotropic"), lobeValues(0.7, 0.7, halfVector, ward), 0.01);
    EXPECT_NEAR(wide.value, 1.37, 0.01 + wide.error);

    const glm::dvec3 acrossGrazing = atCosine(0.01, kPi / 2.0);
    EXPECT_NEAR(slopeAlbedo(lobeValues(1e-3, 1.0, exact, ward), acrossGrazing), 1.004, 1e-3);
    EXPECT_NEAR(slopeAlbedo(lobeValues(1e-3, 1.0, exact, duer), acrossGrazing), 11.7, 0.05);
    EXPECT_GT(slopeAlbedo(lobeValues(1e-3, 1.0, halfVector, ward), acrossGrazing), 1.8);
}

TEST(Ward, BoundedVariantNeverGainsEnergy) {
    for (double alphaX : {1e-5, 1e-3, 0.1, 0.5, 2.0, 10.0})
        for (double alphaY : {alphaX, 1000.0 * alphaX, 10.0 * alphaX})
            for (double cosine : {1.0, 0.5, 0.1, 0.01, 1e-4})
                for (double phi : {0.0, 0.8, kPi / 2.0}) {
                    if (alphaY > 10.0) continue;
                    // The Gaussian beyond 6 widths holds 1e-15; the horizon cuts panels: their nodes' weight.
                    EXPECT_LE(slopeAlbedo(lobeValues(alphaX, alphaY, exact, bounded), atCosine(cosine, phi)),
                              1.0 + 2e-3)
                        << alphaX << " " << alphaY << " cosine " << cosine << " phi " << phi;
                }
}

TEST(Ward, IsotropicModelIsTheAnisotropicOneWithEqualWidths) {
    Pcg32 random(11);
    for (int i = 0; i < 500; ++i) {
        const Directions d(uniformHemisphere({random.uniform(), random.uniform()}),
                           uniformHemisphere({random.uniform(), random.uniform()}));
        const double alpha = random.logUniform(1e-2, 2.0);
        for (Variant variant : {ward, duer, bounded}) {
            const double isotropic =
                requireBrdf("ward").fCos(d, ParameterValues{0, 0, 0, 1, 1, 1, alpha, double(variant)}).r;
            const double anisotropic =
                requireBrdf("ward_anisotropic")
                    .fCos(d, lobeValues(alpha, alpha, exact, variant, random.uniform(-7.0, 7.0)))
                    .r;
            // The exponent, up to 700, keeps the roundings of the angles.
            EXPECT_NEAR(isotropic, anisotropic, 1e-11 * isotropic);
        }
    }
}

/// Counter-clockwise: the lobe's long axis turns from x towards y.
TEST(Ward, RotationTurnsTheTangent) {
    const Brdf& brdf = requireBrdf("ward_anisotropic");
    const glm::dvec3 wo(0.0, 0.0, 1.0);
    for (double rotation : {0.3, 1.2, -2.0}) {
        const auto at = [&](double phi, double turned) {
            return brdf.fCos({fromPolar(0.4, phi), wo}, lobeValues(0.5, 0.05, exact, ward, turned)).r;
        };
        EXPECT_NEAR(at(0.1 + rotation, rotation), at(0.1, 0.0), 1e-12 * at(0.1, 0.0));
        EXPECT_GT(at(rotation, rotation), 100.0 * at(rotation + 0.5 * kPi, rotation));
    }
}

TEST(Ward, FormsMeetAtThePeak) {
    const Brdf& brdf = requireBrdf("ward_anisotropic");
    const glm::dvec3 wo = atCosine(0.6);
    for (Variant variant : {ward, duer, bounded}) {
        const auto ratio = [&](double tilt) {
            const Directions d(glm::normalize(glm::dvec3(-wo.x, tilt, wo.z)), wo);
            return brdf.fCos(d, lobeValues(0.1, 0.2, halfVector, variant)).r /
                   brdf.fCos(d, lobeValues(0.1, 0.2, exact, variant)).r;
        };
        EXPECT_DOUBLE_EQ(ratio(0.0), 1.0);
        EXPECT_GT(ratio(0.5), 1.01);
    }
}

}  // namespace
}  // namespace lobe
