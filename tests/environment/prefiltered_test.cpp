#include "environment/prefiltered.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "environment/harmonics.hpp"
#include "environment/pictures.hpp"
#include "environment/split_table.hpp"
#include "math/random.hpp"
#include "math/sphere.hpp"
#include "scene/environment_picture.hpp"
#include "shading/sampling.hpp"

namespace lobe::environment {
namespace {

using test::directionPicture;
using test::floatPicture;
using test::mapOf;

constexpr double kPi = std::numbers::pi;

/// By a sum over a fine grid of directions.
glm::dvec3 blurredByGrid(const EnvironmentMap& map, const glm::dvec3& axis, const ZonalKernel& kernel) {
    constexpr int kHeight = 512;
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < 2 * kHeight; ++x) {
            const double theta = kPi * (y + 0.5) / kHeight;
            const glm::dvec3 d = fromPolar(theta, kPi * (x + 0.5) / kHeight);
            const glm::vec3 away(axis - d);
            const double weight = static_cast<double>(kernel.at(glm::dot(away, away))) * std::sin(theta);
            sum += weight * map.relative(d);
            weights += weight;
        }
    return sum / weights;
}

ZonalKernel ggx(double alpha) {
    return ZonalKernel([=](double angle) {
        const double half = angle / 2.0, c = std::cos(half), s = std::sin(half),
                     q = s * s / (alpha * alpha) + c * c;
        return angle < kPi / 2 ? std::cos(angle) / (q * q) : 0.0;
    });
}

TEST(ZonalKernel, IntegratesToOneAndKnowsItsSpread) {
    const ZonalKernel cosine([](double angle) { return std::max(std::cos(angle), 0.0); });
    EXPECT_NEAR(static_cast<double>(cosine.at(0.0F)), 1.0 / kPi, 1e-3);
    EXPECT_NEAR(cosine.spread(), std::sqrt(2.0 * (1.0 - 2.0 / 3.0)), 2e-3);
    const ZonalKernel narrow([](double angle) { return std::exp(-0.5 * angle * angle / 1e-4); });
    EXPECT_NEAR(narrow.spread(), std::sqrt(2.0) * 1e-2, 1e-4);
}

/// Squares of a tree are points: the error is that of the sum, which is checked against a grid 4 times as
/// fine as the kernel is wide.
TEST(RadianceTree, BlursAsASumOverTheSphere) {
    const Bitmap picture = directionPicture(256, 128, test::skyWithLamps);
    const EnvironmentMap map = mapOf(picture);
    const RadianceTree tree(map);
    Pcg32 random(3);
    for (double alpha : {0.1, 0.3, 1.0}) {
        const ZonalKernel kernel = ggx(alpha);
        for (int i = 0; i < 6; ++i) {
            const glm::dvec3 axis = uniformSphere({random.uniform(), random.uniform()});
            const glm::dvec3 expected = blurredByGrid(map, axis, kernel);
            const glm::dvec3 got = tree.blurred(glm::vec3(axis), kernel);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(got[c], expected[c], 0.02 * expected[c] + 0.005)
                    << alpha << " " << axis.x << " " << axis.y;
        }
    }
}

TEST(RadianceTree, AConstantStays) {
    Environment environment;
    environment.radiance = {1, 2, 3};
    const RadianceTree tree(EnvironmentMap(environment, nullptr));
    for (double alpha : {1e-4, 0.05, 1.0}) {
        const glm::dvec3 got = tree.blurred({0.0F, 0.6F, 0.8F}, ggx(alpha));
        EXPECT_NEAR(got.x, 1.0, 1e-6);
    }
}

/// One texel of 1e6 in a black map, near a pole and at the seam: its power arrives, whatever the kernel.
TEST(RadianceTree, KeepsThePowerOfOneTexel) {
    for (const auto& [tx, ty] : {std::pair(100, 40), std::pair(0, 31), std::pair(5, 1)}) {
        const Bitmap picture =
            floatPicture(128, 64, [&](int x, int y) { return glm::vec3(x == tx && y == ty ? 1e6F : 0.0F); });
        const EnvironmentMap map = mapOf(picture);
        const RadianceTree tree(map);
        // Bilinear: by quadrature over the texels about it.
        double power = 0.0;
        constexpr int kSub = 32;
        for (int j = -kSub; j < 2 * kSub; ++j)
            for (int i = -kSub; i < 2 * kSub; ++i) {
                const double phi = 2.0 * kPi * (tx + (i + 0.5) / kSub) / 128.0;
                const double theta = kPi * (ty + (j + 0.5) / kSub) / 64.0;
                if (theta < 0.0) continue;
                const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta),
                                   -std::sin(theta) * std::cos(phi));
                power += map.relative(d).x * std::sin(theta) * 2.0 * kPi / 128.0 / kSub * kPi / 64.0 / kSub;
            }
        double got = 0.0;
        for (const RadianceTree::Node& node : tree.finest())
            got += static_cast<double>(node.energy.x);
        EXPECT_NEAR(got / power, 1.0, 0.02) << tx << " " << ty;
        EXPECT_NEAR(tree.mean().x * 4.0 * kPi / power, 1.0, 0.02);
    }
}

TEST(Harmonics, OfALinearSkyAreExact) {
    // Radiance 1 + 0.8 d.y: irradiance / pi is 1 + 0.8 (2 / 3) n.y.
    const Bitmap picture =
        directionPicture(256, 128, [](const glm::dvec3& d) { return glm::vec3(1.0 + 0.8 * d.y); });
    const RadianceTree tree(mapOf(picture));
    for (int order : {2, 4}) {
        const auto harmonics = irradianceHarmonics(tree, order);
        Pcg32 random(1);
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 n = uniformSphere({random.uniform(), random.uniform()});
            EXPECT_NEAR(irradianceAt(harmonics, n).x, 1.0 + 0.8 * 2.0 / 3.0 * n.y, 3e-3);
        }
    }
}

/// A small sun alone makes the plain sum negative behind it.
TEST(Harmonics, AreNowhereNegative) {
    const Bitmap picture =
        floatPicture(64, 32, [](int x, int y) { return glm::vec3(x == 20 && y == 9 ? 1e6F : 0.0F); });
    const RadianceTree tree(mapOf(picture));
    for (int order : {2, 4}) {
        const auto harmonics = irradianceHarmonics(tree, order);
        Pcg32 random(1);
        double mean = 0.0, most = 0.0;
        constexpr int kCount = 4000;
        for (int i = 0; i < kCount; ++i) {
            const double value =
                irradianceAt(harmonics, uniformSphere({random.uniform(), random.uniform()})).x;
            EXPECT_GE(value, -2e-3 * tree.mean().x);
            mean += value / kCount;
            most = std::max(most, value);
        }
        EXPECT_NEAR(mean, tree.mean().x, 0.05 * tree.mean().x);
        EXPECT_GT(most, 2.0 * mean);  // still a light from one side; the exact one has 4
    }
}

/// The directional albedo, by another seed's draws of the whole model.
TEST(SplitTable, AlbedoIsTheModels) {
    for (const char* name : {"metallic_roughness", "cook_torrance", "phong", "ward", "ashikhmin_shirley"}) {
        const Brdf& brdf = requireBrdf(name);
        const ParameterValues values = brdf.fromMetallicRoughness({glm::dvec3(0.8), 0.3, 0.5});
        const auto nodes = splitNodes(brdf, values);
        const AreaWeights weights = brdf.area->weights(values);
        for (int n : {10, 20, 30, 39}) {
            const double c = cosineOfNode(n);
            const glm::dvec3 wo(std::sqrt(1.0 - c * c), 0.0, c);
            const SamplingMixture mixture = BrdfSampler(brdf, values).at(wo);
            Pcg32 random(7);
            double sum = 0.0;
            constexpr int kCount = 40000;
            for (int i = 0; i < kCount; ++i) {
                const glm::dvec3 wi =
                    sampleDirection(mixture, random.uniform(), random.uniform(), random.uniform());
                if (wi.z > 0.0) sum += brdf.fCos(Directions(wi, wo), values).x / samplingDensity(mixture, wi);
            }
            const SplitNode& node = nodes[static_cast<size_t>(n)];
            const double split = weights.lambert.x * node.base + weights.terms[0].x * node.albedo[0].x +
                                 weights.terms[1].x * node.albedo[1].x;
            EXPECT_NEAR(split, sum / kCount, 0.02 * sum / kCount) << name << " " << c;
        }
    }
}

Request requestFor(const char* model, bool varies) {
    const Brdf& brdf = requireBrdf(model);
    Request request;
    request.lobe = {&brdf, brdf.fromMetallicRoughness({glm::dvec3(0.8), 1.0, 0.4}), true, varies};
    if (varies) request.widths = {0.05, 1.0};
    return request;
}

TEST(Prefiltered, LayersRunFromNarrowToWideAndAreKept) {
    const Bitmap picture = directionPicture(128, 64, test::skyWithLamps);
    const EnvironmentMap map = mapOf(picture);
    const RadianceTree tree(map);
    const Request request = requestFor("metallic_roughness", true);
    const Prefiltered made = prefiltered(tree, request);
    ASSERT_GE(made.layers.size(), 4U);
    ASSERT_LE(made.layers.size(), kMostLayers);
    for (size_t i = 1; i < made.layers.size(); ++i)
        EXPECT_LE(made.layers[i].size, made.layers[i - 1].size);
    for (float value : made.texels)
        ASSERT_TRUE(std::isfinite(value));

    const auto folder = std::filesystem::temp_directory_path() / "lobe_environment_test";
    std::filesystem::remove_all(folder);
    const Cache cache(folder);
    const std::string key = keyOf(map, request);
    EXPECT_FALSE(cache.find(key));
    cache.keep(key, made);
    const auto found = cache.find(key);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->texels, made.texels);
    EXPECT_EQ(found->layers.size(), made.layers.size());
    EXPECT_FALSE(cache.find(keyOf(map, requestFor("ward", false))));
    std::filesystem::resize_file(folder / (key + ".env"), 4000);
    EXPECT_FALSE(cache.find(key));
    std::filesystem::remove_all(folder);
}

TEST(Prefiltered, OneWidthTakesFewLayers) {
    const Bitmap picture = directionPicture(64, 32, test::skyWithLamps);
    const RadianceTree tree(mapOf(picture));
    EXPECT_LE(prefiltered(tree, requestFor("metallic_roughness", false)).layers.size(), 4U);
    EXPECT_EQ(prefiltered(tree, requestFor("lambert", false)).layers.size(), 0U);
}

/// What each layout's square about +X shows is seen towards +X.
TEST(Pictures, OfCubesShowTheirFacesWhereTheyBelong) {
    const auto plain = [](int side, float value) {
        return floatPicture(side, side, [=](int, int) { return glm::vec3(value); });
    };
    const Bitmap faces = fromCubeFaces(
        {plain(8, 1), plain(8, 2), plain(8, 3), plain(8, 4), plain(8, 5), plain(8, 6)}, "faces");
    // A cross whose squares hold column + 10 row.
    const auto cross = [](int columns, int rows) {
        return floatPicture(columns * 8, rows * 8,
                            [](int x, int y) { return glm::vec3(x / 8 + 10 * (y / 8)); });
    };
    const glm::dvec3 directions[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    const Bitmap lying = fromCubeCross(cross(4, 3)), standing = fromCubeCross(cross(3, 4));
    const double inLying[] = {10, 12, 1, 21, 11, 13}, inStanding[] = {10, 12, 1, 21, 11, 31};
    for (size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(mapOf(faces).relative(directions[i]).x, static_cast<double>(i + 1), 1e-5);
        EXPECT_NEAR(mapOf(lying).relative(directions[i]).x, inLying[i], 1e-4) << i;
        EXPECT_NEAR(mapOf(standing).relative(directions[i]).x, inStanding[i], 1e-4) << i;
    }
}

/// A smooth function of direction survives the way through each layout: no face is mirrored or turned.
TEST(Pictures, OfCubesKeepOrientation) {
    const auto f = [](const glm::dvec3& d) {
        return glm::vec3(1.0 + 0.5 * d.x, 1.0 + 0.5 * d.y, 1.0 + 0.5 * d.z);
    };
    // OpenGL's cube maps (specification 3.3, table 3.19): sc, tc and ma of each face.
    const auto face = [&](int index) {
        return floatPicture(32, 32, [&](int x, int y) {
            const double s = (x + 0.5) / 16.0 - 1.0, t = (y + 0.5) / 16.0 - 1.0;
            const glm::dvec3 d[] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t},
                                    {s, -1, -t}, {s, -t, 1},  {-s, -t, -1}};
            return f(glm::normalize(d[index]));
        });
    };
    const Bitmap whole = fromCubeFaces({face(0), face(1), face(2), face(3), face(4), face(5)}, "faces");
    const EnvironmentMap map = mapOf(whole);
    Pcg32 random(2);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 d = uniformSphere({random.uniform(), random.uniform()});
        EXPECT_LT(glm::length(map.relative(d) - glm::dvec3(f(d))), 0.03);
    }
}

}  // namespace
}  // namespace lobe::environment
