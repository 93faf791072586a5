// Where shadow maps look (engine/passes/shadow_fit.hpp), and the bias that lets no plane shadow itself.
#include "passes/shadow_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "plan/shadow_layout.hpp"
#include "support/scenes.hpp"

namespace lobe::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSize = 512;
constexpr ShadowFilter kFilter{4};

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double uniform(double low, double high) { return std::uniform_real_distribution<>(low, high)(engine_); }
    glm::dvec3 unit() {
        for (;;) {
            const glm::dvec3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            const double length = glm::length(v);
            if (length > 0.1 && length < 1.0) return v / length;
        }
    }

private:
    std::mt19937 engine_;
};

/// A ground of the given half size about `center`, and balls over it.
Scene ballsOnGround(const glm::dvec3& center, double half, int balls, Random& random) {
    Scene scene;
    const int material = addMaterial(scene, "lambert");
    const int quad = addQuad(scene, material, 1.0f);
    const int sphere = addSphere(scene, material, 8);
    const glm::dmat4 place = glm::translate(glm::dmat4(1.0), center);
    addInstance(scene, quad,
                place * glm::rotate(glm::dmat4(1.0), -0.5 * kPi, glm::dvec3(1, 0, 0)) *
                    glm::scale(glm::dmat4(1.0), glm::dvec3(half)));
    for (int i = 0; i < balls; ++i) {
        const double radius = half * random.uniform(0.02, 0.1);
        const glm::dvec3 at(half * random.uniform(-0.9, 0.9), radius * random.uniform(0.5, 3.0),
                            half * random.uniform(-0.9, 0.9));
        addInstance(scene, sphere,
                    place * glm::scale(glm::translate(glm::dmat4(1.0), at), glm::dvec3(radius)));
    }
    return scene;
}

/// All vertices of what casts, and of everything.
std::vector<glm::dvec3> vertices(const Scene& scene, bool castersOnly) {
    std::vector<glm::dvec3> points;
    for (const Instance& instance : scene.instances)
        if (instance.castsShadow || !castersOnly)
            for (const glm::vec3& p : scene.primitives[static_cast<size_t>(instance.primitive)].positions)
                points.emplace_back(instance.worldFromLocal * glm::dvec4(p, 1.0));
    return points;
}

/// A point of a random triangle.
glm::dvec3 surfacePoint(const Scene& scene, Random& random) {
    const auto below = [&](size_t count) {
        return static_cast<size_t>(random.uniform(0.0, static_cast<double>(count)));
    };
    const Instance& instance = scene.instances[below(scene.instances.size())];
    const Primitive& primitive = scene.primitives[static_cast<size_t>(instance.primitive)];
    const size_t triangle = below(primitive.triangleCount());
    double u = random.uniform(0, 1), v = random.uniform(0, 1);
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    const auto corner = [&](size_t i) {
        return glm::dvec3(primitive.positions[primitive.indices[3 * triangle + i]]);
    };
    const glm::dvec3 local = corner(0) * (1.0 - u - v) + corner(1) * u + corner(2) * v;
    return glm::dvec3(instance.worldFromLocal * glm::dvec4(local, 1.0));
}

bool isSeen(const View& view, const glm::dvec3& world) {
    const glm::dvec4 clip = view.clipFromRelative * glm::dvec4(world - view.eye, 1.0);
    return clip.w > 0.0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && clip.z <= clip.w &&
           clip.z >= 0.0;
}

const ShadowProjection& mapAt(const DirectionalMaps& maps, double z) {
    size_t i = 0;
    while (i + 1 < maps.maps.size() && z >= maps.ends[i])
        ++i;
    return maps.maps[i];
}

struct Checked {
    int seen = 0, inside = 0;
};

/// Every receiver that is seen and that a caster could shadow is in its map with the guard about it; every
/// caster lies between the map's ends.
Checked checkFit(const Scene& scene, const glm::dvec3& direction, const View& view, Random& random) {
    const DirectionalMaps fit = DirectionalFit(scene, direction).fit(view, kSize, kFilter);
    const int size = fit.maps.size() == 1 ? kSize : kSize / 2;
    const std::vector<glm::dvec3> casters = vertices(scene, true);
    glm::dvec2 low(1e300), high(-1e300);
    for (const glm::dvec3& caster : casters) {
        const glm::dvec2 across(glm::dot(fit.maps[0].x, caster - fit.maps[0].origin),
                                glm::dot(fit.maps[0].y, caster - fit.maps[0].origin));
        low = glm::min(low, across);
        high = glm::max(high, across);
        for (const ShadowProjection& map : fit.maps) {
            if (map.empty) continue;
            const double depth = shadowCoordinates(map, caster - map.origin).z;
            EXPECT_GT(depth, 0.0);
            EXPECT_LT(depth, 1.0);
        }
    }
    Checked checked;
    for (int i = 0; i < 4000; ++i) {
        const glm::dvec3 point = surfacePoint(scene, random);
        if (!isSeen(view, point)) continue;
        ++checked.seen;
        const glm::dvec2 across(glm::dot(fit.maps[0].x, point - fit.maps[0].origin),
                                glm::dot(fit.maps[0].y, point - fit.maps[0].origin));
        const double slack = 1e-9 * glm::length(high - low);
        if (across.x < low.x + slack || across.x > high.x - slack || across.y < low.y + slack ||
            across.y > high.y - slack)
            continue;  // beside all casters: lit whatever the map says
        ++checked.inside;
        const ShadowProjection& map = mapAt(fit, glm::dot(point - view.eye, view.forward));
        EXPECT_FALSE(map.empty);
        const glm::dvec3 at = shadowCoordinates(map, point - map.origin);
        const double most = 0.5 * size - kFilter.guard() + 1e-6;
        EXPECT_LE(std::abs(at.x), most);
        EXPECT_LE(std::abs(at.y), most);
        EXPECT_GT(at.z, 0.0);
        EXPECT_LT(at.z, 1.0);
    }
    return checked;
}

TEST(DirectionalFit, HoldsWhatIsSeenAndWhatCasts) {
    Random random(1);
    int seen = 0, inside = 0, cascaded = 0;
    for (int i = 0; i < 60; ++i) {
        const double half = std::pow(10.0, random.uniform(-3.0, 4.0));
        const glm::dvec3 center = random.unit() * (i % 3 == 0 ? 1e6 : 0.0);
        const Scene scene = ballsOnGround(center, half, 12, random);
        glm::dvec3 eye = center + random.unit() * half * random.uniform(0.3, 3.0);
        eye.y = center.y + std::abs(eye.y - center.y) + 0.05 * half;
        Camera camera = lookAt(eye, center, 0.8);
        if (i % 4 == 1) {
            camera.orthographic = true;
            camera.xMag = camera.yMag = half * random.uniform(0.2, 2.0);
        }
        fitDepthRange(camera, scene.bounds());
        const View view = makeView(camera, 160, 120);
        const glm::dvec3 direction = glm::normalize(random.unit() + glm::dvec3(0, -1.2, 0));
        const Checked checked = checkFit(scene, direction, view, random);
        seen += checked.seen;
        inside += checked.inside;
        cascaded += DirectionalFit(scene, direction).fit(view, kSize, kFilter).maps.size() > 1 ? 1 : 0;
    }
    EXPECT_GT(seen, 20000);
    EXPECT_GT(inside, 10000);
    EXPECT_GT(cascaded, 5);
    EXPECT_LT(cascaded, 55);
}

TEST(DirectionalFit, TexelsAreTheCastersExtentOverTheSize) {
    Scene scene;
    const int quad = addQuad(scene, addMaterial(scene, "lambert"), 2.0f);
    addInstance(scene, quad);
    Camera camera = lookAt({0, 0, 10}, {0, 0, 0}, 1.0);
    const View view = makeView(camera, 64, 64);
    const DirectionalMaps fit = DirectionalFit(scene, {0, 0, -1}).fit(view, kSize, kFilter);
    ASSERT_EQ(fit.maps.size(), 1u);
    EXPECT_NEAR(fit.maps[0].texel.x, 4.0 / (kSize - 2 * kFilter.guard()), 1e-12);
    EXPECT_NEAR(fit.maps[0].texel.y, 4.0 / (kSize - 2 * kFilter.guard()), 1e-12);
}

TEST(DirectionalFit, IsCroppedToWhatIsSeen) {
    Scene scene;
    const int quad = addQuad(scene, addMaterial(scene, "lambert"), 100.0f);
    addInstance(scene, quad);
    const View view = makeView(lookAt({3, 4, 10}, {3, 4, 0}, 0.2), 64, 64);
    const DirectionalMaps fit = DirectionalFit(scene, {0, 0, -1}).fit(view, kSize, kFilter);
    const double seen = 2.0 * 10.0 * std::tan(0.1) * 66.0 / 64.0;  // with a pixel on each side
    EXPECT_NEAR(fit.maps[0].texel.x * (kSize - 2 * kFilter.guard()), seen, 1e-9);
}

TEST(DirectionalFit, StaysForJitteredSamplesAndForCamerasThatSeeAllCasters) {
    Random random(2);
    Scene scene = ballsOnGround({0, 0, 0}, 1.0, 5, random);
    const DirectionalFit fit(scene, glm::normalize(glm::dvec3(0.3, -1, 0.2)));
    const Camera camera = lookAt({0.5, 1, 4}, {0, 0, 0}, 0.8);
    const auto origin = [&](const View& view) { return fit.fit(view, kSize, kFilter).maps[0].origin; };
    const glm::dvec3 first = origin(makeView(camera, 64, 64));
    EXPECT_EQ(first, origin(makeView(camera, 64, 64, {0.3, -0.4})));
    EXPECT_EQ(first, origin(makeView(lookAt({-0.5, 1, 4}, {0, 0, 0}, 0.8), 64, 64)));
    EXPECT_NE(first, origin(makeView(lookAt({0.5, 0.5, 1}, {0.2, 0, 0}, 0.3), 64, 64)));
}

TEST(DirectionalFit, DeepScenesHaveCascadesThatAreFinerOnTheScreen) {
    Random random(3);
    const Scene scene = ballsOnGround({0, 0, 0}, 1000.0, 40, random);
    Camera camera = lookAt({0, 2, 900}, {0, 0, 850}, 0.8);
    camera.zNear = 0.1;
    const View view = makeView(camera, 640, 360);
    const DirectionalMaps fit =
        DirectionalFit(scene, glm::normalize(glm::dvec3(0.5, -1, 0.2))).fit(view, kSize, kFilter);
    ASSERT_EQ(fit.maps.size(), 4u);
    EXPECT_LT(fit.ends[0], fit.ends[1]);
    EXPECT_LT(fit.ends[1], fit.ends[2]);
    EXPECT_LT(fit.maps[0].texel.x, 0.1 * fit.maps[3].texel.x);
}

TEST(DirectionalFit, NothingSeenOrNothingThatCastsIsAnEmptyMap) {
    Random random(4);
    Scene scene = ballsOnGround({0, 0, 0}, 1.0, 3, random);
    const View away = makeView(lookAt({0, 1, 4}, {0, 1, 8}, 0.8), 64, 64);
    EXPECT_TRUE(DirectionalFit(scene, {0, -1, 0}).fit(away, kSize, kFilter).maps[0].empty);
    for (Instance& instance : scene.instances)
        instance.castsShadow = false;
    const View view = makeView(lookAt({0, 1, 4}, {0, 0, 0}, 0.8), 64, 64);
    EXPECT_TRUE(DirectionalFit(scene, {0, -1, 0}).fit(view, kSize, kFilter).maps[0].empty);
}

TEST(SpotFit, HoldsTheConeOfAnyAngle) {
    Random random(5);
    for (const double outer : {0.0, 1e-6, 0.01, 0.5, 1.1}) {
        const Light light = spot(random.unit() * 1e6, random.unit(), {1, 1, 1}, 0.0, outer);
        ASSERT_FALSE(needsCube(light));
        const ShadowProjection map = fitSpot(light, 1.0, kSize, kFilter);
        for (int i = 0; i < 2000; ++i) {
            const double angle = outer * random.uniform(0.0, 1.0), turn = random.uniform(0.0, 2.0 * kPi);
            const glm::dvec3 at =
                std::cos(angle) * map.z + std::sin(angle) * (std::cos(turn) * map.x + std::sin(turn) * map.y);
            const glm::dvec3 t = shadowCoordinates(map, at * random.uniform(0.1, 100.0));
            ASSERT_TRUE(std::isfinite(t.x) && std::isfinite(t.y) && t.z > 0.0 && t.z < 1.0);
            EXPECT_LE(std::max(std::abs(t.x), std::abs(t.y)), 0.5 * kSize - kFilter.guard() + 1e-6);
        }
    }
    EXPECT_TRUE(needsCube(spot({0, 0, 0}, {1, 0, 0}, {1, 1, 1}, 0.0, 0.5 * kPi)));
    EXPECT_TRUE(needsCube(spot({0, 0, 0}, {1, 0, 0}, {1, 1, 1}, 0.0, 1.2)));
}

TEST(CubeFace, FacesHoldAllDirections) {
    Random random(6);
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec3 d = random.unit();
        int holding = 0;
        for (int face = 0; face < 6; ++face) {
            const ShadowProjection map = cubeFace({1, 2, 3}, face, 1.0, kSize, kFilter);
            if (glm::dot(map.z, d) < std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)})) continue;
            const glm::dvec3 t = shadowCoordinates(map, d * random.uniform(0.01, 100.0));
            EXPECT_LE(std::max(std::abs(t.x), std::abs(t.y)), 0.5 * kSize - kFilter.guard() + 1e-6);
            ++holding;
        }
        EXPECT_GE(holding, 1);
    }
}

TEST(ShadowView, DrawsWhereTheLookUpReads) {
    Random random(7);
    ShadowProjection parallel;
    parallel.texel = {0.02, 0.03};
    parallel.reach = 7.0;
    for (const ShadowProjection& map :
         {parallel, cubeFace({1, 2, 3}, 3, 1.0, kSize, kFilter),
          fitSpot(spot({0, 0, 0}, {1, 2, 3}, {1, 1, 1}, 0.1, 0.7), 1.0, kSize, kFilter)}) {
        const View view = shadowView(map, kSize);
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 p = map.z * random.uniform(0.1, 5.0) + random.unit() * 0.09;
            const glm::dvec4 clip = view.clipFromRelative * glm::dvec4(p, 1.0);
            const glm::dvec3 t = shadowCoordinates(map, p);
            EXPECT_NEAR(clip.x / clip.w * 0.5 * kSize, t.x, 1e-9 * kSize);
            EXPECT_NEAR(clip.y / clip.w * 0.5 * kSize, t.y, 1e-9 * kSize);
            EXPECT_NEAR(clip.z / clip.w, t.z, 1e-12);
        }
    }
}

/// Whether a plane through `position` shadows its own point, moved by `scale` times the bound: some texel
/// centre that the filter may read, stored exactly, is nearer to the light. Positions are relative to the
/// map's origin.
bool shadowsItself(const ShadowProjection& map, const glm::dvec3& position, const glm::dvec3& normal,
                   double scale) {
    const double radius = kFilter.radius();
    const glm::dvec3 moved = position + normal * (scale * normalOffset(map, position, normal, radius));
    const glm::dvec3 at = shadowCoordinates(map, moved);
    for (const double dx : {-radius, radius})
        for (const double dy : {-radius, radius}) {
            // The ray (or parallel) of the texel meets the plane.
            const glm::dvec2 across = map.texel * glm::dvec2(at.x + dx, at.y + dy);
            double stored = 0.0;
            if (map.perspective) {
                const glm::dvec3 ray = map.z + map.x * across.x + map.y * across.y;
                stored = map.reach * glm::dot(normal, ray) / glm::dot(normal, position);
            } else {
                const glm::dvec3 start = map.x * across.x + map.y * across.y;
                stored = 1.0 - glm::dot(normal, position - start) / glm::dot(normal, map.z) / map.reach;
            }
            // Nearly edge-on, doubles round what is divided by the cosine.
            if (stored > at.z * (1.0 + 1e-12) + 1e-14 / std::abs(glm::dot(normal, map.z))) return true;
        }
    return false;
}

TEST(NormalOffset, IsEnoughForPlanesOfAllSlopesAndNoMoreThanEnough) {
    Random random(8);
    int tooLittle = 0, total = 0;
    for (int i = 0; i < 40000; ++i) {
        ShadowProjection map;
        if (i % 2 == 0) {
            map = cubeFace({0, 0, 0}, i % 6, 1.0, kSize, kFilter);
        } else {
            map.texel = {random.uniform(1e-3, 1e-1), random.uniform(1e-3, 1e-1)};
            map.reach = 100.0;
        }
        const glm::dvec3 position = (map.z + map.x * random.uniform(-1, 1) + map.y * random.uniform(-1, 1)) *
                                    std::pow(10.0, random.uniform(-2, 1.5));
        // Facing the light, from full on to a thousandth of a degree from edge-on.
        const glm::dvec3 toLight = map.perspective ? -glm::normalize(position) : -map.z;
        const glm::dvec3 aside = glm::normalize(glm::cross(toLight, random.unit()));
        const double angle = 0.5 * kPi * (1.0 - std::pow(10.0, random.uniform(-5.0, 0.0)));
        const glm::dvec3 normal = std::cos(angle) * toLight + std::sin(angle) * aside;
        EXPECT_FALSE(shadowsItself(map, position, normal, 1.0)) << i << " angle " << angle;
        ++total;
        tooLittle += shadowsItself(map, position, normal, 0.9) ? 1 : 0;
        const double w =
            (map.perspective ? glm::dot(map.z, position) : 1.0) * std::max(map.texel.x, map.texel.y);
        const double most = 1.4143 * kFilter.radius() * w;
        EXPECT_LE(normalOffset(map, position, normal, kFilter.radius()),
                  map.perspective ? 1.02 * most : most);
    }
    EXPECT_GT(tooLittle, total / 2);
}

TEST(ShadowLayout, TilesOfAllLightsAreApart) {
    const PlannedShadowMaps maps{1024, 3, 5, 4};
    EXPECT_EQ(maps.layers(), 3 + 8);
    std::vector<ShadowTile> tiles;
    for (int i = 0; i < maps.whole; ++i)
        tiles.push_back(wholeTile(maps, i));
    for (int cube = 0; cube < maps.cubes; ++cube)
        for (int face = 0; face < 6; ++face)
            tiles.push_back(cubeTile(maps, cube, face));
    for (size_t i = 0; i < tiles.size(); ++i) {
        EXPECT_GE(tiles[i].x, 0);
        EXPECT_LE(tiles[i].x + tiles[i].size, maps.size);
        EXPECT_LE(tiles[i].y + tiles[i].size, maps.size);
        EXPECT_LT(tiles[i].layer, maps.layers());
        for (size_t j = 0; j < i; ++j) {
            const ShadowTile &a = tiles[i], &b = tiles[j];
            const bool apart = a.layer != b.layer || a.x + a.size <= b.x || b.x + b.size <= a.x ||
                               a.y + a.size <= b.y || b.y + b.size <= a.y;
            EXPECT_TRUE(apart) << i << ' ' << j;
        }
    }
}

TEST(ShadowLayout, FilterSideIsTheLargestSquareOfTheTaps) {
    EXPECT_EQ(filterSide(1), 1);
    EXPECT_EQ(filterSide(3), 1);
    EXPECT_EQ(filterSide(4), 2);
    EXPECT_EQ(filterSide(16), 4);
    EXPECT_EQ(filterSide(24), 4);
    EXPECT_EQ(filterSide(64), 8);
}

}  // namespace
}  // namespace lobe::test
