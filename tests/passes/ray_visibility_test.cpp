// Rays in shaders against brute force in double (shaders/glsl/shadow/rays.glsl).
#include <gtest/gtest.h>

#include <cmath>

#include "math/random.hpp"
#include "math/sphere.hpp"
#include "ray_casting.hpp"
#include "reference/tracer.hpp"
#include "support/scenes.hpp"

namespace lobe::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

glm::dvec3 randomDirection(Pcg32& random) {
    const double u = random.uniform();
    return uniformSphere({u, random.uniform()});
}

glm::dvec3 randomPoint(Pcg32& random) {
    const double x = random.uniform(), y = random.uniform();
    return glm::dvec3(x, y, random.uniform()) * 2.0 - 1.0;
}

/// Triangles of all sizes and shapes, some of them slivers and some without area, within -1..1.
Primitive soup(int count, Pcg32& random) {
    Primitive soup;
    soup.material = 0;
    for (int i = 0; i < count; ++i) {
        const double size = std::exp2(-8.0 * random.uniform());
        const glm::dvec3 center = randomPoint(random) * (1.0 - size);
        const glm::dvec3 along = randomDirection(random) * size;
        const double width = i % 4 == 0 ? std::exp2(-24.0 * random.uniform()) : 1.0;
        glm::dvec3 corners[] = {center - along, center + along,
                                center + width * size * randomDirection(random)};
        if (i % 50 == 0) corners[2] = corners[i % 3];
        for (const glm::dvec3& corner : corners) {
            soup.indices.push_back(static_cast<uint32_t>(soup.positions.size()));
            soup.positions.emplace_back(corner);
            soup.normals.emplace_back(0, 0, 1);
        }
    }
    return soup;
}

/// A ray from within the soup; every eighth along an axis or in a plane of two.
RayQuery randomQuery(Pcg32& random, const glm::dvec3& place, double scale, const glm::dvec3& eye) {
    RayQuery query;
    query.position = glm::vec3(place + randomPoint(random) * scale - eye);
    glm::dvec3 direction = randomDirection(random);
    const uint32_t kind = random.next() % 32;
    if (kind < 3) direction = glm::dvec3(0.0);
    if (kind < 3) direction[static_cast<int>(kind)] = random.uniform() < 0.5 ? -1.0 : 1.0;
    if (kind == 3) direction[static_cast<int>(random.next() % 3)] = 0.0;
    query.direction = glm::vec3(direction);
    query.normal = glm::vec3(glm::normalize(direction));
    query.distance = random.uniform() < 0.3 ? kInfinity : static_cast<float>(2.0 * random.uniform() * scale);
    return query;
}

struct Case {
    const char* name;
    double scale;
    glm::dvec3 place;
    double eyeDistance;  ///< in lengths of `scale`
};

class RaySoups : public testing::TestWithParam<Case> {};

TEST_P(RaySoups, AgreeWithBruteForce) {
    const Case& c = GetParam();
    Pcg32 random(11, 1);
    Scene scene;
    addMaterial(scene, "lambert");
    scene.primitives.push_back(soup(600, random));
    addInstance(scene, 0, glm::scale(glm::translate(glm::dmat4(1.0), c.place), glm::dvec3(c.scale)));
    const View view = viewFrom(c.place + glm::dvec3(0.3, -0.2, 1.0) * (c.eyeDistance * c.scale));
    std::vector<RayQuery> queries;
    for (int i = 0; i < 20000; ++i)
        queries.push_back(randomQuery(random, c.place, c.scale, view.eye));
    const std::vector<float> visible = castRays(scene, view, queries);
    const BruteForce truth(scene);
    const glm::dvec2 error = RayScene(scene, 1 << 27).positionError(view);
    int blocked = 0, tooClose = 0, wrong = 0;
    for (size_t i = 0; i < queries.size(); ++i) {
        const RayQuery& q = queries[i];
        // What projection rounds, and what the offset into the hierarchy's frame does.
        const double tolerance = c.scale * 0x1p-20 + 0x1p-22 * glm::length(view.eye - c.place);
        switch (truth.visibility(startOf(q, view, error), glm::dvec3(q.direction),
                                 static_cast<double>(q.distance), tolerance)) {
            case Truth::tooClose:
                ++tooClose;
                break;
            case Truth::blocked:
                ++blocked;
                wrong += visible[i] != 0.0f;
                break;
            case Truth::visible:
                wrong += visible[i] != 1.0f;
                break;
        }
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(blocked, 2000);
    EXPECT_LT(blocked, 18000);
    EXPECT_LT(tooClose, 400);
}

INSTANTIATE_TEST_SUITE_P(Scales, RaySoups,
                         testing::Values(Case{"metres", 1.0, glm::dvec3(0.0), 2.0},
                                         Case{"atoms", 1e-10, glm::dvec3(0.0), 2.0},
                                         Case{"planets", 1e12, glm::dvec3(0.0), 1.0},
                                         Case{"far_from_the_origin", 1.0, glm::dvec3(1e6, -2e6, 1e6), 3.0},
                                         Case{"seen_from_afar", 1.0, glm::dvec3(0.0), 1000.0}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

/// A closed mesh with vertices that no float hits exactly.
Scene closedSphere(int rings) {
    Scene scene;
    const int sphere = addSphere(scene, addMaterial(scene, "lambert"), rings);
    // Its seam and poles have vertices of their own: made one here, so that it is closed.
    Primitive& mesh = scene.primitives[static_cast<size_t>(sphere)];
    for (int i = 0; i <= rings; ++i) {
        const auto row = static_cast<size_t>(i * (2 * rings + 1));
        for (int j = 0; j <= 2 * rings; ++j)
            if (i == 0 || i == rings || j == 2 * rings)
                mesh.positions[row + static_cast<size_t>(j)] = mesh.positions[row];
    }
    addInstance(
        scene, sphere,
        glm::rotate(glm::scale(glm::dmat4(1.0), glm::dvec3(1.3, 0.7, 2.1)), 0.4, glm::dvec3(0.3, 0.5, 0.8)));
    return scene;
}

TEST(RayVisibility, ClosedMeshesHaveNoHoles) {
    const Scene scene = closedSphere(24);
    const View view = viewFrom(glm::dvec3(0.05, 0.02, 0.1));
    const Primitive& mesh = scene.primitives[0];
    const glm::dmat4& pose = scene.instances[0].worldFromLocal;
    Pcg32 random(12, 1);
    std::vector<RayQuery> queries;
    const auto vertex = [&](uint32_t i) {
        return glm::dvec3(pose * glm::dvec4(glm::dvec3(mesh.positions[i]), 1.0));
    };
    const auto aim = [&](const glm::dvec3& from, const glm::dvec3& to) {
        RayQuery q;
        q.position = glm::vec3(from - view.eye);
        q.direction = glm::vec3(to - view.eye) - q.position;
        q.normal = glm::normalize(q.direction);
        queries.push_back(q);
    };
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            const glm::dvec3 from = randomPoint(random) * 0.3;
            const glm::dvec3 a = vertex(mesh.indices[i + k]), b = vertex(mesh.indices[i + (k + 1) % 3]);
            aim(from, a);
            for (int n = 0; n < 4; ++n)
                aim(from, glm::mix(a, b, random.uniform()));
        }
    int leaks = 0;
    for (const float visible : castRays(scene, view, queries))
        leaks += visible != 0.0f;
    EXPECT_EQ(leaks, 0) << "of " << queries.size();
}

/// A cube of a grid of quads, so that rays along axes run through vertices, along edges and within faces.
Scene gridCube(int cells) {
    Scene scene;
    Primitive cube;
    cube.material = addMaterial(scene, "lambert");
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f})
            for (int i = 0; i < cells; ++i)
                for (int j = 0; j < cells; ++j) {
                    const auto first = static_cast<uint32_t>(cube.positions.size());
                    for (const glm::ivec2& corner :
                         {glm::ivec2(i, j), {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}) {
                        glm::vec3 p(side);
                        p[(axis + 1) % 3] =
                            -1.0f + 2.0f * static_cast<float>(corner.x) / static_cast<float>(cells);
                        p[(axis + 2) % 3] =
                            -1.0f + 2.0f * static_cast<float>(corner.y) / static_cast<float>(cells);
                        cube.positions.push_back(p);
                        cube.normals.emplace_back(0, 0, 1);
                    }
                    for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u})
                        cube.indices.push_back(first + k);
                }
    scene.primitives.push_back(cube);
    addInstance(scene, 0);
    return scene;
}

TEST(RayVisibility, RaysAlongAxesMeetVerticesAndEdges) {
    const Scene scene = gridCube(8);
    const View view = viewFrom(glm::dvec3(0.0));
    std::vector<RayQuery> queries;
    for (int x = -7; x <= 7; ++x)
        for (int y = -7; y <= 7; ++y)
            for (int z = -7; z <= 7; ++z)
                for (int axis = 0; axis < 3; ++axis)
                    for (const float sign : {-1.0f, 1.0f}) {
                        RayQuery q;
                        q.position = glm::vec3(x, y, z) / 8.0f;
                        q.direction[axis] = sign;
                        q.normal = q.direction;
                        queries.push_back(q);
                    }
    for (const float visible : castRays(scene, view, queries))
        ASSERT_EQ(visible, 0.0f);
    for (RayQuery& q : queries)
        q.distance = 0.1f;  // every second plane of places is nearer than that to none
    const std::vector<float> near = castRays(scene, view, queries);
    for (size_t i = 0; i < queries.size(); ++i) {
        const float to_wall = 1.0f - glm::dot(queries[i].position, queries[i].direction);
        ASSERT_EQ(near[i], to_wall > 0.1f ? 1.0f : 0.0f);
    }
}

TEST(RayVisibility, ConvexSurfacesDoNotShadowThemselves) {
    const Scene scene = closedSphere(40);
    const Primitive& mesh = scene.primitives[0];
    const glm::dmat4& pose = scene.instances[0].worldFromLocal;
    const View view = viewFrom(glm::dvec3(3.0, 20.0, 1.0));
    Pcg32 random(13, 1);
    std::vector<RayQuery> queries;
    std::vector<float> expected;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        glm::dvec3 corners[3];
        for (size_t k = 0; k < 3; ++k)
            corners[k] = glm::dvec3(pose * glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[i + k]]), 1.0));
        glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (glm::length(normal) < 1e-12) continue;  // at the poles
        normal = glm::normalize(normal);
        for (int n = 0; n < 8; ++n) {
            const double u = random.uniform(), v = random.uniform() * (1.0 - u);
            RayQuery q;
            q.position = glm::vec3(corners[0] + u * (corners[1] - corners[0]) +
                                   v * (corners[2] - corners[0]) - view.eye);
            q.normal = glm::vec3(normal);
            // Down to a thousandth of a radian above the surface.
            glm::dvec3 direction = randomDirection(random);
            const double height = std::exp2(-10.0 * random.uniform());
            direction = glm::normalize(direction - glm::dot(direction, normal) * normal) + height * normal;
            q.direction = glm::vec3(glm::normalize(direction)) * (n % 2 ? -1.0f : 1.0f);
            queries.push_back(q);
            expected.push_back(n % 2 ? 0.0f : 1.0f);
        }
    }
    const std::vector<float> visible = castRays(scene, view, queries);
    int wrong = 0;
    for (size_t i = 0; i < queries.size(); ++i)
        wrong += visible[i] != expected[i];
    EXPECT_EQ(wrong, 0) << "of " << queries.size();
}

TEST(RayVisibility, DistancesEndTheWay) {
    Scene scene;
    addInstance(scene, addQuad(scene, addMaterial(scene, "lambert"), 1.0f),
                glm::translate(glm::dmat4(1.0), glm::dvec3(0.1, 0.2, -2.0)));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto query = [](float distance, const glm::vec3& direction = {0, 0, -1}) {
        RayQuery q;
        q.direction = direction;
        q.normal = {0, 0, -1};
        q.distance = distance;
        return q;
    };
    const std::vector<std::pair<RayQuery, float>> cases = {
        {query(kInfinity), 0.0f},
        {query(3e38f), 0.0f},
        {query(2.001f), 0.0f},
        {query(1.999f), 1.0f},
        {query(0.0f), 1.0f},
        {query(-1.0f), 1.0f},
        {query(nan), 1.0f},
        {query(1e-38f), 1.0f},
        {query(5.0f, {0, 0, 0}), 1.0f},
        {query(1.001f, {0, 0, -2}), 0.0f},  // in lengths of the direction
        {query(0.999f, {0, 0, -2}), 1.0f},
        {query(5.0f, {0, 0, 1}), 0.0f},  // from behind the surface
        {query(5.0f, {1e-30f, 1e-38f, -1}), 0.0f},
        {query(5.0f, {1, 0, 0}), 1.0f},
        {query(kInfinity, {0, -1, 0}), 1.0f}};
    std::vector<RayQuery> queries;
    for (const auto& [q, expected] : cases)
        queries.push_back(q);
    const std::vector<float> visible = castRays(scene, viewFrom(glm::dvec3(0.0)), queries);
    for (size_t i = 0; i < cases.size(); ++i)
        EXPECT_EQ(visible[i], cases[i].second) << "case " << i;
}

TEST(RayVisibility, ScenesWithoutSurfacesLetAllThrough) {
    RayQuery q;
    q.direction = q.normal = {0, 1, 0};
    EXPECT_EQ(castRays(Scene(), viewFrom(glm::dvec3(0.0)), {q})[0], 1.0f);
}

/// Masked and blended quads one behind the other, with textures of each wrap mode and filter.
Scene fences() {
    Scene scene;
    Pcg32 random(14, 1);
    for (int i = 0; i < 9; ++i) {
        const int material = addMaterial(scene, "lambert");
        Material& m = scene.materials[static_cast<size_t>(material)];
        m.alphaMode = i % 3 == 2 ? AlphaMode::blend : AlphaMode::mask;
        m.alpha = 0.8f;
        m.alphaCutoff = 0.3f;
        m.baseColorTexture.texture =
            addImage(scene, 5 + i, 7, i % 2 ? 2 : 4, [&](int, int, int) { return random.next() % 256; });
        Sampler& sampler = scene.textures.back().sampler;
        sampler.wrapS = static_cast<Wrap>(i % 3);
        sampler.wrapT = static_cast<Wrap>(i / 3);
        sampler.magnify = i % 2 ? Filter::nearest : Filter::linear;
        m.baseColorTexture.scale = {3.0f, 2.5f};
        m.baseColorTexture.rotation = 0.3f;
        m.baseColorTexture.offset = {-1.2f, 0.4f};
        const int quad = addQuad(scene, material, 1.0f);
        if (i == 4)
            scene.primitives.back().colors = {
                {1, 1, 1, 1}, {1, 1, 1, 0.2f}, {1, 1, 1, 0.9f}, {1, 1, 1, 0.5f}};
        addInstance(scene, quad,
                    glm::translate(glm::dmat4(1.0), glm::dvec3(2.5 * (i % 3), 2.5 * (i / 3), -1.0)));
        addInstance(scene, quad,
                    glm::translate(glm::dmat4(1.0), glm::dvec3(2.5 * (i % 3) + 0.4, 2.5 * (i / 3), -2.0)));
    }
    return scene;
}

TEST(RayVisibility, MasksCutHolesAndBlendedSurfacesDim) {
    const Scene scene = fences();
    const View view = viewFrom(glm::dvec3(2.0, 2.0, 1.0));
    const reference::Tracer tracer(std::make_shared<const Scene>(scene), view.eye);
    Pcg32 random(15, 1);
    std::vector<RayQuery> queries;
    for (int i = 0; i < 40000; ++i) {
        RayQuery q;
        q.position = glm::vec3(glm::dvec3(-1.0 + 7.5 * random.uniform(), -1.0 + 7.5 * random.uniform(), 0.0) -
                               view.eye);
        q.direction = glm::vec3(0.2 * random.uniform() - 0.1, 0.2 * random.uniform() - 0.1, -1.0);
        q.normal = {0, 0, -1};
        queries.push_back(q);
    }
    const std::vector<float> visible = castRays(scene, view, queries);
    reference::SurfacePoint from;
    from.geometricNormal = {0, 0, -1};
    from.instance = from.triangle = std::numeric_limits<uint32_t>::max();
    const glm::dvec2 error = RayScene(scene, 1 << 27).positionError(view);
    int holes = 0, dimmed = 0, blocked = 0, wrong = 0, atEdges = 0;
    for (size_t i = 0; i < queries.size(); ++i) {
        // Where the answer changes within what float rounds, it may be either.
        double low = 1.0, high = 0.0;
        for (const glm::dvec2& shift :
             {glm::dvec2(0), glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
            from.position = startOf(queries[i], view, error) + glm::dvec3(shift * 4e-6, 0.0);
            const double expected = tracer.visibility(from, glm::dvec3(queries[i].direction), 1e9);
            low = std::min(low, expected);
            high = std::max(high, expected);
        }
        const auto got = static_cast<double>(visible[i]);
        wrong += !(got >= low - 2e-5 && got <= high + 2e-5);
        holes += low == 1.0;
        blocked += high == 0.0;
        dimmed += low > 0.0 && high < 1.0;
        atEdges += high - low > 1e-3;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(holes, 2000);
    EXPECT_GT(blocked, 2000);
    EXPECT_GT(dimmed, 2000);
    EXPECT_LT(atEdges, 100);
}

}  // namespace
}  // namespace lobe::test
