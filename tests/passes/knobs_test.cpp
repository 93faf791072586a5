// What the quality knobs do to pictures, and by how much at most.
#include <gtest/gtest.h>

#include <numbers>

#include "passes/rendering.hpp"

namespace lobe {
namespace {

using namespace test;

constexpr double kEpsilon = 5.96e-8;        // 2^-24
constexpr double kTruncatedHalf = 0x1p-10;  // OpenGL leaves it to the driver to round or to cut off

/// What `normal_bits` asks for is what is stored; auto is 16 bits, or 32 with a G-buffer of 32.
TEST(Knobs, NormalBitsAreWhatIsStored) {
    const Scene scene = modelsAndLights();
    const auto normals = [&](int gbufferBits, int normalBits) {
        return render(scene, frontCamera(5.0),
                      smallPicture({.samples = 1, .gbufferBits = gbufferBits, .normalBits = normalBits},
                                   {Aov::radiance, Aov::normal, Aov::materialId}));
    };
    const Image exact = normals(32, 32);
    EXPECT_EQ(normals(16, 0).values, normals(16, 16).values);
    EXPECT_EQ(normals(32, 0).values, exact.values);
    const size_t nx = channelIndex(exact, "normal.X");
    const size_t id = channelIndex(exact, "material.id");
    // Angles of tests/shading/octahedral_test.cpp, beside that of the 32-bit normals.
    for (const auto& [bits, most] : {std::pair(8, 1.7e-2), std::pair(16, 6.45e-5)}) {
        const Image image = normals(32, bits);
        double largest = 0.0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                if (image.pixel(x, y)[id] == 0.0f) continue;
                const float* a = image.pixel(x, y) + nx;
                const float* b = exact.pixel(x, y) + nx;
                const glm::dvec3 u(a[0], a[1], a[2]);
                const glm::dvec3 v(b[0], b[1], b[2]);
                largest = std::max(largest, std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)));
            }
        EXPECT_LE(largest, most + 3.2e-7) << bits;
        EXPECT_GT(largest, 0.5 * most) << bits << " bits are not stored as such";
    }
}

TEST(Knobs, SixteenBitsOfRadianceAreOffByTheirRounding) {
    const Scene scene = modelsAndLights();
    // Each light is stored once at most, and what the G-buffer pass writes once more; a relative error of
    // each store, and a step of the smallest half floats.
    const double stores = static_cast<double>(scene.lights.size()) + 1.0;
    for (const Shading shading : {Shading::deferred, Shading::forward})
        for (const int samples : {1, 4}) {
            const auto with = [&](int bits, const AovSet& aovs) {
                return render(
                    scene, frontCamera(5.0),
                    smallPicture(
                        {.samples = samples, .gbufferBits = 32, .shading = shading, .radianceBits = bits},
                        aovs));
            };
            for (const AovSet& aovs : {AovSet{Aov::radiance}, AovSet{Aov::radiance, Aov::contributions}}) {
                const Image half = with(16, aovs);
                const Image full = with(32, aovs);
                ASSERT_EQ(half.values.size(), full.values.size());
                double largest = 0.0;
                for (size_t i = 0; i < full.values.size(); ++i) {
                    const auto a = static_cast<double>(half.values[i]);
                    const auto b = static_cast<double>(full.values[i]);
                    ASSERT_LE(std::abs(a - b),
                              (std::pow(1.0 + kTruncatedHalf, stores) - 1.0 + 16.0 * kEpsilon) * b +
                                  stores * 0x1p-24);
                    if (b > 0.01) largest = std::max(largest, std::abs(a - b) / b);
                }
                EXPECT_GT(largest, 0x1p-12) << "not stored in 16 bits";
                std::printf("radiance 16 bits, %d samples: %.3g relative\n", samples, largest);
            }
        }
}

TEST(Knobs, RadianceBeyondSixteenBitsIsSeen) {
    Scene scene;
    addInstance(scene, addQuad(scene, addMaterial(scene, "lambert"), 10.0f));
    setParameter(scene.materials[0], "diffuse", glm::dvec3(1.0));
    scene.lights.push_back(directional({0, 0, -1}, glm::dvec3(0.0)));
    const auto bad = [&](double radiance, int samples, int bits, const AovSet& aovs) {
        scene.lights[0].intensity = glm::dvec3(std::numbers::pi * radiance);
        return countNonFinite(render(scene, frontCamera(),
                                     smallPicture({.samples = samples, .radianceBits = bits}, aovs)))
            .pixels;
    };
    for (const int samples : {1, 4})
        for (const AovSet& aovs : {AovSet{Aov::radiance}, AovSet{Aov::radiance, Aov::contributions}}) {
            EXPECT_EQ(bad(65000.0, samples, 16, aovs), 0u) << samples;
            EXPECT_EQ(bad(70000.0, samples, 16, aovs), 96u * 64u) << samples;
            EXPECT_EQ(bad(1e9, samples, 16, aovs), 96u * 64u) << samples;
            EXPECT_EQ(bad(1e9, samples, 32, aovs), 0u) << samples;
        }
}

/// What the knob draws is the scene whose materials are Schlick's with the F0 of their indices.
TEST(Knobs, SchlickHasTheSameReflectanceAtNormalIncidence) {
    Scene scene;
    for (int i = 0; i < 2; ++i) {
        Material& gold = scene.materials[static_cast<size_t>(addMaterial(scene, "cook_torrance"))];
        setParameter(gold, "fresnel", glm::dvec3(i == 0 ? 2.0 : 1.0));
        setParameter(gold, "eta", {0.18, 0.42, 1.37});
        setParameter(gold, "k", {3.42, 2.35, 1.77});
        addInstance(scene, addSphere(scene, i),
                    glm::translate(glm::dmat4(1.0), glm::dvec3(i == 0 ? -1 : 1, 0, 0)));
    }
    scene.lights.push_back(directional({0.9, 0, -0.4}, glm::dvec3(3.0)));
    Scene byHand = scene;
    for (Material& material : byHand.materials) {
        const Brdf& brdf = requireBrdf(material.brdf);
        const auto at = [&](const char* name) {
            const double* v =
                &material.values[static_cast<size_t>(brdf.valueOffset(brdf.parameterIndex(name)))];
            return glm::dvec3(v[0], v[1], v[2]);
        };
        const bool metal = &material == &byHand.materials[0];
        const glm::dvec3 eta = at("eta");
        const glm::dvec3 k2 = metal ? at("k") * at("k") : glm::dvec3(0.0);
        setParameter(material, "f0", ((eta - 1.0) * (eta - 1.0) + k2) / ((eta + 1.0) * (eta + 1.0) + k2));
        setParameter(material, "fresnel", glm::dvec3(0.0));
    }
    const Image exact = render(scene, frontCamera(6.0));
    const Image knob =
        render(scene, frontCamera(6.0),
               smallPicture({.samples = 1, .gbufferBits = 32, .fresnel = FresnelEquations::schlick}));
    const Image expected = render(byHand, frontCamera(6.0));
    double largest = 0.0;
    for (size_t i = 0; i < knob.values.size(); ++i) {
        const auto a = static_cast<double>(knob.values[i]);
        // The two F0 differ by their rounding to float at most, which F passes on at no more than its size.
        ASSERT_NEAR(a, static_cast<double>(expected.values[i]), 16.0 * kEpsilon * a);
        largest = std::max(largest, relativeDifference(a, static_cast<double>(exact.values[i])));
    }
    EXPECT_GT(largest, 1e-2) << "Schlick's approximation is not in use";
}

}  // namespace
}  // namespace lobe
