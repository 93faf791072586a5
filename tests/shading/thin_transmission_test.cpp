/// What thin surfaces let through: GLSL against the twin, and the ends of its parameters.
#include <gtest/gtest.h>

#include <cmath>

#include "harness/evaluator.hpp"
#include "math/random.hpp"
#include "math/ulp.hpp"
#include "on_contexts.hpp"
#include "shading/brdf.hpp"

namespace lobe {
namespace {

class ThinTransmission : public test::OnContext {};

TEST_P(ThinTransmission, TransmittanceIsTheTwins) {
    const harness::Evaluator evaluator(
        library(),
        {"transmittance",
         {"brdf/thin_transmission.glsl"},
         {{"vec3", "color"},
          {"float", "metallic"},
          {"float", "roughness"},
          {"float", "transmission"},
          {"float", "cosine"}},
         "    ThinTransmissionParams p = ThinTransmissionParams(color, metallic, roughness, transmission);\n"
         "    result[0].xyz = thin_transmission_transmittance(cosine, p);",
         1,
         {}});
    const Brdf& brdf = requireBrdf("thin_transmission");
    Pcg32 random(3);
    std::vector<float> inputs;
    std::vector<glm::dvec3> exact;
    for (int i = 0; i < test::tableScale(20000); ++i) {
        std::vector<double> values;
        for (int v = 0; v < 6; ++v) {
            values.push_back(static_cast<double>(static_cast<float>(random.uniform())));
            inputs.push_back(static_cast<float>(values.back()));
        }
        const auto cosine = static_cast<float>(i % 2 == 0 ? random.uniform() : random.logUniform(1e-7, 1.0));
        inputs.push_back(cosine);
        exact.push_back(brdf.transmittance(static_cast<double>(cosine), values));
    }
    const harness::ResultTable table = evaluator.evaluate(inputs);
    double worst = 0.0;
    for (size_t i = 0; i < exact.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const auto got = static_cast<double>(table.row(i)[static_cast<size_t>(c)]);
            const double metallic = static_cast<double>(inputs[7 * i + 3]);
            // A dozen roundings, and that of 1 - metallic; 1 - F of the twin cancels below a cosine of 1e-7.
            const double allowed = kFloatRounding * (16.0 + 1.0 / (1.0 - metallic)) * exact[i][c] + 1e-16;
            ASSERT_NEAR(got, exact[i][c], allowed) << i;
            if (exact[i][c] > 0.0) worst = std::max(worst, std::abs(got - exact[i][c]) / exact[i][c]);
        }
    std::printf("transmittance: worst %.1e\n", worst);
}

LOBE_ON_EVERY_BACKEND(ThinTransmission);

TEST(ThinTransmissionTwin, IsMetallicRoughnessWithoutTransmission) {
    const Brdf& thin = requireBrdf("thin_transmission");
    const Brdf& base = requireBrdf("metallic_roughness");
    const Directions d(glm::normalize(glm::dvec3(0.3, 0.1, 0.8)), glm::normalize(glm::dvec3(-0.5, 0.2, 0.6)));
    const std::vector<double> surface{0.8, 0.4, 0.2, 0.3, 0.5};
    std::vector<double> values = surface;
    values.push_back(0.0);
    EXPECT_EQ(thin.fCos(d, values), base.fCos(d, surface));
    EXPECT_EQ(thin.transmittance(0.7, values), glm::dvec3(0.0));
    values.back() = 1.0;  // the lobe alone is left
    const std::vector<double> black{0.0, 0.0, 0.0, 0.0, 0.5};
    const std::vector<double> clear{0.8, 0.4, 0.2, 0.0, 0.5, 1.0};
    EXPECT_NEAR(thin.fCos(d, clear).x, base.fCos(d, black).x, 1e-15);
    values[3] = 1.0;
    EXPECT_EQ(thin.transmittance(0.7, values), glm::dvec3(0.0)) << "a metal lets nothing through";
}

}  // namespace
}  // namespace lobe
