// Lights that show an image, in the reference.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "math/sphere.hpp"
#include "reference/body_lamp.hpp"
#include "reference/direct_light.hpp"

namespace lobe::reference {
namespace {

const Visibility kAllVisible = [](const glm::dvec3&, double) { return 1.0; };

Bitmap bitmapOf(int width, int height, const std::function<glm::vec3(int, int)>& color) {
    Bitmap bitmap{width, height, 3, ComponentType::f32, {}};
    std::vector<float> values;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                values.push_back(color(x, y)[c]);
    bitmap.data.resize(values.size() * sizeof(float));
    std::memcpy(bitmap.data.data(), values.data(), bitmap.data.size());
    return bitmap;
}

Bitmap colored() {
    return bitmapOf(
        4, 3, [](int x, int y) { return glm::vec3(0.1 + 0.3 * x, 1.0 / (1 + y), (x * 7 + y * 5) % 4); });
}

Light rect() {
    Light light;
    light.type = LightType::rect;
    light.position = {-0.3, 0.2, 1.1};
    light.direction = glm::normalize(glm::dvec3(0.3, 0.1, -1));
    light.axis = frameAbout(light.direction)[0];
    light.width = 1.2;
    light.height = 0.8;
    light.intensity = {3.0, 2.0, 1.0};
    light.image = 0;
    return light;
}

/// A point at the origin, facing +Z.
struct Bench {
    Scene scene;
    const Brdf& brdf;
    ParameterValues values;
    ShadingPoint point;
    Pcg32 random{11};

    Bench(const std::string& model, Bitmap image) : brdf(requireBrdf(model)), values(brdf.defaults()) {
        if (const int table = brdf.tableParameter(); table >= 0) {
            const TableRows rows = brdf.table->examples().front().second;
            values.insert(values.end(), rows.begin(), rows.end());
        }
        point.toEye = fromPolar(0.7, 0.4);
        point.brdf = &brdf;
        point.values = values;
        scene.images.push_back(std::move(image));
        scene.lights = {rect()};
    }

    Estimate integrate(Method method, int rounds, const Visibility& visible = kAllVisible) {
        const DirectLight lights(scene, nullptr, method);
        Contributions sum{};
        Estimate all;
        for (const auto& integral : lights.at(point, visible, random, sum)) {
            for (int i = 0; i < rounds; ++i)
                integral->refine();
            all.mean += integral->estimate().mean;
            all.variance += integral->estimate().variance;
        }
        for (const glm::dvec3& one : sum)
            all.mean += one;
        return all;
    }
};

void expectEqual(const Estimate& a, const Estimate& b, const std::string& what) {
    for (int c = 0; c < 3; ++c) {
        const double allowed = 5.5 * std::sqrt(a.variance[c] + b.variance[c]) + 1e-6 * std::abs(a.mean[c]);
        EXPECT_NEAR(a.mean[c], b.mean[c], allowed) << what << " " << c;
        EXPECT_LT(allowed, 0.25 * a.mean[c] + 1e-9) << what << ": the check says nothing";
    }
}

TEST(LightImages, QuadratureAndSamplingAgreeForEveryModel) {
    for (const Brdf& brdf : allBrdfs()) {
        if (!brdf.traits.scattersLight) continue;
        Bench bench(brdf.name, colored());
        expectEqual(bench.integrate(Method::automatic, 2), bench.integrate(Method::sampled, 5), brdf.name);
    }
}

TEST(LightImages, OneColorIsALightOfThatColor) {
    for (const char* model : {"lambert", "ggx", "phong"}) {
        Bench bench(model, bitmapOf(5, 2, [](int, int) { return glm::vec3(0.5, 0.25, 2.0); }));
        const Estimate shown = bench.integrate(Method::automatic, 0);
        bench.scene.lights[0].image = -1;
        bench.scene.lights[0].intensity *= glm::dvec3(0.5, 0.25, 2.0);
        const Estimate plain = bench.integrate(Method::automatic, 0);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(shown.mean[c], plain.mean[c], 1e-6 * plain.mean[c]) << model;
    }
}

/// A midpoint sum over the rect by area, written out: which way round the image is follows from the scene
/// format alone.
TEST(LightImages, TheImageIsWhereTheFormatSays) {
    Bench bench("lambert", colored());
    Light& light = bench.scene.lights[0];
    light.position = {0.1, 0.3, 0.9};
    // A node without rotation shines along -Z, its local X and Y are the world's.
    light.direction = {0, 0, -1};
    light.axis = {1, 0, 0};
    const LightImage image(bench.scene.images[0]);
    constexpr int kSteps = 400;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double x = (i + 0.5) / kSteps - 0.5, y = (j + 0.5) / kSteps - 0.5;
            const glm::dvec3 place = light.position + glm::dvec3(x * light.width, y * light.height, 0.0);
            const double d2 = glm::dot(place, place);
            // Seen from below, looking up along +Z with +Y up, +X is on the left; the first row is the top.
            sum += image.at({0.5 - x, 0.5 - y}) * (place.z * place.z / (d2 * d2));
        }
    const glm::dvec3 diffuse(bench.values[0], bench.values[1], bench.values[2]);
    const glm::dvec3 expected = diffuse / 3.14159265358979323846 * light.intensity * sum * light.width *
                                light.height / (1.0 * kSteps * kSteps);
    const Estimate got = bench.integrate(Method::automatic, 0);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(got.mean[c], expected[c], 2e-5 * expected[c]) << c;
}

TEST(LightImages, AMirrorShowsThePlaceThatItsRayMeets) {
    Bench bench("mirror", colored());
    Light& light = bench.scene.lights[0];
    const glm::dvec2 at(0.3, 0.7);
    const glm::dvec3 target = light.position + (0.5 - at.x) * light.width * light.axis +
                              (at.y - 0.5) * light.height * glm::cross(light.direction, light.axis);
    const glm::dvec3 toLight = glm::normalize(target);
    bench.point.toEye = {-toLight.x, -toLight.y, toLight.z};
    const glm::dvec3 expected = bench.brdf.mirror(toLight.z, bench.values) * light.intensity *
                                LightImage(bench.scene.images[0]).at(at);
    const Estimate got = bench.integrate(Method::automatic, 0);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(got.mean[c], expected[c], 1e-9);
}

TEST(LightImages, ShadowsCutThePartThatIsHidden) {
    for (const char* model : {"lambert", "ggx", "phong"}) {
        Bench bench(model, colored());
        const Visibility half = [](const glm::dvec3& d, double) { return d.x > -0.2 ? 1.0 : 0.0; };
        expectEqual(bench.integrate(Method::automatic, 5, half), bench.integrate(Method::sampled, 6, half),
                    model);
    }
}

TEST(LightImages, DrawsHaveTheDensityThatIsSaid) {
    const BodyImage image(bitmapOf(5, 4, [](int x, int y) {
        return glm::vec3(x == 3 && y == 1 ? 50.0F : 0.01F * static_cast<float>(x));
    }));
    // The mean of 1 / density over draws is the area of where they can be, here all of the square but what is
    // black.
    Pcg32 random(3);
    double sum = 0.0, moment = 0.0;
    constexpr int kDraws = 200000;
    for (int i = 0; i < kDraws; ++i) {
        const double u = random.uniform(), v = random.uniform();
        const glm::dvec2 at = image.draw(u, v);
        const double density = image.density(at);
        ASSERT_GT(density, 0.0);
        sum += 1.0 / density / kDraws;
        moment += at.x / density / kDraws;
    }
    EXPECT_NEAR(sum, 1.0, 0.05);
    EXPECT_NEAR(moment, 0.5, 0.03);
}

TEST(LightImages, ABrightTexelIsFoundAndBlackOnesAreDark) {
    // 64 x 64 texels are more parts than quadrature takes.
    const auto bright = [](int x, int y) { return glm::vec3(x == 40 && y == 20 ? 1e6F : 0.0F); };
    for (const char* model : {"lambert", "ggx"}) {
        Bench bench(model, bitmapOf(64, 64, bright));
        const Estimate got = bench.integrate(Method::automatic, 6);
        // A texel so small is a point of its solid angle.
        const Light& light = bench.scene.lights[0];
        const glm::dvec3 place = light.position + (0.5 - 40.5 / 64) * light.width * light.axis +
                                 (20.5 / 64 - 0.5) * light.height * glm::cross(light.direction, light.axis);
        const double d = glm::length(place);
        const glm::dvec3 wi = place / d;
        const double solid = light.width * light.height / 4096 * -glm::dot(wi, light.direction) / (d * d);
        const glm::dvec3 f = bench.brdf.fCos(Directions(wi, bench.point.toEye), bench.point.values);
        const glm::dvec3 expected = 1e6 * f * light.intensity * solid;
        for (int c = 0; c < 3; ++c) {
            // The texel is a hundredth of a radian wide.
            const double allowed = 5.5 * std::sqrt(got.variance[c]) + 1e-3 * expected[c];
            EXPECT_NEAR(got.mean[c], expected[c], allowed) << model;
            EXPECT_LT(allowed, 0.03 * expected[c]) << model;
        }
        bench.scene.images[0] = bitmapOf(64, 64, [](int, int) { return glm::vec3(0.0); });
        EXPECT_EQ(bench.integrate(Method::automatic, 1).mean, glm::dvec3(0.0));
    }
}

}  // namespace
}  // namespace lobe::reference
